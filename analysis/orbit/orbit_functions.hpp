// Single orbits of a model in any arithmetic: what `eval --precision`, `--derivative`, `trace`,
// `replay` and the audit call. Filled per model by a generated unit; numbers travel as decimal text
// so that no precision is lost on the way.
#pragma once

#include "analysis/orbit/enclosed_orbit.hpp"
#include "kernels/contract/info.hpp"
#include "kernels/contract/motion.hpp"
#include "kernels/ensemble/request.hpp"

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace hopscotch {

/// One orbit to compute. Columns and parameters are decimals of any length, in the order of
/// model_info.
struct orbit_row {
    int section = 0;
    const int* options = nullptr;
    int variant = 0;  // compile-time variant, from model_entry::variant
    std::span<const std::string> columns;
    std::span<const std::string> parameters;
    std::uint32_t returns = 1;
    double max_steps = 1e5;  // per return
    double tolerance = 0.0;  // of integrated flows, as in ensemble_request; only double heeds it
    bool derivative = false;

    // to label the orbit instead of counting its returns
    decision decided_by = decision::returns;
    std::span<const trap_interval> traps;
    std::span<const trap_ellipsoid> ellipsoids;
    std::int16_t died_label = 0;
};

struct orbit_answer {
    outcome end = outcome::ok;
    int label = 0;
    std::uint32_t returns = 0;
    std::uint64_t events = 0;
    std::string time;
    std::vector<std::string>
        columns;  // of the section the returns end on; empty where there is no state
    std::vector<std::string> extras;
    std::vector<std::string> derivative;  // d(column i)_d(start column j), row by row
};

/// A point of a return map whose derivatives are wanted. Unlike orbit_row all numbers are doubles:
/// for searches that evaluate the map many thousand times.
struct jet_query {
    int section = 0;
    const int* options = nullptr;
    int variant = 0;
    const double* columns = nullptr;     // one per column of the section
    const double* parameters = nullptr;  // one per parameter of the model
    std::uint32_t returns = 1;
    double max_steps = 1e5;  // per return
    double tolerance = 0.0;  // of integrated flows, as in ensemble_request
    int by_parameter = -1;   // also differentiate by this parameter
};

/// P^returns at one point with its exact derivatives (through events), in double. The values are
/// bit for bit those of the kernels.
struct return_jet {
    outcome end = outcome::ok;  // the numbers below mean nothing unless it is ok
    std::uint32_t returns = 0;
    std::uint64_t events = 0;
    double time = 0.0;
    double state[most_columns] = {};                     // of the section the returns end on
    double derivative[most_columns][most_columns] = {};  // d state[i] / d columns[j]
    double parameter_derivative[most_columns] = {};      // d state[i] / d parameter
};

/// Lyapunov exponents of one orbit, per return and largest first; NaN where there is none.
struct exponent_answer {
    outcome end = outcome::ok;
    std::uint32_t returns = 0;  // completed, transient included
    enum motion motion = motion::ended;
    double standard_error = 0.0;  // of the largest one
    double exponents[most_columns] = {};
};

/// What an orbit meets at its model's contact (kernels/contract/contact.hpp); NaN where it meets
/// none. Gaps count at their turning points between the orbit's start and its end.
struct orbit_survey {
    outcome end = outcome::ok;
    std::uint32_t returns = 0;
    double clearance = std::numeric_limits<double>::quiet_NaN();     // the smallest minimum
    double hop_height = std::numeric_limits<double>::quiet_NaN();    // the smallest maximum
    double impact_speed = std::numeric_limits<double>::quiet_NaN();  // the largest
};

/// Watches one orbit (see kernels/contract/watch.hpp). `sampler(t, columns)` gives the state t
/// after the beginning of the phase.
struct orbit_observer {
    struct sampler {
        virtual void state_at(double t, double* columns) const = 0;

    protected:
        ~sampler() = default;
    };
    virtual void phase(const char* mode, double start_time, double duration, const sampler& at) = 0;
    virtual void event(const char* name, double time, const char* mode_left,
                       const char* mode_entered, const double* before, const double* after,
                       double loss) = 0;

protected:
    ~orbit_observer() = default;
};

/// The orbits of one model.
struct orbit_functions {
    orbit_answer (*run_double)(const orbit_row&);
    orbit_answer (*run_dd)(const orbit_row&);
    orbit_answer (*run_mp50)(const orbit_row&);
    orbit_answer (*trace)(const orbit_row&, orbit_observer&);  // in double
    return_jet (*jet)(const jet_query&);
    exponent_answer (*exponents)(const orbit_row&, const exponent_request&);  // in double-double
    enclosed_returns (*enclose)(const enclosed_query&);  // over whole sets of starts
    orbit_survey (*survey)(const jet_query&);  // in double; null where the model has no contact
};

}  // namespace hopscotch
