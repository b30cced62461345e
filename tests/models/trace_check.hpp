// An observer for model tests: phases must follow each other in time, and states must join from
// phase to event to phase.
#pragma once

#include "tests/models/orbit_runner.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hopscotch::testing_models {

struct trace_check : orbit_observer {
    trace_check(int columns, double close) : n_columns(columns), tolerance(close) {}

    void phase(const char* mode, double start, double duration, const sampler& at) override {
        if (end == end) EXPECT_NEAR(start, end, tolerance) << mode;
        double from[most_columns];
        at.state_at(0.0, from);
        compare(from, mode);
        at.state_at(duration, last);
        has_last = true;
        end = start + duration;
    }
    void event(const char* name, double time, const char*, const char*, const double* before,
               const double* after, double) override {
        ++events;
        if (end == end) EXPECT_NEAR(time, end, tolerance) << name;
        end = time;
        compare(before, name);
        for (int i = 0; i < n_columns; ++i) last[i] = after[i];
        has_last = true;
    }
    void compare(const double* state, const char* what) const {
        for (int i = 0; has_last && i < n_columns; ++i) {
            EXPECT_NEAR(state[i], last[i], tolerance) << what << ", column " << i;
        }
    }

    int n_columns;
    double tolerance;
    double end = std::nan("");
    double last[most_columns] = {};
    bool has_last = false;
    int events = 0;
};

/// Traces a row and compares the end of the last phase with the time of the answer.
template <class Model>
int trace_row(const model_row& row, double tolerance) {
    const std::vector<int> options = chosen_options<Model>(row);
    const std::vector<std::string> parameters = all_parameters<Model>(row);
    std::vector<double> numbers;
    for (const std::string& text : parameters) numbers.push_back(parse_real<double>(text));
    orbit_row orbit{.section = index_of_section<Model>(row.section), .options = options.data()};
    orbit.variant = Model::variant({numbers.data(), numbers.data(), options.data()});
    orbit.columns = row.columns;
    orbit.parameters = parameters;
    orbit.returns = row.returns;
    trace_check check(static_cast<int>(Model::info.trace_columns.size()), tolerance);
    const orbit_answer answer = orbits_of<Model>().trace(orbit, check);
    EXPECT_NEAR(check.end, number(answer.time), tolerance);
    EXPECT_EQ(check.events, static_cast<int>(answer.events));
    return check.events;
}

}  // namespace hopscotch::testing_models
