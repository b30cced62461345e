// What `trace` shows of a pitching runner: stances, flights and events in metres about the foothold of the
// phase. Compiled only for a Watch that is active, hence for one lane.
#pragma once

#include "kernels/spring_leg/pitching_flight.hpp"
#include "kernels/spring_leg/pitching_stance.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::spring_leg {

/// Translates scaled motion into phases and events.
template <bool IsAir, class Watch>
struct pitching_reporter {
    Watch& watch;

    /// Hip, velocity of the centre and pitch as the columns of the trace.
    template <class Real>
    static void columns_of(const pitching_runner<Real>& lane, const Real& x, const Real& y,
                           const Real& x_rate, const Real& y_rate, const Real& turn,
                           const Real& turn_rate, Real* columns) {
        columns[0] = fma(lane.hip, sin(turn), x) * lane.leg;
        columns[1] = fma(-lane.hip, cos(turn), y) * lane.leg;
        columns[2] = x_rate * lane.speed_unit;
        columns[3] = y_rate * lane.speed_unit;
        columns[4] = turn;
        columns[5] = turn_rate / lane.time_unit;
    }

    template <class Real>
    static void state_of(const pitching_runner<Real>& lane, Real* columns) {
        columns_of(lane, lane.x, lane.y, lane.x_rate, lane.y_rate, lane.turn, lane.turn_rate, columns);
    }

    template <class Real>
    void event(const char* name, const pitching_runner<Real>& lane, const Real& time, const char* left,
               const char* entered) {
        Real state[6];
        state_of(lane, state);
        watch.event(name, time, left, entered, state, state, Real(0.0));
    }

    /// A step of stance that lasted until `s`.
    template <class Real>
    void stance(const pitching_runner<Real>& lane, const pitching_series<Real>& a, const Real& s,
                const Real& start, const Real& duration) {
        watch.phase("stance", start, duration * lane.time_unit, [&](Real t, Real* columns) {
            const Real wanted = t / lane.time_unit;
            const auto rising = [&](const Real& x) {
                auto at = taylor::value_slope(a.time, x);
                at.value = at.value - wanted;
                return at;
            };
            const Real at = IsAir ? wanted
                                  : bracketed_root<Real>(rising, {Real(0.0), s}, s * Real(0.5), s > Real(0.0));
            columns_of(lane, taylor::evaluate(a.x, at), taylor::evaluate(a.y, at),
                       taylor::evaluate(a.x_rate, at), taylor::evaluate(a.y_rate, at),
                       taylor::evaluate(a.turn, at), taylor::evaluate(a.turn_rate, at), columns);
        });
    }

    /// The flight from the lane's lift-off, and the touchdown on a new foothold that ends it.
    template <class Real>
    void flight(const pitching_runner<Real>& lane, const Real& time, const Real& duration) {
        const auto state_at = [&](const Real& s, Real* columns) {
            const Real turn = fma(lane.turn_rate, s, lane.turn);
            const Real centre = fma(-lane.hip, cos(lane.turn), lane.y);
            const Real body_x = fma(s, lane.x_rate, fma(lane.hip, sin(lane.turn), lane.x));
            const Real body_y = fma(s, fma(Real(-0.5), s, lane.y_rate), centre);
            columns_of(lane, fma(-lane.hip, sin(turn), body_x), fma(lane.hip, cos(turn), body_y),
                       lane.x_rate, lane.y_rate - s, turn, lane.turn_rate, columns);
        };
        const Real seconds = duration * lane.time_unit;
        watch.phase("flight", time, seconds,
                    [&](Real t, Real* columns) { state_at(t / lane.time_unit, columns); });
        Real before[6];
        Real after[6];
        state_at(duration, before);
        state_at(duration, after);
        const Real leg_angle = fma(-lane.body, after[4], lane.beta);
        after[0] = fma(lane.hip, sin(after[4]), -cos(leg_angle)) * lane.leg;
        watch.event("touchdown", time + seconds, "flight", "stance", before, after, Real(0.0));
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::spring_leg
