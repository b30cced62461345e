// What `trace` shows of a passive orbit with nonlinear terms: the phases and events of trace.hpp,
// one phase per integrator step.
#pragma once

#include "kernels/passive/nonlinear_flow.hpp"
#include "kernels/passive/trace.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::passive {

template <class Coordinates, class Watch>
struct nonlinear_reporter {
    static constexpr bool is_active = Watch::is_active;
    Watch& watch;

    template <class Real>
    void phase(const nonlinear_lane<Real>& lane, const nonlinear_motion<Real>& a, Real duration) {
        const bool grounded = lane.in_contact > Real(0.0);
        const Real began = grounded ? lane.time + lane.contact_time : lane.time;
        watch.phase(grounded ? "contact" : "flight", began, duration, [&](Real t, Real* columns) {
            write(lane, taylor::evaluate(a.s, t), taylor::evaluate(a.rate, t),
                  taylor::evaluate(a.gap, t), a.gap_rate(t), columns);
        });
    }

    /// The impact at lane.time; the lane holds the state before it.
    template <class Real>
    void impact(const nonlinear_lane<Real>& lane, Real body_rate, Real leaving, Real loss,
                bool stays) {
        Real before[4];
        Real after[4];
        const Real zero(0.0);
        write(lane, lane.s, lane.rate, zero, lane.gap_rate, before);
        write(lane, lane.s, fma(-leaving, lane.inverse_total, body_rate), zero, leaving, after);
        watch.event("impact", lane.time, "flight", stays ? "contact" : "flight", before, after,
                    loss);
    }

    /// The lift-off at lane.time; `launched` is the speed after the increment.
    template <class Real>
    void lift_off(const nonlinear_lane<Real>& lane, Real launched) {
        Real before[4];
        Real after[4];
        const Real zero(0.0);
        nonlinear_lane<Real> next = lane;
        next.alpha = launched;
        launch_from_section(next, true);
        write(lane, lane.s, lane.rate, zero, zero, before);
        write(lane, next.s, next.rate, zero, zero, after);
        watch.event("lift-off", lane.time, "contact", "flight", before, after, zero);
    }

private:
    template <class Real>
    static void write(const nonlinear_lane<Real>& lane, const Real& s, const Real& rate,
                      const Real& gap, const Real& gap_rate, Real* columns) {
        Coordinates::write(engine_state<Real>{s, rate, gap, gap_rate}, lane.inverse_total, columns);
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::passive
