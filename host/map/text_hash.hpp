// A short hash of a text, the same on every machine: names scenes and sets of maps.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace hopscotch {

/// FNV-1a over 128 bits, 32 hexadecimal digits.
inline std::string text_hash(std::string_view text) {
    __extension__ using word128 = unsigned __int128;
    constexpr word128 prime = (static_cast<word128>(1) << 88) + 0x13b;
    word128 hash = (static_cast<word128>(0x6c62272e07bb0142u) << 64) + 0x62b821756295c58du;
    for (const char letter : text) {
        hash ^= static_cast<unsigned char>(letter);
        hash *= prime;
    }
    return fmt::format("{:016x}{:016x}", static_cast<std::uint64_t>(hash >> 64),
                       static_cast<std::uint64_t>(hash));
}

}  // namespace hopscotch
