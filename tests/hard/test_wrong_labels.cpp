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
    int n_lines;            // in CI
    std::uint64_t n_cells;  // on a line, to find changes
};

void PrintTo(const boundary_case& shown, std::ostream* to) { *to << shown.name; }

/// Unimodal maps are missing: they have one attractor and so no boundaries.
const std::vector<boundary_case>& cases() {
    static const std::vector<boundary_case> all{
        {"passive_hopper", "quickstart", {"question.returns=200"}, 3, 200},
        {"passive_hopper_energy_added", "chatterjee2002_fig8", {"question.returns=200"}, 2, 200},
        {"passive_hopper_nonlinear", "chatterjee2002_nonlinear", {"question.returns=20"}, 1, 20},
        {"raibert_pneumatic", "koditschek1991_crisis", {"question.returns=40"}, 4, 50},
        {"openloop_hopper", "cham2007_fig8_basins", {"question.returns=50"}, 1, 50},
        {"slip", "ghigliazza2005_basins", {"question.returns=50"}, 6, 100},
        {"slip_gravity", "ghigliazza2005_gravity", {"question.returns=4"}, 1, 20},
        {"mirror_line", "rizzi1994_line", {"question.returns=300"}, 6, 200},
        {"mirror_planar", "rizzi1994_planar_basin", {}, 2, 50},
        {"mirror_spatial", "rizzi1994_spatial_basin", {}, 2, 50},
        {"paddle_juggler", "paddle_sticking", {"question.returns=40"}, 1, 50},
    };
    return all;
}

constexpr int reach = 24;  // ulps on either side of a change

/// With those whose truth takes minutes.
std::vector<boundary_case> all_cases() {
    std::vector<boundary_case> all = cases();
    all.push_back({"slip_pitching", "ghigliazza2005_fig5", {"question.returns=4"}, 2, 20});
    all.push_back({"paddle_juggler_sticking", "shannon_juggler", {"question.returns=40"}, 1, 50});
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
    const std::vector<std::uint8_t> flags = certainty_of(zoomed, plan, kernel.run, cells);
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
        ADD_FAILURE() << zoomed.name << ": " << static_cast<int>(i) - reach << " ulp from " << at
                      << ": " << stored[i] << " instead of " << verdicts[i].computed;
    }
}

/// Looks along up to `n_lines` lines until `n_wanted` cells are seen.
tally look_around(const boundary_case& which, int n_lines, std::size_t most_changes,
                  std::uint64_t n_wanted) {
    const std::filesystem::path file = std::filesystem::path(HOPSCOTCH_SOURCE) / "configs/scenes" /
                                       (std::string(which.scene) + ".toml");
    const scene whole = read_scene(file, which.overrides);
    tally found;
    for (int i = 0; i < n_lines && found.cells < n_wanted; ++i) {
        const scene line = hard::line_through(whole, std::fmod(0.25 + 0.618033988749895 * i, 1.0));
        const label_plan plan = line.question.has_labels ? plan_labels(line) : label_plan{};
        const kernel_choice kernel = kernel_of(line, "auto");
        for (const double at : hard::changes_on(line, plan, kernel, which.n_cells, most_changes)) {
            const double step = hard::ulp_of(at);
            look_at(hard::part_of(line, at - reach * step, at + reach * step, 2 * reach + 1), plan,
                    kernel, found, at);
        }
    }
    return found;
}

class around_the_boundaries : public ::testing::TestWithParam<boundary_case> {};
class boundaries_of_every_model : public ::testing::TestWithParam<boundary_case> {};

}  // namespace

TEST_P(around_the_boundaries, every_wrong_label_is_flagged_uncertain) {
    const tally found = look_around(GetParam(), GetParam().n_lines, 1, 1000);
    EXPECT_GT(found.cells, 0u) << "no boundary was found";
    EXPECT_EQ(found.wrong_unflagged, 0u);
    RecordProperty("cells", std::to_string(found.cells));
    RecordProperty("flagged", std::to_string(found.flagged));
    RecordProperty("wrong", std::to_string(found.wrong));
}

TEST(around_the_boundaries_of_the_open_loop_hopper, cells_one_ulp_apart_really_have_wrong_labels) {
    // the claims above would be empty if the arithmetic made no mistakes there
    const tally found = look_around(
        {"openloop_hopper", "cham2007_fig8_basins", {"question.returns=300"}, 1, 50}, 1, 1, 1000);
    EXPECT_GT(found.wrong, 0u);
    EXPECT_EQ(found.wrong_unflagged, 0u);
}

/// A million cells per model, or all boundaries on 5000 lines.
TEST_P(boundaries_of_every_model, slow_every_wrong_label_of_a_million_cells_is_flagged) {
    const tally found = look_around(GetParam(), 5000, 100, 1'000'000);
    EXPECT_GE(found.cells, 100'000u);
    EXPECT_EQ(found.wrong_unflagged, 0u);
}

INSTANTIATE_TEST_SUITE_P(of, around_the_boundaries, ::testing::ValuesIn(cases()),
                         [](const auto& tested) { return std::string(tested.param.name); });
INSTANTIATE_TEST_SUITE_P(of, boundaries_of_every_model, ::testing::ValuesIn(all_cases()),
                         [](const auto& tested) { return std::string(tested.param.name); });
