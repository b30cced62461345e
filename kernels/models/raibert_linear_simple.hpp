// Raibert's hopper on a linear spring, simplified so that touchdown and lift-off are the spring's
// rest position and gravity in stance is absorbed. Source: Koditschek and Buehler 1991, Eqs (16),
// (17), (24), with the corrections of models/raibert_hopper.md, sections 5 and 10.
#pragma once

#include "kernels/contract/model.hpp"
#include "kernels/raibert/thrust.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// Stance oscillates with angular frequency omega and decay omega beta. E is the squared amplitude
/// at the bottom, q = sqrt(1 + beta^2), psi and psi' the thrust's displacement and velocity in the
/// same scale.
struct raibert_linear_simple {
    static constexpr parameter_info parameters[] = {
        {"frequency", "omega", "1/s", 20.0, positive,
         "damped angular frequency of the stance spring"},
        {"damping", "beta", "1", 0.2, positive,
         "friction 2 omega beta, stiffness omega^2 (1 + beta^2)"},
        {"thrust", "tau", "m/s^2", 1.0, positive, "net force of the thrust, gravity taken off"},
        {"thrust_time", "delta", "s", 0.01, non_negative, "duration of the thrust"},
        {"flight_gravity", "g", "m/s^2", 10.0, positive, "gravity in flight"},
    };
    enum parameter_index { frequency, damping, thrust, thrust_time, flight_gravity };

    static constexpr column_info bottom_columns[] = {
        {"energy",
         "m^2/s^2",
         {0.0, unbounded, true, false},
         "E = omega^2 (1 + beta^2) chi_b^2 at the bottom"}};
    static constexpr column_info phase_columns[] = {
        {"phase",
         "rad",
         {0.0, unbounded, false, false},
         "x = pi - theta at the end of the thrust (section 4.2)"}};
    static constexpr column_info touchdown_columns[] = {{"touchdown_speed",
                                                         "m/s",
                                                         {0.0, unbounded, true, false},
                                                         "speed of the body at touchdown"}};
    static constexpr section_info sections[] = {
        {"bottom", bottom_columns, 0, "lowest point of the stance"},
        {"phase", phase_columns, 1,
         "lowest point of the stance, by the phase its thrust will end at"},
        {"touchdown", touchdown_columns, 2, "the foot touches the ground"}};
    enum section_index { at_bottom, at_bottom_phase, at_touchdown };
    static constexpr extra_info extras[] = {
        {"thrust_cut", "1", "flag: a lift-off came before the end of the thrust"}};
    static constexpr outcome outcomes[] = {outcome::ok};
    static constexpr column_info state[] = {
        {"height", "m", any_finite, "height of the body above touchdown"},
        {"velocity", "m/s", any_finite, "velocity of the body"}};
    static constexpr model_info info{
        .name = "raibert_linear_simple",
        .title = "Vertical hopper on a linear spring, simplified",
        .reference = "Koditschek, Buehler, Int. J. Robotics Research 10(6), 1991, Eqs (16), (17)",
        .time_unit = "s",
        .parameters = parameters,
        .sections = sections,
        .options = {},
        .extras = extras,
        .outcomes = outcomes,
        .trace_columns = state};

    static constexpr contact_info contact{"flight", "touchdown", "m", "m/s",
                                          "foot above the ground"};
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
        Real frequency;
        Real beta;
        Real scale;  // omega q: amplitude over displacement
        Real thrust;
        Real thrust_time;
        Real gravity;
        Real psi;  // of the complete thrust
        Real psi_rate;
        Real stance_phase;     // arctan(1 / beta), phase between rest position and bottom
        Real touchdown_ratio;  // exp(-beta arctan(1 / beta)): amplitude at the bottom over
                               // touchdown speed
        Real amplitude;        // sqrt(E) at the bottom
        Real from_touchdown;
        Real thrust_cut;
        Real time;
        Real events;
    };

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> begin(lane<Real>& lane, int section, const Real* columns,
                                                 const Real* parameter, const int*, Watch&) {
        const Real zero(0.0);
        const Real one(1.0);
        const Real beta = parameter[damping];
        const Real q = sqrt(fma(beta, beta, one));
        lane.frequency = parameter[frequency];
        lane.beta = beta;
        lane.scale = lane.frequency * q;
        lane.thrust = parameter[thrust];
        lane.thrust_time = parameter[thrust_time];
        lane.gravity = parameter[flight_gravity];
        // corrected (24): displacement and velocity after the whole thrust
        const auto at =
            raibert::friction_factors_at(Real(2.0) * lane.frequency * beta * lane.thrust_time);
        const Real velocity = lane.thrust * lane.thrust_time * at.first;
        const Real moved = lane.thrust * lane.thrust_time * lane.thrust_time * at.second;
        lane.psi = fma(lane.scale, moved, beta * velocity / q);
        lane.psi_rate = velocity / q;
        lane.stance_phase = atan2(one, beta);
        lane.touchdown_ratio = exp(-(beta * lane.stance_phase));
        lane.from_touchdown = section == at_touchdown ? one : zero;
        lane.thrust_cut = lane.time = lane.events = zero;

        const Real x = columns[0];
        mask_of<Real> valid = (x >= zero) & (x < infinity<Real>());
        if (section == at_bottom) {
            lane.amplitude = sqrt(select(valid, x, one));
        } else if (section == at_bottom_phase) {
            const auto turn = sin_cos(x);
            lane.amplitude = fma(lane.psi_rate, turn.cos / turn.sin, lane.psi);
            valid = valid & (x > zero) & (x < pi<Real>()) & (lane.amplitude >= zero) &
                    (lane.psi_rate > zero) & (lane.amplitude < infinity<Real>());
        } else {
            lane.amplitude = x * lane.touchdown_ratio;
        }
        lane.amplitude = select(valid, lane.amplitude, one);
        const mask_of<Real> none = valid & !valid;
        return {none, select(valid, zero, code_of<Real>(outcome::invalid_start))};
    }

    /// One hop: (17) while the thrust ends before lift-off, else lift-off out of the thrust.
    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> step(lane<Real>& lane, mask_of<Real> active,
                                                Watch& watch) {
        const Real zero(0.0);
        const Real r = lane.amplitude;
        const Real left = lane.psi - r;
        // equality: the thrust ends first (page, 4.3)
        const mask_of<Real> cuts = active & (r < fma(-lane.beta, lane.psi_rate, lane.psi));
        const Real theta = atan2(lane.psi_rate, left);
        Real next =
            sqrt(fma(left, left, lane.psi_rate * lane.psi_rate)) * exp(-(lane.beta * theta));
        Real thrust_phase = lane.thrust_time;
        Real rise = (theta - lane.stance_phase) / lane.frequency;
        if (any(cuts)) {
            const Real friction = Real(2.0) * lane.frequency * lane.beta;
            const Real depth = r / lane.scale;
            const Real t =
                raibert::thrust_duration(friction, lane.thrust, depth, cuts & (r > zero));
            const Real speed = lane.thrust * t * raibert::friction_factors_at(friction * t).first;
            next = select(cuts, select(r > zero, speed * lane.touchdown_ratio, r), next);
            thrust_phase = select(cuts, select(r > zero, t, zero), thrust_phase);
            rise = select(cuts, zero, rise);
            lane.thrust_cut = select(cuts, Real(1.0), lane.thrust_cut);
        }
        // without thrust a bottom of no depth stays where it is
        next = select((r == zero) & (lane.psi_rate == zero), zero, next);
        if constexpr (Variant == 1) {
            const Real touchdown = next / lane.touchdown_ratio;
            const Real flight = Real(2.0) * touchdown / lane.gravity;
            const Real compression = lane.stance_phase / lane.frequency;
            if constexpr (Watch::is_active) {
                if (active) report_hop(lane, thrust_phase, rise, touchdown, cuts, watch);
            }
            lane.time =
                select(active, lane.time + (compression + thrust_phase + rise + flight), lane.time);
        }
        // bottom, end of the thrust, lift-off, touchdown
        const mask_of<Real> has_end = !cuts & (lane.thrust_time > zero);
        const Real happened = select(has_end, Real(4.0), Real(3.0));
        lane.events = select(active, lane.events + happened, lane.events);
        lane.amplitude = select(active, next, lane.amplitude);
        const Real energy = next * next;  // what the bottom section shows: it overflows first
        const mask_of<Real> lost = active & !(energy - energy == zero);
        const mask_of<Real> returned = active & !lost;
        return {returned, select(lost, code_of<Real>(outcome::not_finite), zero)};
    }

    template <class Real>
    HOPSCOTCH_DEVICE static void read_state(const lane<Real>& lane, int section, Real* columns) {
        if (section == at_bottom)
            columns[0] = lane.amplitude * lane.amplitude;
        else if (section == at_bottom_phase)
            columns[0] = atan2(lane.psi_rate, lane.amplitude - lane.psi);
        else
            columns[0] = lane.amplitude / lane.touchdown_ratio;
    }
    template <class Real>
    HOPSCOTCH_DEVICE static void read_extras(const lane<Real>& lane, Real* extra) {
        extra[0] = lane.thrust_cut;
    }

    /// Theorem 2: where rho = psi / psi' is below the bound of corollary 8 (exact form), phases up
    /// to pi/2, that is amplitudes from psi on, stay there and all tend to the fixed point.
    template <int Variant, class Real>
    HOPSCOTCH_DEVICE static Real certificate(const lane<Real>& lane) {
        const Real zero(0.0);
        const Real one(1.0);
        const Real bound = sqrt(fma(lane.beta, lane.beta, one)) *
                           exp(-(lane.beta * (half_pi<Real>() + atan2(lane.beta, one))));
        const mask_of<Real> is_valid = (lane.psi_rate > zero) & (lane.psi <= bound * lane.psi_rate);
        const mask_of<Real> settles = is_valid & (lane.amplitude >= lane.psi);
        const mask_of<Real> dies = (lane.amplitude == zero) | (lane.psi_rate == zero);
        return select(dies, one, select(settles, Real(2.0), zero));
    }
    /// rho grows with all its parameters, the bound falls with damping: the upper corner decides.
    static bool certificate_covers(const variant_query& scene) {
        const double beta = scene.highest[damping];
        const double q = sqrt(1.0 + beta * beta);
        const auto at = raibert::friction_factors_at(2.0 * scene.highest[frequency] * beta *
                                                     scene.highest[thrust_time]);
        const double rho =
            q * q * scene.highest[frequency] * scene.highest[thrust_time] * at.second / at.first +
            beta;
        return rho <= q * exp(-(beta * (0.5 * pi<double>() + atan2(beta, 1.0))));
    }
    static bool describe_label(int label, label_description& text) {
        if (label == 1) text = {.kind = "hopping dies", .trap = "no thrust, or no motion"};
        if (label == 2)
            text = {.kind = "fixed point", .trap = "phases up to pi/2 stay there (Theorem 2)"};
        return label == 1 || label == 2;
    }
    /// Beyond Theorem 2: the energies 0 ... 10^4 m^2/s^2, on which the return map is continuous.
    static bool branch(int index, const double*, map_branch& result) {
        result = {0.0, 1e4};
        return index == 0;
    }

private:
    /// Stance `t` after height z and velocity v.
    template <class Lane>
    static void spring_state(const Lane& lane, double z, double v, double t, double* columns) {
        const double decay = lane.frequency * lane.beta;
        const auto turn = sin_cos(lane.frequency * t);
        const double sine = turn.sin / lane.frequency;
        const double shrink = exp(-decay * t);
        columns[0] = shrink * (z * turn.cos + (v + decay * z) * sine);
        columns[1] = shrink * (v * turn.cos - (decay * v + lane.scale * lane.scale * z) * sine);
    }
    template <class Lane, class Watch>
    static void report_compression(const Lane& lane, double speed, double start, Watch& watch) {
        const double at[] = {0.0, -speed};
        watch.event("touchdown", start, "flight", "compression", at, at, 0.0);
        watch.phase(
            "compression", start, lane.stance_phase / lane.frequency,
            [&](double t, double* columns) { spring_state(lane, 0.0, -speed, t, columns); });
    }
    template <class Lane, class Watch>
    static void report_hop(const Lane& lane, double thrust_phase, double rise, double touchdown,
                           bool cuts, Watch& watch) {
        double now = lane.time;
        const double bottom = -(lane.amplitude / lane.scale);
        if (lane.from_touchdown > 0.0) {
            report_compression(lane, lane.amplitude / lane.touchdown_ratio, now, watch);
            now += lane.stance_phase / lane.frequency;
        }
        const bool has_thrust = thrust_phase > 0.0;
        const auto thrust_state = [&](double t, double* columns) {
            const auto at = raibert::friction_factors_at(2.0 * lane.frequency * lane.beta * t);
            columns[0] = bottom + lane.thrust * t * t * at.second;
            columns[1] = lane.thrust * t * at.first;
        };
        const double low[] = {bottom, 0.0};
        watch.event("bottom", now, "compression", has_thrust ? "thrust" : "decompression", low, low,
                    0.0);
        double end[2] = {bottom, 0.0};
        if (has_thrust) {
            watch.phase("thrust", now, thrust_phase, thrust_state);
            now += thrust_phase;
            thrust_state(thrust_phase, end);
        }
        if (!cuts) {
            if (has_thrust)
                watch.event("thrust end", now, "thrust", "decompression", end, end, 0.0);
            watch.phase("decompression", now, rise, [&](double t, double* columns) {
                spring_state(lane, end[0], end[1], t, columns);
            });
            now += rise;
        }
        const double at[] = {0.0, touchdown};
        watch.event("lift-off", now, cuts ? "thrust" : "decompression", "flight", at, at, 0.0);
        const double flight = 2.0 * touchdown / lane.gravity;
        watch.phase("flight", now, flight, [&](double t, double* columns) {
            columns[0] = t * (touchdown - 0.5 * lane.gravity * t);
            columns[1] = touchdown - lane.gravity * t;
        });
        if (!(lane.from_touchdown > 0.0)) report_compression(lane, touchdown, now + flight, watch);
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
