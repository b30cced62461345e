// The passive juggler: a ball thrown and caught by a hand on a spring. The passive hopper's
// equations in the coordinates w1 (ball) and w2 (hand) of CPRR Eq (4); mass_ratio may be infinite.
#pragma once

#include "kernels/passive/passive_model.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// w1: ball, w2: hand; the ball lies on the hand where w1 = w2, and the hand's spring is relaxed at
/// w2 = 0.
struct juggler_coordinates {
    static constexpr bool has_gravity_gradient = false;
    template <class Real>
    HOPSCOTCH_DEVICE static passive::engine_state<Real> read(const Real* column, Real) {
        return {column[2] + Real(1.0), column[3], column[0] - column[2], column[1] - column[3]};
    }
    template <class Real>
    HOPSCOTCH_DEVICE static void write(const passive::engine_state<Real>& state, Real,
                                       Real* column) {
        column[2] = state.spring - Real(1.0);
        column[3] = state.spring_rate;
        column[0] = column[2] + state.gap;
        column[1] = column[3] + state.gap_rate;
    }
};

struct passive_juggler : passive::model<juggler_coordinates> {
    static constexpr column_info state[] = {{"w1", "1", any_finite, "ball height, k u1 / (m2 g)"},
                                            {"w1dot", "1", any_finite, "ball velocity"},
                                            {"w2", "1", any_finite, "hand height"},
                                            {"w2dot", "1", any_finite, "hand velocity"}};
    static constexpr section_info sections[] = {
        {"liftoff", passive::lift_off_columns, 0,
         "the ball leaves the hand after sustained contact"},
        {"flight", state, 0, "any state with the ball on or above the hand; start only"}};
    static constexpr model_info info{
        .name = "passive_juggler",
        .title = "Passive juggler: ball, hand and spring",
        .reference = "Chatterjee, Pratap, Reddy, Ruina, Int. J. Robotics Research 21(7), 2002",
        .time_unit = "1",
        .parameters = passive::parameters,
        .sections = sections,
        .options = {},
        .extras = passive::extras,
        .outcomes = passive::outcomes,
        .trace_columns = state};

    static constexpr contact_info contact{"flight", "impact", "1", "1", "ball above the hand"};
    static contact_gap gap(const double* columns, const double*, const int*) {
        return {columns[0] - columns[2], columns[1] - columns[3]};
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
