#include "analysis/render/palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace hopscotch::picture {

namespace {

constexpr std::array<std::uint32_t, 7> okabe_ito{0x0072b2, 0xe69f00, 0x009e73, 0xcc79a7,
                                                 0x56b4e9, 0xd55e00, 0xf0e442};

// Every sixteenth of matplotlib's viridis (CC0).
constexpr std::array<std::uint32_t, 17> viridis{
    0x440154, 0x481a6c, 0x472f7d, 0x414487, 0x39568c, 0x31688e, 0x2a788e, 0x23888e, 0x1f988b,
    0x22a884, 0x35b779, 0x54c568, 0x7ad151, 0xa5db36, 0xd2e21b, 0xe9e51a, 0xfde725};

// Blue to white to red with equal lightness on both sides (after Moreland's and Crameri's scales).
constexpr std::array<std::uint32_t, 9> blue_red{0x0b2f6b, 0x2a66a8, 0x6a9fcb, 0xb3cfe3, 0xf3f1ec,
                                                0xecbfa6, 0xd68263, 0xae3f2e, 0x670a16};

rgb between(std::span<const std::uint32_t> stops, double share) {
    const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(at), stops.size() - 2);
    const double t = at - static_cast<double>(i);
    const rgb low = rgb::of(stops[i]);
    const rgb high = rgb::of(stops[i + 1]);
    const auto mix = [t](std::uint8_t a, std::uint8_t b) {
        return static_cast<std::uint8_t>(std::lround(a + t * (b - a)));
    };
    return {mix(low.red, high.red), mix(low.green, high.green), mix(low.blue, high.blue)};
}

/// Mixed with white or black: a lighter or darker relative of a colour.
rgb shaded(rgb colour, double share, std::uint8_t with) {
    const auto mix = [&](std::uint8_t part) {
        return static_cast<std::uint8_t>(std::lround(part + share * (with - part)));
    };
    return {mix(colour.red), mix(colour.green), mix(colour.blue)};
}

}  // namespace

rgb distinct_colour(std::size_t i) {
    const rgb colour = rgb::of(okabe_ito[i % okabe_ito.size()]);
    switch (i / okabe_ito.size() % 3) {
        case 1:
            return shaded(colour, 0.5, 255);
        case 2:
            return shaded(colour, 0.45, 0);
        default:
            return colour;
    }
}

rgb outcome_colour(std::string_view name, std::size_t i) {
    for (const std::string_view open : {"budget", "not_finite", "unresolved_event"}) {
        if (name == open) return undecided;
    }
    return distinct_colour(i);
}

rgb sequential(double share) { return between(viridis, share); }

rgb diverging(double share) { return between(blue_red, share); }

}  // namespace hopscotch::picture
