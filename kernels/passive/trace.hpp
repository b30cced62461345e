// What `trace` shows of a passive orbit: phases and events in the model's own coordinates. Compiled
// only for a Watch that is active.
#pragma once

#include "kernels/contract/watch.hpp"
#include "kernels/passive/contact.hpp"
#include "kernels/passive/hopper_lane.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::passive {

/// The engine's coordinates of a state: spring extension and gap = (1 + M) y2 = w1 - w2, with
/// rates.
template <class Real>
struct engine_state {
    Real spring;
    Real spring_rate;
    Real gap;
    Real gap_rate;
};

/// Translates the return map's own words into phases and events; silent unless the Watch is active.
template <class Coordinates, class Watch>
struct reporter {
    static constexpr bool is_active = Watch::is_active;
    Watch& watch;

    template <class Real, class Flow>
    void flight(const hopper_lane<Real>& lane, const Flow& flow, Real duration) {
        watch.phase("flight", lane.time, duration, [&](Real t, Real* columns) {
            const auto spring = flow.spring.at(t);
            Coordinates::write(
                engine_state<Real>{spring.value, spring.rate, flow.gap(t), flow.gap_rate(t)},
                lane.inverse_total, columns);
        });
    }

    /// The impact at the end of the flight just reported; lane.time is the impact's.
    template <class Real>
    void impact(const hopper_lane<Real>& lane, Real eta, Real velocity, Real gap_rate, Real rebound,
                Real loss, bool stays) {
        Real before[4];
        Real after[4];
        const Real zero(0.0);
        const Real one(1.0);
        Coordinates::write(
            engine_state<Real>{one + eta, velocity - gap_rate * lane.inverse_total, zero, gap_rate},
            lane.inverse_total, before);
        Coordinates::write(
            engine_state<Real>{one + eta, velocity - rebound * lane.inverse_total, zero, rebound},
            lane.inverse_total, after);
        watch.event("impact", lane.time, "flight", stays ? "contact" : "flight", before, after,
                    loss);
    }

    /// Sustained contact that begins at lane.time.
    template <class Real>
    void contact(const hopper_lane<Real>& lane, const contact_start<Real>& start, bool lifts,
                 Real duration, Real speed) {
        const Real decay = lane.damping * lane.mu;
        const contact_motion<Real> motion{
            decay,        sqrt(fma(-decay, decay, lane.mu)),         lane.mu,
            lane.damping, Real(1.0) + lane.inverse_mass + start.eta, start.velocity};
        const auto sample = [&](Real t, Real* columns) {
            const auto body = motion.body(t);
            Coordinates::write(engine_state<Real>{body.value - lane.inverse_mass, body.slope,
                                                  Real(0.0), Real(0.0)},
                               lane.inverse_total, columns);
        };
        const Real shown = lifts ? duration : Real(2.0) * pi<Real>() / motion.frequency;
        watch.phase("contact", lane.time, shown, sample);
        if (!lifts) return;
        Real before[4];
        sample(duration, before);
        Real after[4];
        const Real launched = speed + lane.increment;
        Coordinates::write(engine_state<Real>{Real(1.0) - Real(2.0) * lane.damping * launched,
                                              launched, Real(0.0), Real(0.0)},
                           lane.inverse_total, after);
        watch.event("lift-off", lane.time + duration, "contact", "flight", before, after,
                    Real(0.0));
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::passive
