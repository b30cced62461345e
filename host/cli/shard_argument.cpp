// Shards in words.
#include "host/cli/shard_argument.hpp"

#include "host/cli/usage_error.hpp"

#include <charconv>

#include <fmt/format.h>

namespace hopscotch {

shard shard_of(std::string_view text) {
    const char* const end = text.data() + text.size();
    std::uint64_t number = 0;
    std::uint64_t count = 0;
    const auto [slash, first] = std::from_chars(text.data(), end, number);
    if (first == std::errc{} && slash != end && *slash == '/') {
        const auto [rest, second] = std::from_chars(slash + 1, end, count);
        if (second == std::errc{} && rest == end && number >= 1 && number <= count) {
            return {number - 1, count};
        }
    }
    throw usage_error(
        fmt::format("--shard {} (shard I of N is I/N, counted from 1 to N); --shard 1/8?", text));
}

std::string text_of(const shard& part) { return fmt::format("{}/{}", part.index + 1, part.count); }

}  // namespace hopscotch
