// Is every wrong label flagged `uncertain`? The scenes of all models that have basins, and a tally
// of cells in which labels, flags and truth are compared. Used by test_wrong_labels.cpp at reduced
// size and by bench/uncertain.cpp at full size.
#pragma once

#include "host/run/audit.hpp"
#include "host/run/uncertain.hpp"
#include "tests/hard/boundary_zoom.hpp"
#include "tests/hard/true_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <numeric>
#include <ostream>
#include <string>
#include <vector>

#include <tbb/parallel_for.h>

namespace hopscotch::hard {

struct boundary_case {
    const char* name;
    const char* scene;
    std::vector<std::string> overrides;
    int n_lines;            // at most, in CI
    std::uint64_t n_cells;  // on a line, to find changes
    int reach = 128;        // cells on either side of a change in a full run: more where truth is
                            // costly, since a window's cells cost few true orbits
};

inline void PrintTo(const boundary_case& shown, std::ostream* to) { *to << shown.name; }

/// Those whose truth is quick. Unimodal maps are missing: they have one attractor and so no
/// boundaries.
inline const std::vector<boundary_case>& quick_cases() {
    static const std::vector<boundary_case> all{
        {"passive_hopper", "quickstart", {"question.returns=200"}, 100, 200, 512},
        {"passive_hopper_energy_added", "chatterjee2002_fig8", {"question.returns=200"}, 20, 200},
        {"passive_hopper_nonlinear",
         "chatterjee2002_nonlinear",
         {"question.returns=20"},
         8,
         20,
         2048},
        {"passive_juggler",
         "quickstart",
         {"model.name=passive_juggler", "question.returns=200"},
         100,
         200,
         512},
        {"raibert_pneumatic", "koditschek1991_crisis", {"question.returns=40"}, 12, 50, 1024},
        {"openloop_hopper", "cham2007_fig8_basins", {"question.returns=50"}, 8, 50, 512},
        {"slip", "ghigliazza2005_basins", {"question.returns=50"}, 12, 100, 2048},
        {"slip_gravity", "ghigliazza2005_gravity", {"question.returns=4"}, 8, 20, 2048},
        {"slip_pitching", "ghigliazza2005_fig5", {"question.returns=4"}, 2, 20, 2048},
        {"mirror_line", "rizzi1994_line", {"question.returns=300"}, 100, 200},
        {"mirror_planar", "rizzi1994_planar_basin", {}, 20, 50},
        {"mirror_spatial", "rizzi1994_spatial_basin", {}, 20, 50},
        {"paddle_juggler", "paddle_sticking", {"question.returns=40"}, 8, 50, 512},
    };
    return all;
}

/// An orbit that settles on its rest takes seconds in double-double.
inline boundary_case relief_valve_case() {
    return {"relief_valve",
            "relief_valve_basins",
            {"grid.axis.0.cells=8", "question.samples=16"},
            8,
            20,
            8192};
}

inline std::vector<boundary_case> all_cases() {
    std::vector<boundary_case> all = quick_cases();
    all.push_back(relief_valve_case());
    return all;
}

inline scene scene_of(const boundary_case& which, const std::filesystem::path& source) {
    return read_scene(source / "configs/scenes" / (std::string(which.scene) + ".toml"),
                      which.overrides);
}

/// What was found.
struct tally {
    std::uint64_t cells = 0;
    std::uint64_t flagged = 0;
    std::uint64_t wrong = 0;
    std::uint64_t wrong_unflagged = 0;
    std::uint64_t evaluated = 0;      // cells whose true answer was computed
    std::uint64_t checked = 0;        // of these, cells taken for right and without the flag
    std::uint64_t checked_wrong = 0;  // and wrong all the same

    tally& operator+=(const tally& other) {
        cells += other.cells;
        flagged += other.flagged;
        wrong += other.wrong;
        wrong_unflagged += other.wrong_unflagged;
        evaluated += other.evaluated;
        checked += other.checked;
        checked_wrong += other.checked_wrong;
        return *this;
    }
};

/// Told of every wrong label without a flag: which of the cells, and the verdict.
using complaint = std::function<void(std::size_t, const cell_verdict&)>;

/// Labels, flags and truth of some cells of a scene.
inline tally judge_cells(const scene& scene, const label_plan& plan, const kernel_choice& kernel,
                         const std::vector<std::uint64_t>& cells, const complaint& complain) {
    const std::vector<int> stored = answers_of(scene, plan, kernel, cells);
    const std::vector<std::uint8_t> flags = certainty_of(scene, plan, kernel.run, cells);
    std::vector<cell_verdict> verdicts(cells.size());
    tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) {
        verdicts[i] = judge(scene, plan, cells[i], stored[i]);
    });
    tally found;
    found.cells = found.evaluated = cells.size();
    for (std::size_t i = 0; i < cells.size(); ++i) {
        found.flagged += flags[i] != 0 ? 1 : 0;
        found.wrong += verdicts[i].agrees() ? 0 : 1;
        if (verdicts[i].agrees() || flags[i] != 0) continue;
        ++found.wrong_unflagged;
        complain(i, verdicts[i]);
    }
    return found;
}

/// How the cells of a line are judged.
struct line_check {
    std::size_t stride = 64;         // between cells that are evaluated in any case
    std::size_t most_flagged = 100;  // evaluations per line for the sake of flagged cells alone
    std::size_t check_every = 500;   // of the unflagged ones that brackets take for right
    std::size_t n_assumed = 0;       // of these, on all lines so far
};

/// The same for cells that stand on a line in their order: their true answers are bracketed (see
/// true_line.hpp).
inline tally judge_line(const scene& line, const label_plan& plan, const kernel_choice& kernel,
                        line_check& how, const complaint& complain) {
    const std::vector<std::uint64_t> cells = all_cells_of(line);
    const std::vector<int> stored = answers_of(line, plan, kernel, cells);
    const std::vector<std::uint8_t> flags = certainty_of(line, plan, kernel.run, cells);
    true_line truth(line, plan, stored, flags);
    truth.bracket(how.stride, how.most_flagged);
    tally found;
    found.cells = cells.size();
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const bool is_assumed = !truth.is_evaluated(i) && flags[i] == 0;
        if (is_assumed && ++how.n_assumed % how.check_every == 0) {
            truth.evaluate(i);
            ++found.checked;
            found.checked_wrong += truth.is_wrong(i) ? 1 : 0;
        }
        found.flagged += flags[i] != 0 ? 1 : 0;
        found.wrong += truth.is_wrong(i) ? 1 : 0;
        if (!truth.is_wrong(i) || flags[i] != 0) continue;
        ++found.wrong_unflagged;
        complain(i, truth.verdict(i));
    }
    found.evaluated = truth.n_evaluated();
    return found;
}

/// Where the i-th line lies, as a share of the axes it does not follow.
inline double place_of_line(int i) { return std::fmod(0.25 + 0.618033988749895 * i, 1.0); }

}  // namespace hopscotch::hard
