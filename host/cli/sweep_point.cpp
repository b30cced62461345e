// From an index and a point to a map file.
#include "host/cli/sweep_point.hpp"

#include "host/cli/usage_error.hpp"
#include "host/run/attributes.hpp"
#include "host/scene/sweep.hpp"
#include "host/store/sweep_index.hpp"

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace hopscotch {
namespace {

/// "3,1" as an index in C order; nothing where it is no point of that shape.
std::optional<std::uint64_t> index_in(const std::vector<std::uint64_t>& shape,
                                      const std::string& text) {
    const char* at = text.data();
    const char* const end = at + text.size();
    std::uint64_t index = 0;
    for (std::size_t i = 0; i < shape.size(); ++i) {
        std::uint64_t coordinate = 0;
        const auto [next, failure] = std::from_chars(at, end, coordinate);
        const bool is_last = i + 1 == shape.size();
        const bool is_well = failure == std::errc{} && coordinate < shape[i] &&
                             (is_last ? next == end : next != end && *next == ',');
        if (!is_well) return std::nullopt;
        index = index * shape[i] + coordinate;
        at = is_last ? next : next + 1;
    }
    return index;
}

}  // namespace

std::string chosen_map(const std::string& file, const std::string& point) {
    const std::filesystem::path directory = sweep_directory(file);
    if (directory.empty() && point.empty()) return file;
    if (directory.empty()) {
        throw usage_error(fmt::format("--point {} ({} is no index of a sweep)", point, file));
    }
    const scene scene = scene_of(read_sweep_contents(file).attributes);
    const std::vector<std::uint64_t> shape = sweep_shape(scene.sweep);
    const auto index = index_in(shape, point);
    if (index) return sweep_map_path(directory, *index).string();
    throw usage_error(
        fmt::format("{} (a sweep of {} maps{}); --point {}?", file, fmt::join(shape, " x "),
                    point.empty() ? "" : fmt::format(", none of them at --point {}", point),
                    fmt::join(std::vector<int>(shape.size(), 0), ",")));
}

void add_point(CLI::App& command, std::string& point) {
    command.add_option("--point", point, "Of a sweep's index: which map, as 3,1");
}

}  // namespace hopscotch
