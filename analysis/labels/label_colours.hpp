// The colours that labels get, in the file and in pictures.
#pragma once

#include <cstdint>
#include <iterator>

namespace hopscotch {

// Okabe and Ito's colours (distinguishable with every kind of colour vision), then again in lighter
// tones.
inline constexpr std::uint32_t label_colours[] = {
    0x9aa0a6, 0x0072b2, 0xe69f00, 0x009e73, 0xcc79a7, 0x56b4e9, 0xd55e00, 0xf0e442,
    0x7f5fa8, 0x8c6d3f, 0x66c2a5, 0xfc8d62, 0x8da0cb, 0xe78ac3, 0xa6d854, 0xffd92f};

/// For chaos where the other colours stand for periods and come round again.
inline constexpr std::uint32_t chaos_colour = 0x6b1a2a;

constexpr std::uint32_t colour_of(int label) {
    return label_colours[static_cast<std::size_t>(label - 1) % std::size(label_colours)];
}

}  // namespace hopscotch
