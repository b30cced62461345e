#include "analysis/metrics/box_dimension.hpp"

#include "analysis/metrics/boundary.hpp"
#include "analysis/metrics/class_counts.hpp"
#include "analysis/metrics/parts.hpp"

#include <algorithm>
#include <bit>
#include <span>

namespace hopscotch::metrics {
namespace {

constexpr std::uint64_t steps_per_side = 2;  // of every box: 3 points along each side

/// 2, 4, 6, 8, 12, 16 ... L: every 2^i and 3 * 2^i, all of which divide the largest one.
std::vector<std::uint64_t> sides_for(const class_grid& grid) {
    std::uint64_t shortest = grid.axes.front().size();
    for (const axis& each : grid.axes) shortest = std::min(shortest, each.size());
    // 6 largest boxes along an axis (2 if that is too few scales), each of them 2 MiB of class sets
    // at most
    const std::uint64_t room = grid.rank() == 3 ? 64 : grid.rank() == 2 ? 512 : 65536;
    const std::uint64_t most = std::min(std::max<std::uint64_t>((shortest - 1) / 6, 12), room);
    std::uint64_t largest = 6;
    while (2 * largest <= most && 4 * largest < shortest) largest *= 2;
    std::vector<std::uint64_t> sides;
    for (std::uint64_t s = steps_per_side; s <= largest && 2 * largest < shortest; ++s) {
        const bool is_octave = std::has_single_bit(s);
        const bool is_between = s % 3 == 0 && std::has_single_bit(s / 3);
        if (largest % s == 0 && s % steps_per_side == 0 && (is_octave || is_between)) {
            sides.push_back(s);
        }
    }
    return sides;
}

/// The classes in all boxes of one size that fill one largest box.
class box_pyramid {
public:
    box_pyramid(const class_grid& grid, std::uint64_t largest) : grid_(grid), largest_(largest) {
        const std::array<std::uint64_t, 3> n = grid.extent();
        for (std::size_t i = 0; i < 3; ++i) has_steps_[i] = n[i] > 1;
    }

    std::span<const class_set> boxes(const std::array<std::uint64_t, 3>& origin,
                                     std::uint64_t side) {
        fill(origin, side / steps_per_side);
        coarsen();
        return {sets_.data(), static_cast<std::size_t>(now_[0] * now_[1] * now_[2])};
    }

private:
    std::uint64_t corners(std::size_t i) const { return has_steps_[i] ? 2 : 1; }

    /// Boxes of one stride: each holds the classes of its corners.
    void fill(const std::array<std::uint64_t, 3>& origin, std::uint64_t stride) {
        for (std::size_t i = 0; i < 3; ++i) now_[i] = has_steps_[i] ? largest_ / stride : 1;
        sets_.assign(now_[0] * now_[1] * now_[2], class_set{0});
        class_set* to = sets_.data();
        for (std::uint64_t a = 0; a < now_[0]; ++a) {
            for (std::uint64_t b = 0; b < now_[1]; ++b, to += now_[2]) {
                for (std::uint64_t corner = 0; corner < corners(0) * corners(1); ++corner) {
                    const std::uint64_t i0 = origin[0] + (a + corner / corners(1)) * stride;
                    const std::uint64_t i1 = origin[1] + (b + corner % corners(1)) * stride;
                    const class_index* from = grid_.row(i0, i1) + origin[2];
                    for (std::uint64_t c = 0; c < now_[2]; ++c) {
                        to[c] |= class_bits[from[c * stride]] | class_bits[from[(c + 1) * stride]];
                    }
                }
            }
        }
    }

    /// Boxes twice as large along every axis that has steps.
    void coarsen() {
        std::array<std::uint64_t, 3> next{};
        for (std::size_t i = 0; i < 3; ++i) next[i] = now_[i] / corners(i);
        for (std::uint64_t box = 0; box < next[0] * next[1] * next[2]; ++box) {
            const std::uint64_t a = box / next[2] / next[1];
            const std::uint64_t b = box / next[2] % next[1];
            const std::uint64_t c = box % next[2];
            class_set set = 0;
            for (std::uint64_t i = 0; i < corners(0) * corners(1) * 2; ++i) {
                const std::uint64_t i0 = a * corners(0) + i / 2 / corners(1);
                const std::uint64_t i1 = b * corners(1) + i / 2 % corners(1);
                set |= sets_[(i0 * now_[1] + i1) * now_[2] + c * 2 + i % 2];
            }
            sets_[box] = set;
        }
        now_ = next;
    }

    const class_grid& grid_;
    std::uint64_t largest_;
    std::array<bool, 3> has_steps_{};
    std::array<std::uint64_t, 3> now_{};
    std::vector<class_set> sets_;
};

}  // namespace

scaling_by_class box_counts_of(const class_grid& grid) {
    const std::vector<std::uint64_t> sides = sides_for(grid);
    const std::uint64_t largest = sides.empty() ? 1 : sides.back();
    std::array<std::uint64_t, 3> n = grid.extent();
    for (std::uint64_t& each : n) each = each == 1 ? 1 : (each - 1) / largest;
    const map_parts parts(n, grid.rank());
    class_counts counts(parts.size(), sides.size(), grid.classes.size());
#pragma omp parallel
    {
        class_counts own(parts.size(), sides.size(), grid.classes.size());
        box_pyramid pyramid(grid, largest);
#pragma omp for schedule(dynamic)
        for (std::uint64_t i = 0; i < n[0] * n[1] * n[2]; ++i) {
            const std::array<std::uint64_t, 3> at{i / n[2] / n[1], i / n[2] % n[1], i % n[2]};
            const std::array<std::uint64_t, 3> origin{at[0] * largest, at[1] * largest,
                                                      at[2] * largest};
            const std::size_t part = parts.of(at[0], at[1], at[2]);
            for (std::size_t scale = 0; scale < sides.size(); ++scale) {
                for (const class_set set : pyramid.boxes(origin, sides[scale])) {
                    own.add(part, scale, boundaries_through(set));
                }
            }
        }
#pragma omp critical
        counts.add(own);
    }
    return counts.fit(sides);
}

}  // namespace hopscotch::metrics
