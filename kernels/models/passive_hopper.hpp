// The passive hopper: body, foot and spring, falling on ground that absorbs every impact, and
// hopping for ever from one side of its lossless motions. Coordinates y1 v1 y2 v2 of CPRR Eq (2).
#pragma once

#include "kernels/passive/passive_model.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// y1: body, y2: foot, both zero with the foot on the ground and the spring relaxed.
struct hopper_coordinates {
    static constexpr bool has_gravity_gradient = true;
    template <class Real>
    HOPSCOTCH_DEVICE static passive::engine_state<Real> read(const Real* column, Real mass_ratio) {
        // y2 = v2 = 0 on the ground for every mass ratio, unbounded included
        const Real zero(0.0);
        const Real total = Real(1.0) + mass_ratio;
        return {column[0] - column[2], column[1] - column[3],
                select(column[2] == zero, zero, total * column[2]),
                select(column[3] == zero, zero, total * column[3])};
    }
    template <class Real>
    HOPSCOTCH_DEVICE static void write(const passive::engine_state<Real>& state, Real inverse_total,
                                       Real* column) {
        column[2] = state.gap * inverse_total;
        column[3] = state.gap_rate * inverse_total;
        column[0] = state.spring + column[2];
        column[1] = state.spring_rate + column[3];
    }
};

struct passive_hopper : passive::model<hopper_coordinates> {
    static constexpr column_info state[] = {
        {"y1", "1", any_finite, "body height, k x1 / (m2 g)"},
        {"v1", "1", any_finite, "body velocity dy1/dtau"},
        {"y2", "1", {0.0, unbounded, true, false}, "foot height above the ground"},
        {"v2", "1", any_finite, "foot velocity"}};
    static constexpr section_info sections[] = {
        {"liftoff", passive::lift_off_columns, 0,
         "lift-off from sustained contact (y1 = 1, y2 = v2 = 0)"},
        {"flight", state, 0, "any state with the foot on or above the ground; start only"}};
    static constexpr model_info info{
        .name = "passive_hopper",
        .title = "Passive hopper with plastic or elastic foot impacts",
        .reference = "Chatterjee, Pratap, Reddy, Ruina, Int. J. Robotics Research 21(7), 2002",
        .time_unit = "1",
        .parameters = passive::parameters,
        .sections = sections,
        .options = {},
        .extras = passive::extras,
        .outcomes = passive::outcomes,
        .trace_columns = state};

    static constexpr contact_info contact{"flight", "impact", "1", "1", "foot above the ground"};
    static contact_gap gap(const double* columns, const double*, const int*) {
        return {columns[2], columns[3]};
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
