// Does memory stay bounded by the tiles in flight, whatever the map's size? Peak resident set of
// strips of a 16384 cells wide map, one and four tile rows high, and what --dry-run says of 16384 x
// 16384. Usage: memory PROGRAM SCENE
#include "bench/child.hpp"
#include "bench/report.hpp"

#include <cstdlib>
#include <exception>
#include <sstream>

#include <fmt/format.h>

namespace hopscotch::bench {
namespace {

constexpr int width = 16384;
constexpr double mebibyte = 1024.0 * 1024.0;

std::vector<std::string> command_for(const program_and_scene& given, int rows) {
    return {given.program,
            "run",
            given.scene,
            fmt::format("grid.axis[0].cells={}", rows),
            fmt::format("grid.axis[1].cells={}", width),
            "accuracy.audit_cells=0"};
}

void run_strip(const program_and_scene& given, int rows) {
    const scratch_directory scratch;
    std::vector<std::string> command = command_for(given, rows);
    for (const std::string& word :
         {std::string("--quiet"), std::string("-o"), (scratch.path() / "map.h5").string()}) {
        command.push_back(word);
    }
    const child_result child = run_child(command);
    const auto n_cells = static_cast<double>(rows) * width;
    json_line("memory")
        .add("rows", static_cast<double>(rows))
        .add("columns", static_cast<double>(width))
        .add("peak_bytes", child.peak_bytes)
        .add("peak_bytes_per_cell", child.peak_bytes / n_cells)
        .add("wall_seconds", child.wall_seconds)
        .print();
    fmt::print("{} x {}: peak {:.1f} MiB, {:.2f} s\n", rows, width, child.peak_bytes / mebibyte,
               child.wall_seconds);
}

/// The number behind a word at the beginning of a line of the dry run.
double number_after(const std::string& text, const std::string& word) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(word + " ")) return std::strtod(line.c_str() + word.size(), nullptr);
    }
    return 0.0;
}

void dry_run(const program_and_scene& given) {
    std::vector<std::string> command = command_for(given, width);
    command.emplace_back("--dry-run");
    const child_result child = run_child(command);
    json_line("memory_dry_run")
        .add("rows", static_cast<double>(width))
        .add("columns", static_cast<double>(width))
        .add("cells", number_after(child.output, "cells"))
        .add("map_bytes", number_after(child.output, "bytes"))
        .add("memory_bytes", number_after(child.output, "memory"))
        .add("peak_bytes", child.peak_bytes)
        .add("wall_seconds", child.wall_seconds)
        .print();
    fmt::print("--dry-run of {} x {} ({:.2f} s, peak {:.1f} MiB):\n{}", width, width,
               child.wall_seconds, child.peak_bytes / mebibyte, child.output);
}

}  // namespace
}  // namespace hopscotch::bench

int main(int argc, char** argv) {
    using namespace hopscotch::bench;
    try {
        const program_and_scene given = arguments_of(argc, argv);
        for (const int rows : {256, 1024}) run_strip(given, rows);
        dry_run(given);
    } catch (const std::exception& error) {
        fmt::print(stderr, "memory: {}\n", error.what());
        return 1;
    }
}
