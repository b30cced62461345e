// Durations as users type them.
#include "host/cli/durations.hpp"

#include "host/cli/usage_error.hpp"

#include <charconv>

#include <fmt/format.h>

namespace hopscotch {
namespace {

[[noreturn]] void refuse(std::string_view text) {
    throw usage_error(fmt::format("--walltime {} (no duration); H:MM:SS?", text));
}

}  // namespace

double seconds_of(std::string_view text) {
    double seconds = 0.0;
    int n_parts = 0;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (true) {
        unsigned part = 0;
        const auto [next, failure] = std::from_chars(at, end, part);
        if (failure != std::errc{} || ++n_parts > 3) refuse(text);
        if (n_parts > 1 && part > 59) refuse(text);
        seconds = seconds * 60.0 + part;
        if (next == end) return seconds;
        if (*next != ':') refuse(text);
        at = next + 1;
    }
}

}  // namespace hopscotch
