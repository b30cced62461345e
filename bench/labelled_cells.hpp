// Cells of one scene with their true answers: labels, or returns before the fall. What the wrong
// share of every kernel and every solver is measured on.
#pragma once

#include "bench/yardstick_case.hpp"
#include "host/run/label_plan.hpp"
#include "host/run/labelled_run.hpp"
#include "host/run/truth_orbits.hpp"
#include "host/scene/scene.hpp"

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace hopscotch::bench {

/// A scene whose map is drawn, and who else can draw it.
struct labelled_scene {
    std::string name;
    std::string scene;  // of configs/scenes/
    std::vector<std::string> overrides;
    std::string yardstick;  // name of the case in bench/systems/ with the same model; may be empty
    bool is_integrated = false;  // then kernels are run over a ladder of tolerances
    bool is_slow = false;        // its truth takes seconds per cell: fewer cells
};

/// Every model's scene.
const std::vector<labelled_scene>& labelled_scenes();

/// Wrong answers among cells drawn from the whole grid, and among cells at distances 1e-15 to 1e-1
/// of the axis (evenly in its logarithm) from places where the answer changes.
struct wrong_answers {
    double grid = 0.0;
    double boundary = 0.0;
};

class labelled_cells {
public:
    /// Finds boundaries and computes the truth: double-double, and 50 digits where they disagree
    /// with double.
    explicit labelled_cells(const labelled_scene& which);

    std::size_t n_grid() const { return groups_.front().cells.size(); }
    std::size_t n_boundary() const;
    const scene& whole() const { return groups_.front().what; }
    const label_plan& plan() const { return groups_.front().plan; }

    /// The share that a kernel answers wrongly. \param tolerance  0: its full precision
    wrong_answers of_kernel(const kernel_run& kernel, double tolerance) const;

    /// What is timed of a kernel: the answers of these cells of the grid.
    void compute(const std::vector<std::uint64_t>& cells, const kernel_run& kernel,
                 double tolerance) const;

    /// The share of these cells of the grid that two kernels answer differently.
    double difference(const std::vector<std::uint64_t>& cells, const kernel_run& one,
                      double tolerance, const kernel_run& other) const;

    /// The share that a general solver answers wrongly which stops at the same traps. \param
    /// cells_per_second  over the cells from the grid
    wrong_answers of_solver(const yardstick_maker& make, double tolerance,
                            double& cells_per_second) const;

    /// Double-double against 50 digits, over the cells that double-double and double answer
    /// differently; others count as right.
    wrong_answers of_double_double() const { return double_double_; }
    /// Of single orbits, one after the other.
    double double_double_cells_per_second() const;

private:
    using answer = std::int64_t;

    /// Cells of one scene under one plan. Their requests point into both.
    struct group {
        scene what;
        label_plan plan;
        std::vector<std::uint64_t> cells;
        std::vector<answer> truth;
    };

    void add_boundaries(const labelled_scene& which);
    void add_around(const scene& line, const label_plan& plan, double at);
    void find_truth();
    answer precise(const group& of, std::uint64_t cell, precision value) const;
    std::vector<answer> answers(const group& of, const std::vector<std::uint64_t>& cells,
                                const kernel_run& kernel, double tolerance) const;
    answer answer_of(const group& of, std::uint64_t cell, const yardstick_maker& make,
                     double tolerance) const;

    /// The shares of wrong answers where `answers_of(group)` gives all those of a group.
    template <class Answers>
    wrong_answers wrong_share(const Answers& answers_of) const;

    std::deque<group> groups_;  // the first is the grid's, the others lie around boundaries
    wrong_answers double_double_;
};

}  // namespace hopscotch::bench
