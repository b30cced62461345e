// A ball on a sinusoidally moving paddle: impacts, chatter that provably completes, sustained
// contact and release. With restitution 0 it is Shannon's catch-and-release juggler. Source: Schaal
// and Atkeson 1993; Chatterjee, Pratap, Reddy and Ruina 2002, sections 2.1, 9, 11;
// models/paddle_juggler.md.
#pragma once

#include "kernels/contract/model.hpp"
#include "kernels/lanes/implicit_root.hpp"
#include "kernels/paddle/ball_gap.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// Units: gravity 1, angular frequency of the paddle 1; the paddle is at Gamma sin(phase).
struct paddle_juggler {
    static constexpr parameter_info parameters[] = {
        {"amplitude", "Gamma", "1", 1.2, positive,
         "peak acceleration of the paddle over gravity, A omega^2 / g"},
        {"restitution",
         "e",
         "1",
         0.5,
         {0.0, 1.0, true, false},
         "restitution; 0 catches or leaves at once"},
    };
    enum parameter_index { amplitude, restitution };
    static constexpr column_info impact_columns[] = {
        {"phase", "rad", any_finite, "theta, phase of the paddle just after the impact"},
        {"relative_velocity", "1", any_finite,
         "U, velocity of the ball relative to the paddle just after the impact; below zero: just "
         "before it"}};
    static constexpr section_info sections[] = {
        {"impact", impact_columns, 0,
         "just after an impact, or the release after sustained contact"}};
    static constexpr extra_info extras[] = {
        {"sticks", "1", "catches: impacts that end in sustained contact"}};
    static constexpr outcome outcomes[] = {outcome::ok, outcome::rest, outcome::unresolved_event};
    static constexpr column_info state[] = {
        {"ball_height", "1", any_finite, "height of the ball"},
        {"ball_velocity", "1", any_finite, "velocity of the ball"},
        {"paddle_height", "1", any_finite, "height of the paddle"},
        {"paddle_velocity", "1", any_finite, "velocity of the paddle"}};
    static constexpr model_info info{.name = "paddle_juggler",
                                     .title = "Ball on a sinusoidal paddle; Shannon's juggler",
                                     .reference =
                                         "Schaal, Atkeson, ICRA 1993; Chatterjee, Pratap, Reddy, "
                                         "Ruina, IJRR 21(7), 2002, section 9",
                                     .time_unit = "1",
                                     .parameters = parameters,
                                     .sections = sections,
                                     .options = {},
                                     .extras = extras,
                                     .outcomes = outcomes,
                                     .trace_columns = state};

    static constexpr contact_info contact{"flight", "impact", "1", "1", "ball above the paddle"};
    static contact_gap gap(const double* columns, const double*, const int*) {
        return {columns[0] - columns[2], columns[1] - columns[3]};
    }

    static constexpr int n_variants = 1;
    static int variant(const variant_query&) { return 0; }
    static constexpr std::string_view refusal(const double*, const int*) { return {}; }
    /// The phase wraps.
    static constexpr double turn(int, int column, const double*) {
        return column == 0 ? 0x1.921fb54442d18p+2 : 0.0;
    }

    static constexpr int n_parameter_fields = 3;
    template <class Real>
    struct lane {
        Real amplitude;
        Real restitution;
        Real convex_from;  // phi_1: the paddle falls faster than the ball from here to pi - phi_1
        Real phase;
        Real speed;         // U
        Real is_released;   // 1: at the release state, on the inflection itself
        Real turns;         // forcing periods since the last release
        Real has_released;  // 1: there was one
        Real cycle;         // periods between the last two releases, 0 before
        Real sticks;
        Real time;
        Real events;
    };

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> begin(lane<Real>& lane, int, const Real* columns,
                                                 const Real* parameter, const int*, Watch& watch) {
        const Real zero(0.0);
        const Real one(1.0);
        lane.amplitude = parameter[amplitude];
        lane.restitution = parameter[restitution];
        lane.convex_from = paddle::first_convex_phase(lane.amplitude);
        lane.is_released = lane.turns = lane.has_released = lane.cycle = zero;
        lane.sticks = lane.time = lane.events = zero;
        const mask_of<Real> valid =
            (columns[0] - columns[0] == zero) & (columns[1] - columns[1] == zero);
        lane.phase = within_turn(select(valid, columns[0], zero)).phase;
        const Real speed = select(valid, columns[1], one);
        const mask_of<Real> impacts = valid & (speed < zero);
        lane.speed = select(impacts, -(lane.restitution * speed), speed);
        lane.events = select(impacts, one, zero);
        const mask_of<Real> stays = (valid & (lane.speed == zero) & !falls_away(lane, lane.phase)) |
                                    (impacts & chatter_completes(lane, lane.phase, lane.speed));
        if constexpr (Watch::is_active) {
            if (impacts)
                report_impact(lane, lane.phase, speed, lane.speed, lane.time, stays, watch);
            if (stays) report_contact(lane, lane.phase, lane.time, watch);
        }
        const mask_of<Real> rests = stays & !(lane.amplitude > one);
        lane.sticks = select(impacts & stays, one, zero);
        release(lane, lane.phase, stays & !rests);
        const mask_of<Real> none = valid & !valid;
        const Real ended = select(rests, code_of<Real>(outcome::rest), zero);
        return {none, select(valid, ended, code_of<Real>(outcome::invalid_start))};
    }

    /// One flight, its impact, and sustained contact up to the release where the ball is caught.
    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> step(lane<Real>& lane, mask_of<Real> active,
                                                Watch& watch) {
        using plain = primal_of<Real>;
        const Real zero(0.0);
        const Real one(1.0);
        const plain phase = primal(lane.phase);
        const paddle::ball_gap<plain> gap =
            paddle::gap_after(primal(lane.amplitude), phase, primal(lane.speed));
        const auto search = paddle::search_of(gap, phase, primal(lane.convex_from));
        mask_of<Real> found;
        const plain root = paddle::first_contact(search, lane.is_released > zero, active, found);

        const paddle::ball_gap<Real> flow =
            paddle::gap_after(lane.amplitude, lane.phase, lane.speed);
        Real duration(root);
        if constexpr (!without_derivatives<Real>) {
            duration = implicit_root(root, flow.at(duration).value, gap.at(root).rate);
        }
        const Real approach = smaller(flow.at(duration).rate, zero);
        const Real speed = -(lane.restitution * approach);
        const turned<Real> landing = within_turn(lane.phase + duration);

        const mask_of<Real> hits = active & found;
        const mask_of<Real> stays = hits & (((speed == zero) & !falls_away(lane, landing.phase)) |
                                            chatter_completes(lane, landing.phase, speed));
        const mask_of<Real> rests = stays & !(lane.amplitude > one);
        const mask_of<Real> goes_on = hits & !rests;
        if constexpr (Watch::is_active) {
            if (hits) {
                report_flight(lane, duration, watch);
                report_impact(lane, landing.phase, approach, speed, lane.time + duration, stays,
                              watch);
                if (stays) report_contact(lane, landing.phase, lane.time + duration, watch);
            }
        }
        lane.time = select(hits, lane.time + duration, lane.time);
        lane.events = select(hits, lane.events + one, lane.events);
        lane.sticks = select(stays, lane.sticks + one, lane.sticks);
        lane.turns = select(goes_on, lane.turns + landing.turns, lane.turns);
        lane.phase = select(goes_on, landing.phase, lane.phase);
        lane.speed = select(goes_on, speed, lane.speed);
        lane.is_released = select(goes_on, zero, lane.is_released);
        release(lane, landing.phase, stays & !rests);

        Real ended = select(rests, code_of<Real>(outcome::rest), zero);
        ended = select(active & !found, code_of<Real>(outcome::unresolved_event), ended);
        const mask_of<Real> lost = active & !(speed - speed == zero);
        ended = select(lost, code_of<Real>(outcome::not_finite), ended);
        const mask_of<Real> returned = goes_on & !lost;
        return {returned, ended};
    }

    template <class Real>
    HOPSCOTCH_DEVICE static void read_state(const lane<Real>& lane, int, Real* columns) {
        columns[0] = lane.phase;
        columns[1] = lane.speed;
    }
    template <class Real>
    HOPSCOTCH_DEVICE static void read_extras(const lane<Real>& lane, Real* extra) {
        extra[0] = lane.sticks;
    }

    /// Label 1: rest. Label 1 + q: caught and released every q forcing periods; every caught orbit
    /// goes on from the same state, so the second release proves the cycle. Bouncing attractors
    /// carry no label here.
    template <int Variant, class Real>
    HOPSCOTCH_DEVICE static Real certificate(const lane<Real>& lane) {
        const Real longest(static_cast<double>(longest_cycle));
        const mask_of<Real> proved = (lane.cycle > Real(0.0)) & (lane.cycle <= longest);
        return select(proved, lane.cycle + Real(1.0), Real(0.0));
    }
    static constexpr int longest_cycle = 32;
    static bool certificate_covers(const variant_query&) { return false; }
    static bool describe_label(int label, label_description& text) {
        if (label < 1 || label > longest_cycle + 1) return false;
        if (label == 1) {
            text = {.kind = "rest",
                    .trap = "caught where the paddle never falls faster than the ball"};
            return true;
        }
        text = {.kind = "stick",
                .index = label - 1,
                .period = label - 1,
                .trap = "released twice: every release starts from the same state"};
        return true;
    }

private:
    template <class Real>
    struct turned {
        Real phase;  // in [0, 2 pi)
        Real turns;  // full turns taken off
    };
    template <class Real>
    HOPSCOTCH_DEVICE static turned<Real> within_turn(const Real& angle) {
        const Real zero(0.0);
        const Real turn = two_pi<Real>();
        Real turns = floor(angle / turn);
        Real rest = fma(-turns, turn, angle);
        // 2 pi less its rounding to double
        if constexpr (binary64_lane<primal_of<Real>>)
            rest = fma(-turns, Real(0x1.1a62633145c07p-52), rest);
        const mask_of<Real> below = rest < zero;
        rest = select(below, rest + turn, rest);
        turns = select(below, turns - Real(1.0), turns);
        const mask_of<Real> above = rest >= turn;
        rest = select(above, rest - turn, rest);
        return {rest, select(above, turns + Real(1.0), turns)};
    }

    /// Where the paddle falls faster than the ball: D = Gamma sin(phase) >= 1 before, > 1 after the
    /// peak.
    template <class Real>
    HOPSCOTCH_DEVICE static mask_of<Real> falls_away(const lane<Real>& lane, const Real& phase) {
        return (lane.amplitude > Real(1.0)) & (phase >= lane.convex_from) &
               (phase < pi<Real>() - lane.convex_from);
    }

    /// All remaining impacts happen while the effective gravity keeps at least half of itself
    /// (page, 3).
    template <class Real>
    HOPSCOTCH_DEVICE static mask_of<Real> chatter_completes(const lane<Real>& lane,
                                                            const Real& phase, const Real& speed) {
        const Real one(1.0);
        const Real weight = fma(-lane.amplitude, sin(phase), one);
        const Real slack = (one - lane.restitution) * weight;
        return (lane.restitution > Real(0.0)) & (weight > Real(0.0)) & (speed >= Real(0.0)) &
               (Real(16.0) * lane.amplitude * speed <= slack * slack);
    }

    /// The ride from `phase` to the release at phi_1.
    template <class Real>
    HOPSCOTCH_DEVICE static void release(lane<Real>& lane, const Real& phase,
                                         mask_of<Real> wanted) {
        const Real zero(0.0);
        const Real one(1.0);
        const Real ahead = lane.convex_from - phase;
        const mask_of<Real> wraps = ahead < zero;
        const Real ride = select(wraps, ahead + two_pi<Real>(), ahead);
        const Real turns = select(wraps, lane.turns + one, lane.turns);
        const mask_of<Real> again = wanted & (lane.has_released > zero);
        lane.cycle = select(again, turns, lane.cycle);
        lane.has_released = select(wanted, one, lane.has_released);
        lane.turns = select(wanted, zero, lane.turns);
        lane.time = select(wanted, lane.time + ride, lane.time);
        lane.events = select(wanted, lane.events + one, lane.events);
        lane.phase = select(wanted, lane.convex_from, lane.phase);
        lane.speed = select(wanted, zero, lane.speed);
        lane.is_released = select(wanted, one, lane.is_released);
    }

    static void write_state(double amplitude, double phase, double gap, double rate,
                            double* columns) {
        const sine_cosine<double> turn = sin_cos(phase);
        columns[2] = amplitude * turn.sin;
        columns[3] = amplitude * turn.cos;
        columns[0] = columns[2] + gap;
        columns[1] = columns[3] + rate;
    }
    template <class Lane, class Watch>
    static void report_flight(const Lane& lane, double duration, Watch& watch) {
        const auto flow = paddle::gap_after(lane.amplitude, lane.phase, lane.speed);
        watch.phase("flight", lane.time, duration, [&](double t, double* columns) {
            const auto gap = flow.at(t);
            write_state(lane.amplitude, lane.phase + t, gap.value, gap.rate, columns);
        });
    }
    template <class Lane, class Watch>
    static void report_impact(const Lane& lane, double phase, double approach, double speed,
                              double time, bool stays, Watch& watch) {
        double before[4];
        double after[4];
        write_state(lane.amplitude, phase, 0.0, approach, before);
        write_state(lane.amplitude, phase, 0.0, speed, after);
        watch.event("impact", time, "flight", stays ? "contact" : "flight", before, after,
                    0.5 * (approach * approach - speed * speed));
    }
    /// Sustained contact from `phase`, the rest of its chatter left out, to the release or for one
    /// turn.
    template <class Lane, class Watch>
    static void report_contact(const Lane& lane, double phase, double time, Watch& watch) {
        const bool leaves = lane.amplitude > 1.0;
        const double ahead = lane.convex_from - phase;
        const double ride = !leaves || ahead < 0.0 ? ahead + two_pi<double>() : ahead;
        watch.phase("contact", time, leaves ? ride : two_pi<double>(),
                    [&](double t, double* columns) {
                        write_state(lane.amplitude, phase + t, 0.0, 0.0, columns);
                    });
        if (!leaves) return;
        double at[4];
        write_state(lane.amplitude, lane.convex_from, 0.0, 0.0, at);
        watch.event("release", time + ride, "contact", "flight", at, at, 0.0);
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
