// hopscotch verify FILE.h5: is the file what was computed, and was that right?
#include "analysis/labels/plan.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/map_plan.hpp"
#include "host/cli/sweep_point.hpp"
#include "host/run/attributes.hpp"
#include "host/run/open_cells.hpp"
#include "host/run/audit.hpp"
#include "host/run/requests.hpp"
#include "host/scene/diagram_grid.hpp"
#include "host/store/sweep_index.hpp"
#include "host/store/verify.hpp"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace hopscotch {
namespace {

struct verify_arguments {
    std::string file;
    std::string point;
    std::uint64_t n_cells = 0;
    std::uint64_t seed = 0;
    bool searches = false;
};

label_plan plan_for(const verify_arguments& given, const scene& scene, const map_reader& map) {
    if (given.searches) return plan_labels(scene, cells_of(map.attribute(searched_cells)));
    return told_plan(scene, map);
}

void recompute(const verify_arguments& given) {
    const map_reader map(given.file);
    const scene scene = scene_of(map);
    if (is_orbit_diagram(scene)) {
        fmt::print("cells recomputed  0 (an orbit diagram is checked by its sums)\n");
        return;
    }
    const label_plan plan = plan_for(given, scene, map);
    const audit_report report = audit(
        scene, plan, [&](std::uint64_t tile) { return map.tile(tile); }, given.n_cells, given.seed);
    fmt::print("cells recomputed  {} ({})\n", report.n_cells,
               is_chaos_map(scene) ? "motion in dd" : "dd; disputed ones mp50");
    fmt::print("wrong             {}  share {:.17g}, 95 % interval {:.17g} to {:.17g}\n",
               report.n_wrong, report.share, report.lowest, report.highest);
    fmt::print("uncertain         {}  wrong without being so {}\n", report.n_uncertain,
               report.n_wrong_certain);
    for (const cell_verdict& verdict : report.wrong) {
        fmt::print("  stored {} computed {}  {}\n", verdict.stored, verdict.computed,
                   replay_command(scene, given.file, verdict.cell));
    }
    for (const layer_error& layer : report.errors) {
        fmt::print("error of {:<8} median {:.17g} largest {:.17g} ({})  {}\n", layer.layer,
                   layer.median, layer.largest, layer.unit,
                   replay_command(scene, given.file, layer.worst));
    }
}

/// A map has its hash from the moment it is packed.
std::string hash_of(const map_reader& map) {
    return map.is_finished_map() ? map.attribute("hash")
                                 : "none yet (all tiles are there, the run is not finished)";
}

int verify(const verify_arguments& given) {
    const std::vector<map_problem> problems = verify_file(given.file);
    for (const map_problem& problem : problems) fmt::print(stderr, "hopscotch: {}\n", problem.text);
    if (!problems.empty()) return exit_store;
    fmt::print("hash              {}\nchecksums         all tiles as computed\n",
               hash_of(map_reader(given.file)));
    if (given.n_cells > 0) recompute(given);
    return exit_done;
}

/// Every map of a sweep: its sums, and whether it is the one that the index has listed.
int verify_sweep(const verify_arguments& given) {
    const std::filesystem::path directory = sweep_directory(given.file);
    const std::vector<std::string> hashes = read_sweep_contents(given.file).hashes;
    int code = exit_done;
    const auto complain = [&](const std::string& text) {
        fmt::print(stderr, "hopscotch: {}\n", text);
        code = exit_store;
    };
    for (std::uint64_t point = 0; point < hashes.size(); ++point) {
        const std::string file = sweep_map_path(directory, point).string();
        if (!std::filesystem::exists(file)) {
            complain(fmt::format("{} (missing); run again with --resume?", file));
            continue;
        }
        const std::vector<map_problem> problems = verify_file(file);
        for (const map_problem& problem : problems) complain(problem.text);
        if (!problems.empty()) continue;
        if (map_reader(file).attribute("hash") != hashes[point]) {
            complain(fmt::format("{} (not the map that the index lists); --resume?", file));
        }
        verify_arguments of_map = given;
        of_map.file = file;
        if (given.n_cells > 0) recompute(of_map);
    }
    if (code == exit_done)
        fmt::print("maps              {}, all tiles as computed\n", hashes.size());
    return code;
}

}  // namespace

void add_verify(CLI::App& program, int& exit_code) {
    auto given = std::make_shared<verify_arguments>();
    CLI::App* command =
        program.add_subcommand("verify", "Check a map's sums and some of its cells");
    command->add_option("file", given->file, "Map file (HDF5)")->required();
    add_point(*command, given->point);
    command->add_option("--cells", given->n_cells,
                        "Random cells to recompute in higher precision (0)");
    command->add_option("--seed", given->seed,
                        "Which random cells; 0 for those of the run's own audit (0)");
    command->add_flag("--search", given->searches,
                      "Search attractors anew instead of reading the map's");
    command->callback([given, &exit_code] {
        const bool is_whole_sweep = given->point.empty() && !sweep_directory(given->file).empty();
        if (!is_whole_sweep) given->file = chosen_map(given->file, given->point);
        exit_code = is_whole_sweep ? verify_sweep(*given) : verify(*given);
    });
}

}  // namespace hopscotch
