// The map's hash: one number for all values of a map, the same for any tile size, tile order,
// thread count and backend. A layer's sum adds up over its tiles, so a tile's checksum is the same
// sum taken over the tile. Used by the store (checksums, `verify`) and by the cross-backend tests.
#pragma once

#include "host/map/layout.hpp"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace hopscotch {

/// A commutative 128-bit sum of mixed (cell, value) pairs, kept in two words that wrap.
struct layer_sum {
    std::uint64_t low = 0;
    std::uint64_t high = 0;

    constexpr layer_sum& operator+=(const layer_sum& other) {
        low += other.low;
        high += other.high;
        return *this;
    }
    constexpr layer_sum& operator-=(const layer_sum& other) {
        low -= other.low;
        high -= other.high;
        return *this;
    }
    friend constexpr bool operator==(const layer_sum&, const layer_sum&) = default;
};

/// The sum over one tile of one layer.
///
/// \param layer   index into layout.layers; its name enters the mixing, so that layers differ
/// \param values  the box's values in C order, bytes_of(type) each; every NaN counts as the same
/// value \error         std::invalid_argument where `values` has the wrong size
layer_sum sum_of(const map_layout& layout, const tile_box& box, std::size_t layer,
                 std::span<const std::byte> values);

/// The hash of a map, 32 hexadecimal digits: axes (name, values) and, in layout order, every layer
/// (name, type, sum over all tiles).
std::string map_hash(const map_layout& layout, std::span<const layer_sum> sums);

/// 32 hexadecimal digits, high word first.
std::string hexadecimal(const layer_sum& sum);

}  // namespace hopscotch
