// The plain data that passes between host and kernels: which cells to compute, when an orbit is
// decided, and where the results go. The same structure serves every backend and target.
#pragma once

#include "kernels/contract/info.hpp"

#include <cstdint>

namespace hopscotch {

/// Where one number of a cell comes from: a table along an axis, a list of rows, or a constant
/// (size 1).
struct column_source {
    const double* values = nullptr;
    std::uint64_t stride = 1;
    std::uint64_t size = 1;

    constexpr std::uint64_t index(std::uint64_t cell) const { return (cell / stride) % size; }
    constexpr double at(std::uint64_t cell) const { return values[index(cell)]; }
};

/// States between the two ends (both included) of the section's first column carry `label`.
struct trap_interval {
    double lowest;
    double highest;
    std::int32_t label;
};

/// States x of the section with |A (x - centre)| <= 1 (2-norm) carry `label` (see
/// kernels/ensemble/traps.hpp). A column that the flow conserves has zeros in A.
struct trap_ellipsoid {
    std::int32_t n_columns;
    std::int32_t label;
    double centre[most_columns];
    double shape[most_columns * most_columns];  // A, n_columns x n_columns, row by row
};

/// What decides an orbit, besides its own end.
enum class decision : std::uint8_t {
    returns,      // nothing: the orbit runs for the returns asked for
    certificate,  // the model's own proof
    intervals,    // entering one of the trap intervals of its parameter point
    ellipsoids,   // the model's own proof, where it has one, or entering a trap ellipsoid
};

/// How Lyapunov exponents are estimated, and where they go; only tangent ensembles look at it.
struct exponent_request {
    std::uint32_t transient = 1000;   // returns left out first, at least 1
    std::uint32_t block = 100;        // returns per block mean
    std::uint32_t least_blocks = 16;  // before an estimate may stop early
    double error = 0.0;               // standard error at which it stops early; 0: never
    double significance = 3.0;        // standard errors from zero that decide the motion

    /// Directions of the columns that returns end on. Where returns conserve columns (a runner's
    /// speed), the first n_free directions are those of the others: they are kept among themselves,
    /// so that the first exponents are those of the motion at fixed conserved columns; the last
    /// ones, of the conserved columns, are zero. See tangent_space::keep_free.
    int direction[most_columns] = {0, 1, 2, 3, 4, 5, 6, 7};
    int n_free = most_columns;

    double* exponents[most_columns] = {};  // per return, largest first, conserved columns' last
    double* rate = nullptr;                // the first per unit of time
    double* standard_error = nullptr;      // of the first per return
    std::uint32_t* returns = nullptr;      // that the estimate rests on
    std::uint8_t* motion = nullptr;        // see contract/motion.hpp
};

/// One rectangle of cells (or list of rows) for one kernel call. Null results are not wanted.
struct ensemble_request {
    std::uint64_t n_cells = 0;
    int section = 0;
    int end_section = 0;  // whose columns completed returns are read on; filled in by the kernel
    column_source columns[most_columns];
    column_source parameters[most_parameters];
    int options[most_options] = {};

    std::uint32_t max_returns = 1;
    double max_steps = 1e5;  // steps of work per return before the outcome `budget`
    double tolerance = 0.0;  // of integrated flows, see kernels/integrators/taylor.hpp; 0: 2^-47
    decision decided_by = decision::returns;
    std::int16_t died_label = 0;  // label of orbits that end by the outcome `stuck` or `rest`

    const trap_interval* traps = nullptr;  // [parameter point][n_traps]
    int n_traps = 0;
    const trap_ellipsoid* ellipsoids = nullptr;  // [parameter point][n_ellipsoids]
    int n_ellipsoids = 0;
    column_source trap_point;  // value = index of the cell's parameter point

    std::int16_t* label = nullptr;
    std::uint8_t* outcome = nullptr;
    std::uint32_t* returns = nullptr;
    std::uint32_t* events = nullptr;
    double* time = nullptr;
    double* state[most_columns] = {};
    double* extras[most_extras] = {};
    exponent_request exponents;
};

/// How full the lanes were: steps that advanced a trajectory over steps issued.
struct lane_statistics {
    std::uint64_t issued = 0;
    std::uint64_t useful = 0;

    constexpr double efficiency() const {
        return issued == 0 ? 1.0 : static_cast<double>(useful) / static_cast<double>(issued);
    }
    constexpr lane_statistics& operator+=(const lane_statistics& other) {
        issued += other.issued;
        useful += other.useful;
        return *this;
    }
};

using ensemble_function = lane_statistics (*)(const ensemble_request&);

enum class backend : std::uint8_t { scalar, avx2, avx512, cuda };
inline constexpr int n_backends = 4;

}  // namespace hopscotch
