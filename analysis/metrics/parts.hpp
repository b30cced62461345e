// Cuts a map into rectangular parts, whose differences tell how well a number measured on the whole
// map is known.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace hopscotch::metrics {

/// About 32 to 64 parts: 32 along one axis, 8 x 8 along two, 4 x 4 x 4 along three.
class map_parts {
public:
    /// \param extent  steps along three axes (1 along a missing one), what `of` is asked in
    map_parts(const std::array<std::uint64_t, 3>& extent, std::size_t rank) : extent_(extent) {
        const std::uint64_t wanted = rank == 1 ? 32 : rank == 2 ? 8 : 4;
        for (std::size_t i = 0; i < 3; ++i)
            along_[i] = std::min(wanted, std::max<std::uint64_t>(extent[i], 1));
    }

    std::size_t size() const { return static_cast<std::size_t>(along_[0] * along_[1] * along_[2]); }

    std::size_t of(std::uint64_t i0, std::uint64_t i1, std::uint64_t i2) const {
        const std::uint64_t a = i0 * along_[0] / extent_[0];
        const std::uint64_t b = i1 * along_[1] / extent_[1];
        const std::uint64_t c = i2 * along_[2] / extent_[2];
        return static_cast<std::size_t>((a * along_[1] + b) * along_[2] + c);
    }

private:
    std::array<std::uint64_t, 3> extent_;
    std::array<std::uint64_t, 3> along_{};
};

}  // namespace hopscotch::metrics
