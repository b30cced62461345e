// A user's own model in one header: a ball that loses a share of its speed at every bounce.
#pragma once

#include "kernels/contract/model.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

struct bouncing_ball {
    static constexpr parameter_info parameters[] = {
        {"restitution", "e", "1", 0.8, {0.0, 1.0}, "speed after over speed before a bounce"},
        {"gravity", "g", "m/s^2", 9.81, positive, "acceleration of gravity"}};
    static constexpr column_info columns[] = {
        {"speed", "m/s", {0.0, unbounded, true, false}, "upward speed just after a bounce"}};
    static constexpr section_info sections[] = {{"bounce", columns, 0, "just after a bounce"}};
    static constexpr outcome outcomes[] = {outcome::ok};
    static constexpr model_info info{.name = "bouncing_ball",
                                     .title = "Bouncing ball",
                                     .reference = "this file",
                                     .time_unit = "s",
                                     .parameters = parameters,
                                     .sections = sections,
                                     .options = {},
                                     .extras = {},
                                     .outcomes = outcomes,
                                     .trace_columns = columns};

    static constexpr int n_variants = 1;
    static int variant(const variant_query&) { return 0; }
    static std::string_view refusal(const double*, const int*) { return {}; }

    template <class Real>
    struct lane {
        Real restitution, gravity, speed, time, events;
    };

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> begin(lane<Real>& ball, int, const Real* column,
                                                 const Real* parameter, const int*, Watch&) {
        ball = {parameter[0], parameter[1], column[0], Real(0.0), Real(0.0)};
        const mask_of<Real> valid = column[0] >= Real(0.0);
        return {!(valid | !valid), select(valid, Real(0.0), code_of<Real>(outcome::invalid_start))};
    }

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> step(lane<Real>& ball, mask_of<Real> active, Watch&) {
        ball.time = select(active, fma(Real(2.0), ball.speed / ball.gravity, ball.time), ball.time);
        ball.speed = select(active, ball.restitution * ball.speed, ball.speed);
        ball.events = select(active, ball.events + Real(1.0), ball.events);
        return {active, Real(0.0)};
    }

    template <class Real>
    HOPSCOTCH_DEVICE static void read_state(const lane<Real>& ball, int, Real* column) {
        column[0] = ball.speed;
    }
    template <class Real>
    HOPSCOTCH_DEVICE static void read_extras(const lane<Real>&, Real*) {}
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
