// Every wrong label carries the flag `uncertain`: cells one ulp apart around basin boundaries of
// all models, against double-double and, where that disagrees, 50 digits.
#include "host/run/audit.hpp"
#include "host/run/uncertain.hpp"
#include "tests/hard/boundary_zoom.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include <tbb/parallel_for.h>

using namespace hopscotch;

namespace {

struct boundary_case {
    const char* name;
    const char* scene;
    std::vector<std::string> overrides;
    int n_lines;        // in CI
    std::uint64_t n_cells;  // on a line, to find changes
};

void PrintTo(const boundary_case& shown, std::ostream* to) { *to << shown.name; }

const std::vector<boundary_case>& cases() {
    static const std::vector<boundary_case> all{
        {"passive_hopper", "quickstart", {}, 6, 400},
        {"passive_hopper_energy_added", "chatterjee2002_fig8", {"question.returns=2000"}, 4, 400},
        {"passive_hopper_nonlinear", "chatterjee2002_nonlinear", {"question.returns=200"}, 1, 40},
        {"raibert_pneumatic_simple", "koditschek1991_fig13", {}, 4, 200},
        {"raibert_pneumatic", "koditschek1991_crisis", {}, 2, 100},
        {"openloop_hopper", "cham2007_fig8_basins", {}, 2, 100},
        {"slip", "ghigliazza2005_basins", {}, 4, 200},
        {"slip_gravity", "ghigliazza2005_gravity", {}, 2, 40},
        {"slip_pitching", "ghigliazza2005_fig5", {}, 2, 40},
        {"mirror_line", "rizzi1994_line", {}, 4, 200},
        {"mirror_planar", "rizzi1994_planar_basin", {}, 2, 100},
        {"mirror_spatial", "rizzi1994_spatial_basin", {}, 2, 100},
        {"paddle_juggler", "paddle_sticking", {}, 2, 100},
        {"paddle_juggler_sticking", "shannon_juggler", {}, 2, 100},
    };
    return all;
}

/// What was found around one scene's boundaries.
struct tally {
    std::uint64_t cells = 0;
    std::uint64_t flagged = 0;
    std::uint64_t wrong = 0;
    std::uint64_t wrong_unflagged = 0;
};

void look_at(const scene& zoomed, const label_plan& plan, const kernel_choice& kernel, tally& found,
             double at) {
    std::vector<std::uint64_t> cells(zoomed.n_cells());
    std::iota(cells.begin(), cells.end(), std::uint64_t{0});
    const std::vector<int> stored = hard::answers_of(zoomed, plan, kernel);
    const std::vector<std::uint8_t> flags = certainty_of(zoomed, plan, kernel, cells);
    std::vector<cell_verdict> verdicts(cells.size());
    tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) {
        verdicts[i] = judge(zoomed, plan, cells[i], stored[i]);
    });
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const bool is_flagged = flags[i] != 0;
        ++found.cells;
        found.flagged += is_flagged ? 1 : 0;
        found.wrong += verdicts[i].agrees() ? 0 : 1;
        if (verdicts[i].agrees() || is_flagged) continue;
        ++found.wrong_unflagged;
        ADD_FAILURE() << zoomed.name << ": " << static_cast<double>(i) - 64.0 << " ulp from " << at
                      << ": " << stored[i] << " instead of " << verdicts[i].computed;
    }
}

tally look_around(const boundary_case& which, int n_lines, std::size_t most_changes) {
    const std::filesystem::path file = std::filesystem::path(HOPSCOTCH_SOURCE) / "configs/scenes" /
                                       (std::string(which.scene) + ".toml");
    const scene whole = read_scene(file, which.overrides);
    tally found;
    for (int i = 0; i < n_lines; ++i) {
        const scene line = hard::line_through(whole, (i + 0.5) / n_lines);
        const label_plan plan = line.question.has_labels ? plan_labels(line) : label_plan{};
        const kernel_choice kernel = kernel_of(line, "auto");
        for (const double at : hard::changes_on(line, plan, kernel, which.n_cells, most_changes)) {
            const double step = hard::ulp_of(at);
            look_at(hard::part_of(line, at - 64.0 * step, at + 64.0 * step, 129), plan, kernel,
                    found, at);
        }
    }
    return found;
}

class around_the_boundaries : public ::testing::TestWithParam<boundary_case> {};

}  // namespace

TEST_P(around_the_boundaries, every_wrong_label_is_flagged_uncertain) {
    const tally found = look_around(GetParam(), GetParam().n_lines, 3);
    EXPECT_GT(found.cells, 0u) << "no boundary was found";
    EXPECT_EQ(found.wrong_unflagged, 0u);
    std::printf("%s: cells %llu flagged %llu wrong %llu\n", GetParam().name,
                (unsigned long long)found.cells, (unsigned long long)found.flagged,
                (unsigned long long)found.wrong);
}

INSTANTIATE_TEST_SUITE_P(of, around_the_boundaries, ::testing::ValuesIn(cases()),
                         [](const auto& tested) { return std::string(tested.param.name); });
