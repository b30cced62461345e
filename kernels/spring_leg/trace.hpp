// What `trace` shows of a spring-mass runner: stances, flights and events in metres about the
// foothold of the phase. Compiled only for a Watch that is active, hence for one lane.
#pragma once

#include "kernels/spring_leg/stance_under_gravity.hpp"
#include "kernels/spring_leg/stride.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::spring_leg {

/// Translates dimensionless motion into phases and events.
template <bool IsAir, class Watch>
struct reporter {
    Watch& watch;

    template <class Real>
    void event(const char* name, const runner<Real>& lane, const Real& time, const char* left,
               const char* entered) {
        const Real state[] = {lane.x * lane.leg, lane.y * lane.leg, lane.x_rate * lane.speed,
                              lane.y_rate * lane.speed};
        watch.event(name, time, left, entered, state, state, Real(0.0));
    }

    /// A step of stance that lasted until `s`.
    template <class Real>
    void stance(const runner<Real>& lane, const stance_series<Real>& a, const Real& s,
                const Real& start, const Real& duration) {
        watch.phase("stance", start, duration * lane.time_unit, [&](Real t, Real* columns) {
            const Real wanted = t / lane.time_unit;
            const auto rising = [&](const Real& x) {
                auto at = taylor::value_slope(a.time, x);
                at.value = at.value - wanted;
                return at;
            };
            const Real at =
                IsAir ? wanted
                      : bracketed_root<Real>(rising, {Real(0.0), s}, s * Real(0.5), s > Real(0.0));
            columns[0] = taylor::evaluate(a.x, at) * lane.leg;
            columns[1] = taylor::evaluate(a.y, at) * lane.leg;
            columns[2] = taylor::evaluate(a.x_rate, at) * lane.speed;
            columns[3] = taylor::evaluate(a.y_rate, at) * lane.speed;
        });
    }

    /// Lift-off of a lane at (x, y, rates), and the flight that follows if it ends in a touchdown.
    template <class Real>
    void flight(const runner<Real>& lane, const Real& time) {
        event("lift-off", lane, time, "stance", "flight");
        const lift_off<Real> from{lane.x_rate, lane.y_rate, lane.y - lane.beta_sin};
        const stride_end<Real> next = fly(from, lane.gravity);
        if (next.ended == code_of<Real>(outcome::stumble)) return;
        watch.phase("flight", time, next.flight * lane.time_unit, [&](Real t, Real* columns) {
            const Real s = t / lane.time_unit;
            const Real fall = lane.gravity * s;
            columns[0] = fma(s, lane.x_rate, lane.x) * lane.leg;
            columns[1] = fma(s, lane.y_rate - Real(0.5) * fall, lane.y) * lane.leg;
            columns[2] = lane.x_rate * lane.speed;
            columns[3] = (lane.y_rate - fall) * lane.speed;
        });
    }

    /// Stance and flight of a stride whose stance neglects gravity, integrated for show.
    template <class Real>
    void gravity_free_stride(runner<Real> lane) {
        const auto velocity = sin_cos(lane.angle);
        lane.x = -lane.beta_cos;
        lane.y = lane.beta_sin;
        lane.x_rate = velocity.cos;
        lane.y_rate = -velocity.sin;
        lane.length = Real(1.0);
        const Real closing = cos(lane.beta - lane.angle);
        event("touchdown", lane, lane.time, "flight", "stance");
        if (!(closing > Real(0.0))) return;
        Real now = lane.time;
        for (int i = 0; i < 1000; ++i) {
            stance_series<Real> a;
            a.x.c[0] = lane.x;
            a.y.c[0] = lane.y;
            a.x_rate.c[0] = lane.x_rate;
            a.y_rate.c[0] = lane.y_rate;
            a.length.c[0] = lane.length;
            if constexpr (IsAir) {
                expand_air(a, lane.stiffness, Real(0.0));
            } else {
                expand_linear(a, lane.stiffness, Real(0.0));
            }
            const auto step =
                advance(a, Real(i == 0 ? 1.0 : 0.0), IsAir ? Real(2.0) * closing : closing,
                        Real(taylor::default_tolerance<Real>), true);
            if (step.broken || step.unresolved) return;
            const Real s = step.length_of_step;
            const Real passed = taylor::evaluate(a.time, s);
            stance(lane, a, s, now, passed);
            now = fma(passed, lane.time_unit, now);
            lane.x = taylor::evaluate(a.x, s);
            lane.y = taylor::evaluate(a.y, s);
            lane.x_rate = taylor::evaluate(a.x_rate, s);
            lane.y_rate = taylor::evaluate(a.y_rate, s);
            lane.length = taylor::evaluate(a.length, s);
            if (step.grounds) return event("ground", lane, now, "stance", "ground");
            if (step.lifts) return flight(lane, now);
        }
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::spring_leg
