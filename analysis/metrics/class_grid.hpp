// The cells of a map as every metric sees them: one small class number per cell, whatever the
// layer they were read from. Filled by read_classes.hpp, or by hand in tests.
#pragma once

#include "host/map/layout.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace hopscotch::metrics {

using class_index = std::uint8_t;
inline constexpr class_index no_class = 255;  // undecided, outside the domain, or not computed

/// A set of classes, one bit each, and one bit for cells without a class.
using class_set = std::uint64_t;
inline constexpr std::size_t most_classes = 63;
inline constexpr class_set undecided_bit = class_set{1} << most_classes;

/// What the cells of one class have in common.
struct basin_class {
    std::string name;
    int value = 0;            // the label (or other value of the layer), or the outcome's code
    bool is_outcome = false;  // cells without a label, told apart by their outcome
    bool is_fall = false;     // such an outcome that is a failure
    std::uint64_t n_cells = 0;
};

/// Axes with one cell are left out: they have no extent to measure along.
struct class_grid {
    std::vector<axis> axes;          // one to three, the first one slowest in memory
    std::vector<class_index> cells;  // C order
    std::vector<basin_class> classes;
    std::uint64_t n_undecided = 0;     // budget spent, unresolved, no label
    std::uint64_t n_outside = 0;       // starts outside the model's domain
    std::uint64_t n_not_computed = 0;  // missing or damaged tiles
    std::uint64_t n_lumped = 0;        // classes counted together because there are too many

    std::size_t rank() const { return axes.size(); }
    std::uint64_t n_without_class() const { return n_undecided + n_outside + n_not_computed; }
    std::uint64_t n_decided() const { return cells.size() - n_without_class(); }

    /// Cells along three axes, the missing ones first and one cell long: loops need one form only.
    std::array<std::uint64_t, 3> extent() const {
        std::array<std::uint64_t, 3> result{1, 1, 1};
        for (std::size_t i = 0; i < rank(); ++i) result[3 - rank() + i] = axes[i].size();
        return result;
    }

    /// The cells of one row along the last axis.
    const class_index* row(std::uint64_t i0, std::uint64_t i1) const {
        const std::array<std::uint64_t, 3> n = extent();
        return cells.data() + (i0 * n[1] + i1) * n[2];
    }
};

/// The bit of every class number, and of cells without a class.
inline constexpr std::array<class_set, 256> class_bits = [] {
    std::array<class_set, 256> bits{};
    for (std::size_t i = 0; i < most_classes; ++i) bits[i] = class_set{1} << i;
    bits[no_class] = undecided_bit;
    return bits;
}();

/// True where a set holds two classes or more: somewhere between those cells runs a boundary.
constexpr bool is_mixed(class_set set) {
    const class_set decided = set & ~undecided_bit;
    return (decided & (decided - 1)) != 0;
}

/// In which unit lengths are measured: along a linear axis by its values, along a logarithmic one
/// by the natural logarithm of its values; or in cells.
enum class length_unit : std::uint8_t { axis_units, cells };

/// Where a value lies on an axis' scale.
inline double scaled(const axis& along, double value) {
    return along.scale == "log" ? std::log(value) : value;
}

/// Positions of an axis' cells.
inline std::vector<double> positions_of(const axis& along, length_unit unit) {
    std::vector<double> result(along.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] =
            unit == length_unit::cells ? static_cast<double>(i) : scaled(along, along.values[i]);
    }
    return result;
}

}  // namespace hopscotch::metrics
