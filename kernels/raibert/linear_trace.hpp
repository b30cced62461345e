// What `trace` shows of a hop on a linear spring: the phases between two sections and the events
// that join them, from the closed forms.
#pragma once

#include "kernels/raibert/linear_stance.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::raibert {

/// Height and velocity on a spring, t after shortening d, velocity v.
template <int Variant, class Lane>
void stance_state(const Lane& lane, double eta, double pull, double d, double v, double t,
                  double* columns) {
    const auto spring = linear_spring<Variant, double>::with(eta, lane.friction * 0.5);
    const auto at = spring.after(t, pull, v);
    columns[0] = lane.height - d + at.displacement;
    columns[1] = at.velocity;
}
/// From touchdown at that speed and time to the bottom.
template <int Variant, class Lane, class Watch>
void report_compression(const Lane& lane, double speed, double start, double duration,
                        Watch& watch) {
    const double at[] = {lane.height, -speed};
    watch.event("touchdown", start, "flight", "compression", at, at, 0.0);
    watch.phase("compression", start, duration, [&](double t, double* columns) {
        stance_state<Variant>(lane, lane.stiffness, pull_at_liftoff(lane), 0.0, -speed, t, columns);
    });
}
/// A whole return: from the section's state to the next one.
///
/// \param bottom  of the stance after the flight, shown where returns begin at the bottom
/// \param sinks   there is no bottom: the compression is not shown
template <int Variant, class Lane, class Bottom, class LiftOff, class Watch>
void report_hop(const Lane& lane, const LiftOff& end, double touchdown, const Bottom& bottom,
                bool sinks, bool from_bottom, bool to_apex, Watch& watch) {
    double now = lane.time;
    if (!from_bottom) {
        if (to_apex) {
            const double fall = lane.speed / lane.flight_gravity;
            const double apex = lane.height + 0.5 * lane.speed * fall;
            watch.phase("flight", now, fall, [&](double t, double* columns) {
                columns[0] = apex - 0.5 * lane.flight_gravity * t * t;
                columns[1] = -lane.flight_gravity * t;
            });
            now += fall;
        }
        if (sinks) return;
        report_compression<Variant>(lane, lane.speed, now, lane.compression, watch);
        now += lane.compression;
    }
    const auto pushed = [&](double t, double* columns) {
        const auto at = friction_factors_at(lane.friction * t);
        columns[0] = lane.height - lane.depth + lane.lift * t * t * at.second;
        columns[1] = lane.lift * t * at.first;
    };
    const bool has_thrust = lane.thrust_time > 0.0;
    double at[2];
    pushed(0.0, at);
    watch.event("bottom", now, "compression", has_thrust ? "thrust" : "decompression", at, at, 0.0);
    if (has_thrust) {
        watch.phase("thrust", now, end.thrust_time, pushed);
        now += end.thrust_time;
        pushed(end.thrust_time, at);
    }
    if (!end.is_cut) {
        if (has_thrust) watch.event("thrust end", now, "thrust", "decompression", at, at, 0.0);
        watch.phase("decompression", now, end.rise_time, [&](double t, double* columns) {
            stance_state<Variant>(lane, end.stiffness, end.pull, end.remaining, end.velocity, t,
                                  columns);
        });
        now += end.rise_time;
    }
    if (!end.exists) return;
    const double before[] = {lane.height, end.speed};
    const double after[] = {lane.height, touchdown};
    watch.event("lift-off", now, end.is_cut ? "thrust" : "decompression", "flight", before, after,
                0.5 * (end.speed * end.speed - touchdown * touchdown));
    const double rise = touchdown / lane.flight_gravity;
    watch.phase("flight", now, to_apex ? rise : 2.0 * rise, [&](double t, double* columns) {
        columns[0] = lane.height + t * (touchdown - 0.5 * lane.flight_gravity * t);
        columns[1] = touchdown - lane.flight_gravity * t;
    });
    now += 2.0 * rise;
    if (from_bottom && bottom.exists)
        report_compression<Variant>(lane, touchdown, now, bottom.time, watch);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::raibert
