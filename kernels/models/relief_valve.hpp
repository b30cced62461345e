// The impacting pressure relief valve: a disc on a spring that lifts off its seat under the
// pressure of a chamber filled at a constant rate, and bounces on the seat. The field's benchmark
// of impacting ensembles. Source: PEERS.md; Hegedus, Hos, Kulesza et al. (MPGOS); Hos, Champneys,
// SIAM J. Appl. Dyn. Syst. (2012).
//   x' = v,  v' = -damping v - (x + offset) + p,  p' = gain (flow_rate - x sqrt p);  x >= 0
#pragma once

#include "kernels/contract/model.hpp"
#include "kernels/integrators/first_zero.hpp"
#include "kernels/integrators/taylor.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

struct relief_valve {
    static constexpr parameter_info parameters[] = {
        {"damping", "kappa", "1", 1.25, non_negative, "damping of the disc"},
        {"offset", "delta", "1", 10.0, positive,
         "spring force on the closed disc: opening pressure"},
        {"gain", "beta", "1", 20.0, positive, "compressibility: pressure rate per flow"},
        {"restitution", "r", "1", 0.8, {0.0, 1.0}, "restitution of the seat"},
        {"flow_rate", "q", "1", 5.0, positive, "flow into the chamber"}};
    enum parameter_index { damping, offset, gain, restitution, flow_rate };

    static constexpr column_info maximum_columns[] = {
        {"x", "1", non_negative, "displacement of the disc"},
        {"p", "1", non_negative, "pressure in the chamber"}};
    static constexpr section_info sections[] = {
        {"maximum", maximum_columns, 0,
         "local maximum of x (v = 0); any start with v = 0 is legal"}};
    static constexpr extra_info extras[] = {
        {"impacts", "1", "impacts on the seat, summed over returns"}};
    static constexpr outcome outcomes[] = {outcome::ok, outcome::rest, outcome::unresolved_event};
    static constexpr column_info trace_columns[] = {{"x", "1", non_negative, "displacement"},
                                                    {"v", "1", any_finite, "velocity"},
                                                    {"p", "1", non_negative, "pressure"}};
    static constexpr model_info info{
        .name = "relief_valve",
        .title = "Impacting pressure relief valve",
        .reference = "Hos, Champneys, SIAM J. Appl. Dyn. Syst. 2012; Hegedus et al. 2020 (MPGOS)",
        .time_unit = "1",
        .parameters = parameters,
        .sections = sections,
        .options = {},
        .extras = extras,
        .outcomes = outcomes,
        .trace_columns = trace_columns};

    static constexpr contact_info contact{"open", "impact", "1", "1", "disc above its seat"};
    static contact_gap gap(const double* columns, const double*, const int*) {
        return {columns[0], columns[1]};
    }

    static constexpr int n_variants = 1;
    static int variant(const variant_query&) { return 0; }
    static constexpr std::string_view refusal(const double*, const int*) { return {}; }

    static constexpr int n_parameter_fields = 5;
    template <class Real>
    struct lane {
        Real damping, offset, gain, restitution, flow;
        Real x, v, root;    // root = sqrt p
        Real rising;        // 1: the next turn is a maximum, 0: a minimum
        Real seat_zeros;    // leading coefficients of x that vanish: 1 after an impact, 2 or 3 at
                            // rest on it
        Real turn_zeros;    // of v
        Real top_x, top_p;  // section state
        Real impacts;
        Real tolerance;  // of a step of the integrator
        Real time, events;
    };

    template <int Variant, class Real>
    HOPSCOTCH_DEVICE static void set_tolerance(lane<Real>& lane, double tolerance) {
        lane.tolerance = Real(taylor::tolerance_for<Real>(tolerance));
    }

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> begin(lane<Real>& lane, int, const Real* columns,
                                                 const Real* parameter, const int*, Watch&) {
        const Real zero(0.0);
        lane.damping = parameter[damping];
        lane.offset = parameter[offset];
        lane.gain = parameter[gain];
        lane.restitution = parameter[restitution];
        lane.flow = parameter[flow_rate];
        const mask_of<Real> valid = (columns[0] >= zero) & (columns[1] >= zero) &
                                    (columns[0] - columns[0] == zero) &
                                    (columns[1] - columns[1] == zero);
        lane.x = lane.top_x = select(valid, columns[0], zero);
        lane.top_p = select(valid, columns[1], zero);
        lane.root = sqrt(lane.top_p);
        lane.v = lane.impacts = lane.time = lane.events = zero;
        lane.rising = lane.seat_zeros = lane.turn_zeros = zero;
        const mask_of<Real> seated = valid & (lane.x == zero);
        const mask_of<Real> settled = turn(lane, valid & !seated);
        leave_seat(lane, seated);
        const mask_of<Real> none = valid & !valid;
        return {none, select(valid, select(settled, code_of<Real>(outcome::rest), zero),
                             code_of<Real>(outcome::invalid_start))};
    }

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> step(lane<Real>& lane, mask_of<Real> active,
                                                Watch& watch) {
        using plain = primal_of<Real>;
        const Real zero(0.0);
        const Real one(1.0);
        motion<Real> a;
        expand(a, lane);
        const plain horizon = a.size.length(primal(lane.tolerance), plain(4.0));

        taylor::series<Real> closing;
        closing = a.x;
        taylor::divide_out_zeros(closing, lane.seat_zeros);
        const auto seat = taylor::first_zero(closing, horizon, active);
        taylor::series<Real> turning;
        turning = a.v;
        taylor::divide_out_zeros(turning, lane.turn_zeros);
        const mask_of<Real> rises = lane.rising > zero;
        for (int n = 0; n <= taylor::order<Real>; ++n)
            turning.c[n] = negate_where(!rises, turning.c[n]);
        const auto flat = taylor::first_zero(turning, horizon, active);

        const mask_of<Real> hits = active & seat.found & !(flat.found & (flat.time < seat.time));
        const mask_of<Real> turns = active & flat.found & !hits;
        const Real s = select(hits, seat.time, select(turns, flat.time, Real(horizon)));
        const Real passed = taylor::evaluate(a.time, s);
        if constexpr (Watch::is_active) {
            watch.phase("open", lane.time, passed,
                        [&](Real t, Real* columns) { a.sample(t, s, columns); });
        }
        lane.time = select(active, lane.time + passed, lane.time);
        lane.root = select(active, taylor::evaluate(a.root, s), lane.root);
        lane.x = select(active, select(hits, zero, taylor::evaluate(a.x, s)), lane.x);
        lane.v = select(active, select(turns, zero, taylor::evaluate(a.v, s)), lane.v);
        lane.seat_zeros = select(active, zero, lane.seat_zeros);
        lane.turn_zeros = select(active, zero, lane.turn_zeros);

        const mask_of<Real> peaks = turns & rises;
        lane.top_x = select(peaks, lane.x, lane.top_x);
        lane.top_p = select(peaks, lane.root * lane.root, lane.top_p);
        const mask_of<Real> settled = turn(lane, turns);
        if (any(hits)) hit_seat(lane, hits, watch);

        const mask_of<Real> broken = active & !(horizon >= plain(0.0));
        const mask_of<Real> lost =
            active & ((seat.unresolved & !turns) | (flat.unresolved & !hits));
        Real ended = select(settled, code_of<Real>(outcome::rest), zero);
        ended = select(lost, code_of<Real>(outcome::unresolved_event), ended);
        ended = select(broken, code_of<Real>(outcome::not_finite), ended);
        const mask_of<Real> returned = peaks & !lost & !broken;
        lane.events = select(hits, lane.events + one, lane.events);
        return {returned, ended};
    }

    template <class Real>
    HOPSCOTCH_DEVICE static void read_state(const lane<Real>& lane, int, Real* columns) {
        columns[0] = lane.top_x;
        columns[1] = lane.top_p;
    }
    template <class Real>
    HOPSCOTCH_DEVICE static void read_extras(const lane<Real>& lane, Real* extra) {
        extra[0] = lane.impacts;
    }

private:
    /// One step's motion in the time s with dt = 2 sqrt(p) ds, in which the right-hand side is
    /// polynomial and an empty chamber (p = 0) is a regular point:
    ///   x' = 2 r v,  v' = 2 r (r^2 - x - offset - damping v),  r' = gain (flow_rate - x r),  t' =
    ///   2 r.
    template <class Real>
    struct motion {
        taylor::series<Real> x, v, root, time;
        taylor::step_length<Real> size;

        /// The state a time t after the step's beginning; `end` in s.
        void sample(const Real& t, const Real& end, Real* columns) const {
            const auto rising = [&](const Real& s) {
                auto at = taylor::value_slope(time, s);
                at.value = at.value - t;
                return at;
            };
            const Real s =
                bracketed_root<Real>(rising, {Real(0.0), end}, end * Real(0.5), end > Real(0.0));
            columns[0] = taylor::evaluate(x, s);
            columns[1] = taylor::evaluate(v, s);
            const Real r = taylor::evaluate(root, s);
            columns[2] = r * r;
        }
    };

    template <class Real>
    HOPSCOTCH_DEVICE static void expand(motion<Real>& a, const lane<Real>& lane) {
        using taylor::over;
        taylor::series<Real> force;
        a.x.c[0] = lane.x;
        a.v.c[0] = lane.v;
        a.root.c[0] = lane.root;
        a.time.c[0] = Real(0.0);
        const Real two(2.0);
        for (int n = 0; n < taylor::order<Real>; ++n) {
            const int m = n + 1;
            // products of pairs i, n - i: every coefficient is loaded once for three products
            Real pressure(0.0);  // half of the sum of unequal pairs
            Real outflow(0.0);
            Real drift(0.0);
            Real push(0.0);
            for (int i = 1, j = n - 1; i < j; ++i, --j) {
                pressure = fma(a.root.c[i], a.root.c[j], pressure);
                outflow = fma(a.x.c[j], a.root.c[i], fma(a.x.c[i], a.root.c[j], outflow));
                drift = fma(a.root.c[j], a.v.c[i], fma(a.root.c[i], a.v.c[j], drift));
                push = fma(a.root.c[j], force.c[i], fma(a.root.c[i], force.c[j], push));
            }
            if (n > 0) {
                pressure = fma(a.root.c[0], a.root.c[n], pressure);
                pressure = pressure + pressure;
                outflow = fma(a.x.c[n], a.root.c[0], fma(a.x.c[0], a.root.c[n], outflow));
                drift = fma(a.root.c[n], a.v.c[0], fma(a.root.c[0], a.v.c[n], drift));
                push = fma(a.root.c[n], force.c[0], push);
            }
            if (n % 2 == 0) {
                const int i = n / 2;
                pressure = fma(a.root.c[i], a.root.c[i], pressure);
                outflow = fma(a.x.c[i], a.root.c[i], outflow);
                drift = fma(a.root.c[i], a.v.c[i], drift);
                if (n > 0) push = fma(a.root.c[i], force.c[i], push);
            }
            Real net = pressure - a.x.c[n];
            if (n == 0) net = net - lane.offset;
            force.c[n] = fma(-lane.damping, a.v.c[n], net);
            push = fma(a.root.c[0], force.c[n], push);
            a.x.c[m] = over(two * drift, m);
            a.v.c[m] = over(two * push, m);
            a.root.c[m] = over(lane.gain * (n == 0 ? lane.flow - outflow : -outflow), m);
            a.time.c[m] = over(two * a.root.c[n], m);
        }
        a.size.watch(a.x);
        a.size.watch(a.v);
        a.size.watch(a.root);
    }

    /// Acceleration and pressure rate of the disc at v = 0, rounded as in `expand`, so that their
    /// signs are those of the series.
    template <class Real>
    HOPSCOTCH_DEVICE static Real acceleration(const lane<Real>& lane) {
        return (lane.root * lane.root - lane.x) - lane.offset;
    }
    template <class Real>
    HOPSCOTCH_DEVICE static Real filling(const lane<Real>& lane) {
        return lane.flow - lane.x * lane.root;
    }

    /// Prepares the motion that follows v = 0 above the seat; returns the lanes that are at the
    /// equilibrium to rounding, where the sign of the acceleration means nothing any more.
    template <class Real>
    HOPSCOTCH_DEVICE static mask_of<Real> turn(lane<Real>& lane, const mask_of<Real>& wanted) {
        using plain = primal_of<Real>;
        const Real zero(0.0);
        const Real one(1.0);
        const Real pull = acceleration(lane);
        const Real rate = filling(lane);
        const mask_of<Real> balanced = pull == zero;
        const mask_of<Real> up = (pull > zero) | (balanced & (rate > zero));
        lane.rising = select(wanted, select(up, one, zero), lane.rising);
        // v is of first order in the time, of second where the force vanishes, and one more in s at
        // p = 0
        const Real empty = select(lane.root == zero, one, zero);
        lane.turn_zeros = select(wanted, select(balanced, Real(2.0), one) + empty, lane.turn_zeros);
        const plain negligible(lane_traits<Real>::rounding * 64.0);
        const plain force = abs(primal(lane.x)) + primal(lane.offset);
        return wanted & (abs(primal(pull)) <= negligible * force) &
               (abs(primal(rate)) <= negligible * primal(lane.flow));
    }

    /// Sets off from rest on the seat, once the pressure has reached the spring's.
    template <class Real>
    HOPSCOTCH_DEVICE static void leave_seat(lane<Real>& lane, const mask_of<Real>& wanted) {
        const Real zero(0.0);
        const Real one(1.0);
        const Real two(2.0);
        const mask_of<Real> held = wanted & !(acceleration(lane) > zero);
        const Real wait = (lane.offset - lane.root * lane.root) / (lane.gain * lane.flow);
        lane.time = select(held, lane.time + larger(wait, zero), lane.time);
        lane.events = select(held, lane.events + one, lane.events);
        lane.root = select(held, sqrt(lane.offset), lane.root);
        lane.v = select(wanted, zero, lane.v);
        lane.rising = select(wanted, one, lane.rising);
        lane.seat_zeros = select(wanted, select(held, Real(3.0), two), lane.seat_zeros);
        lane.turn_zeros = select(wanted, select(held, two, one), lane.turn_zeros);
    }

    /// The impact law, and the end of chatter. Impacts below a speed at which the disc would rise
    /// less than rounding are summed up: the remaining ones take 2 v / ((1 - e) |a|), during which
    /// the pressure rises as on the seat; so the disc is put there at once, if the acceleration
    /// keeps its sign until then.
    template <class Real, class Watch>
    HOPSCOTCH_DEVICE static void hit_seat(lane<Real>& lane, const mask_of<Real>& hits,
                                          Watch& watch) {
        using plain = primal_of<Real>;
        const Real zero(0.0);
        const Real one(1.0);
        const Real rebound = -(lane.restitution * lane.v);
        if constexpr (Watch::is_active) {
            if (hits) {
                const Real p = lane.root * lane.root;
                const Real before[] = {zero, lane.v, p};
                const Real after[] = {zero, rebound, p};
                watch.event("impact", lane.time, "open", "open", before, after,
                            Real(0.5) * (lane.v * lane.v - rebound * rebound));
            }
        }
        lane.impacts = select(hits, lane.impacts + one, lane.impacts);
        const plain up = primal(rebound);
        const plain pull = primal(acceleration(lane));
        const plain pressing = -pull;
        const plain left = plain(2.0) * up * primal(lane.gain * lane.flow);
        const mask_of<Real> is_slow = up <= plain(lane_traits<Real>::root_rounding);
        const mask_of<Real> chatter_ends =
            is_slow & (pressing > plain(0.0)) &
            (plain(8.0) * left <= pressing * pressing * (plain(1.0) - primal(lane.restitution)));
        const mask_of<Real> stays = hits & (chatter_ends | (up == plain(0.0)));
        const mask_of<Real> bounces = hits & !stays;
        lane.v = select(bounces, rebound, lane.v);
        lane.rising = select(bounces, one, lane.rising);
        lane.seat_zeros = select(bounces, one, lane.seat_zeros);
        lane.turn_zeros = select(bounces, zero, lane.turn_zeros);
        lane.events = select(stays & !(acceleration(lane) > zero), lane.events + one, lane.events);
        leave_seat(lane, stays);
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
