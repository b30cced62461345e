// A juggler's return from any state, for the tests of starts.
#pragma once

#include "tests/models/passive_rows.hpp"
#include "tests/models/passive_truth.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hopscotch::testing_models::contact_starts {

using passive_rows::answers;
using passive_rows::hop;
using passive_rows::rows;
using passive_rows::run;
using passive_rows::single_return;
using passive_rows::start;

constexpr double inf = std::numeric_limits<double>::infinity();

inline single_return juggle(double w1, double w1dot, double w2, double w2dot, double mass_ratio,
                            double restitution = 0.0, double damping = 0.0) {
    const answers one = run({.model = "passive_juggler",
                             .section = passive_rows::flight,
                             .columns = {{w1}, {w1dot}, {w2}, {w2dot}},
                             .mass_ratio = {mass_ratio},
                             .restitution = {restitution},
                             .damping = {damping}});
    return {one.end[0], one.speed[0], one.bounces[0], one.loss[0], one.time[0]};
}

}  // namespace hopscotch::testing_models::contact_starts
