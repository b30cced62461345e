// The line juggler under a mirror law: one ball, one vertical line, an explicit map of apex
// heights. Source: Rizzi and Koditschek 1994, Eqs (5)-(9), with the sign of
// models/mirror_juggler.md, section 0: r = -K b, K = kappa0 + kappa1 gravity (target - apex).
#pragma once

#include "kernels/contract/model.hpp"
#include "kernels/elementary/elementary.hpp"
#include "kernels/unimodal/doubling_cascade.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// b' = m^2 b with m = alpha + (1 + alpha) K. In y = (1 + alpha) kappa1 gravity b and
/// a = alpha + (1 + alpha) kappa0 + (1 + alpha) kappa1 gravity b* it reads y' = y (a - y)^2.
struct mirror_line {
    static constexpr parameter_info parameters[] = {
        {"restitution", "alpha", "1", 0.75, {0.0, 1.0, true, false}, "restitution of the impact"},
        {"gravity", "gamma", "m/s^2", 9.81, positive, "gravity"},
        {"gain_offset", "kappa0", "1", __builtin_nan(""), any_finite,
         "mirror gain at the target energy; where not given, the tuned (1 - alpha) / (1 + alpha)"},
        {"energy_gain", "kappa1", "s^2/m^2", 0.05, any_finite, "gain of the energy servo"},
        {"target_height", "b*", "m", 0.5, positive, "apex height asked for"},
    };
    enum parameter_index { restitution, gravity, gain_offset, energy_gain, target_height };
    static constexpr column_info apex_columns[] = {{"apex_height",
                                                    "m",
                                                    {0.0, unbounded, true, false},
                                                    "height of the apex above the impacts"}};
    static constexpr section_info sections[] = {{"apex", apex_columns, 0, "apex of the flight"}};
    static constexpr extra_info extras[] = {
        {"downward", "1", "flag: an impact left the ball moving downward (m < 0)"},
        {"invalid_gain", "1", "flag: a gain K <= -1 was used"}};
    static constexpr outcome outcomes[] = {outcome::ok, outcome::rest, outcome::escaped};
    static constexpr column_info state[] = {
        {"height", "m", any_finite, "height of the ball"},
        {"velocity", "m/s", any_finite, "velocity of the ball"}};
    static constexpr model_info info{
        .name = "mirror_line",
        .title = "Line juggler under a mirror law",
        .reference = "Rizzi, Koditschek, ICRA 1994, pp. 2935-2940, Eqs (5)-(9)",
        .time_unit = "s",
        .parameters = parameters,
        .sections = sections,
        .options = {},
        .extras = extras,
        .outcomes = outcomes,
        .trace_columns = state};

    static constexpr contact_info contact{"flight", "impact", "m", "m/s", "ball above the impacts"};
    static contact_gap gap(const double* columns, const double*, const int*) {
        return {columns[0], columns[1]};
    }

    /// Variant 0 leaves out the times.
    static constexpr int n_variants = 2;
    static constexpr int n_cheap_variants = n_variants;
    static int variant(const variant_query& scene) { return scene.wants_time ? 1 : 0; }
    static constexpr int full_variant(int) { return 1; }
    static constexpr std::string_view refusal(const double*, const int*) { return {}; }

    template <class Real>
    struct lane {
        Real offset;  // a
        Real slope;   // (1 + alpha) kappa1 gravity
        Real gravity;
        Real height;      // of the apex
        Real is_falling;  // 1: the last impact left the ball on its way down; the next one is
                          // immediate
        Real downward;
        Real invalid_gain;
        Real time;
        Real events;
    };

    /// Heights above this have left every bounded region: the next ones overflow.
    static constexpr double escape_height = 1e100;

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> begin(lane<Real>& lane, int, const Real* columns,
                                                 const Real* parameter, const int*, Watch&) {
        const Real zero(0.0);
        const Real one(1.0);
        const Real alpha = parameter[restitution];
        const Real given = parameter[gain_offset];
        const Real m_tuned = select(given == given, fma(one + alpha, given, alpha), one);
        lane.gravity = parameter[gravity];
        lane.slope = (one + alpha) * parameter[energy_gain] * lane.gravity;
        lane.offset = fma(lane.slope, parameter[target_height], m_tuned);
        lane.is_falling = lane.downward = lane.invalid_gain = lane.time = lane.events = zero;
        const mask_of<Real> valid = (columns[0] >= zero) & (columns[0] < infinity<Real>());
        lane.height = select(valid, columns[0], one);
        const mask_of<Real> none = valid & !valid;
        return {none, select(valid, zero, code_of<Real>(outcome::invalid_start))};
    }

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> step(lane<Real>& lane, mask_of<Real> active,
                                                Watch& watch) {
        const Real zero(0.0);
        const Real one(1.0);
        const Real m = fma(-lane.slope, lane.height, lane.offset);
        const Real next = m * m * lane.height;
        const mask_of<Real> leaves_down = m < zero;
        const mask_of<Real> rests = active & (lane.height == zero);
        const mask_of<Real> moves = active & !rests;
        const mask_of<Real> escapes = moves & !(next < Real(escape_height)) & (next == next);
        const mask_of<Real> lost = moves & !(next == next);
        const mask_of<Real> returned = moves & !escapes & !lost;
        if constexpr (Variant == 1) {
            // from the apex down, v = -sqrt(2 gravity b), and up again with m times that speed
            const Real fall = sqrt(Real(2.0) * lane.height / lane.gravity);
            if constexpr (Watch::is_active) {
                if (moves) report_cycle(lane, m, fall, watch);
            }
            const Real down = select(lane.is_falling > zero, zero, fall);
            const Real up = select(leaves_down, zero, m * fall);
            lane.time = select(moves, lane.time + (down + up), lane.time);
            lane.is_falling = select(moves, select(leaves_down, one, zero), lane.is_falling);
        }
        lane.downward = select(moves & leaves_down, one, lane.downward);
        lane.invalid_gain = select(moves & (m <= -one), one, lane.invalid_gain);
        lane.events = select(moves, lane.events + one, lane.events);
        lane.height = select(returned, next, lane.height);
        Real ended = select(rests, code_of<Real>(outcome::rest), zero);
        ended = select(escapes, code_of<Real>(outcome::escaped), ended);
        ended = select(lost, code_of<Real>(outcome::not_finite), ended);
        return {returned, ended};
    }

    template <class Real>
    HOPSCOTCH_DEVICE static void read_state(const lane<Real>& lane, int, Real* columns) {
        columns[0] = lane.height;
    }
    template <class Real>
    HOPSCOTCH_DEVICE static void read_extras(const lane<Real>& lane, Real* extra) {
        extra[0] = lane.downward;
        extra[1] = lane.invalid_gain;
    }

    /// Page, section 3. With kappa1 > 0 heights with m > -1 (y < a + 1) stay there for a <= 3; a
    /// alone names the attractor, by Singer's theorem. Without an energy servo, or with kappa1 < 0,
    /// |m| < 1 decides.
    template <int Variant, class Real>
    HOPSCOTCH_DEVICE static Real certificate(const lane<Real>& lane) {
        // multiplier -1 of the cycles of period 1, 2, 4 ... 128: a = 2, sqrt 5, ... (50-digit
        // Newton)
        constexpr doubling_cascade cascade{{2.0, 0x1.1e3779b97f4a8p+1, 0x1.24de397adb4dcp+1,
                                            0x1.264d19e36c6d6p+1, 0x1.269bc6b8a89bfp+1,
                                            0x1.26aca177130c3p+1, 0x1.26b03d9b1a5ebp+1,
                                            0x1.26b10387f18c7p+1}};
        const Real zero(0.0);
        const Real one(1.0);
        const Real m = fma(-lane.slope, lane.height, lane.offset);
        const mask_of<Real> has_servo = lane.slope > zero;
        const mask_of<Real> shrinks = (m < one) | (has_servo & (lane.height > zero));
        const mask_of<Real> dies =
            (m > -one) & shrinks & (lane.offset > -one) & (lane.offset <= one);
        const mask_of<Real> caught = has_servo & (m > -one) & (lane.offset > one) &
                                     (lane.offset <= Real(3.0)) & (lane.height > zero);
        const Real at_rest(static_cast<double>(resting_label));
        const Real label = select(caught, cascade_label(cascade, lane.offset), zero);
        return select(dies | (lane.height == zero), at_rest, label);
    }
    static bool certificate_covers(const variant_query&) { return true; }
    static bool describe_label(int label, label_description& text) {
        return describe_cascade_label(
            label, "rest", "heights with K > -1, but a set of measure zero (negative Schwarzian)",
            text);
    }

private:
    template <class Lane, class Watch>
    static void report_cycle(const Lane& lane, double m, double fall, Watch& watch) {
        const double gravity = lane.gravity;
        const double speed = gravity * fall;
        double now = lane.time;
        if (!(lane.is_falling > 0.0)) {
            watch.phase("flight", now, fall, [&](double t, double* columns) {
                columns[0] = lane.height - 0.5 * gravity * t * t;
                columns[1] = -gravity * t;
            });
            now += fall;
        }
        const double before[] = {0.0, -speed};
        const double after[] = {0.0, m * speed};
        watch.event("impact", now, "flight", "flight", before, after,
                    0.5 * speed * speed * (1.0 - m * m));
        if (m < 0.0) return;  // the next impact follows at once
        watch.phase("flight", now, m * fall, [&](double t, double* columns) {
            columns[0] = t * (m * speed - 0.5 * gravity * t);
            columns[1] = m * speed - gravity * t;
        });
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
