// Raibert's hopper on an air spring, stripped to its one-parameter map: no friction, no gravity in
// stance, an instantaneous thrust at the bottom. Source: Koditschek and Buehler 1991, Eqs (9),
// (15), (18), (19).
#pragma once

#include "kernels/contract/model.hpp"
#include "kernels/elementary/elementary.hpp"
#include "kernels/events/bracketed_root.hpp"
#include "kernels/raibert/dawson.hpp"
#include "kernels/raibert/parameters.hpp"
#include "kernels/unimodal/doubling_cascade.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// The Ricker map E' = alpha E exp(-E) of the energy E = ln(chi_l / chi_b) at the bottom.
///
/// | name | paper | | name | paper |
/// |---|---|---|---|---|
/// | liftoff_height | chi_l = chi_td | | leg_mass_ratio | mu', mu = (1 + mu')^-2 |
/// | stiffness | eta_1 | | gain | alpha = tau mu chi_l / eta_1 |
/// | thrust | tau | | energy | E |
struct raibert_pneumatic_simple {
    static constexpr parameter_info parameters[] = {
        {"liftoff_height", "chi_l", "m", 0.5, positive,
         "height of the body at touchdown and lift-off"},
        {"stiffness", "eta_1", "m^2/s^2", 5.81, positive,
         "air spring in compression, force eta_1 / chi"},
        raibert::row::thrust,
        {"flight_gravity", "g", "m/s^2", 10.0, positive, "gravity in flight"},
        raibert::row::leg_mass_ratio,
        {"gain", "alpha", "1", __builtin_nan(""), positive,
         "thrust liftoff_height / (stiffness (1 + mu')^2); replaces thrust and leg mass where "
         "given"},
    };
    enum parameter_index {
        liftoff_height,
        stiffness,
        thrust,
        flight_gravity,
        leg_mass_ratio,
        gain
    };

    static constexpr column_info bottom_columns[] = {
        {"bottom_height",
         "m",
         {0.0, unbounded, false, false},
         "chi_b, height of the body at the bottom, at most liftoff_height"}};
    static constexpr column_info energy_columns[] = {
        {"energy", "1", {0.0, unbounded, true, false}, "E = ln(liftoff_height / bottom_height)"}};
    static constexpr column_info touchdown_columns[] = {{"touchdown_speed",
                                                         "m/s",
                                                         {0.0, unbounded, true, false},
                                                         "speed of the body at touchdown"}};
    static constexpr section_info sections[] = {
        {"bottom", bottom_columns, 0, "lowest point of the stance"},
        {"energy", energy_columns, 1, "lowest point of the stance, in energy coordinates (18)"},
        {"touchdown", touchdown_columns, 2, "the foot touches the ground"}};
    enum section_index { at_bottom, at_bottom_energy, at_touchdown };

    static constexpr outcome outcomes[] = {outcome::ok};
    static constexpr column_info state[] = {
        {"height", "m", any_finite, "height of the body"},
        {"velocity", "m/s", any_finite, "velocity of the body"}};
    static constexpr model_info info{
        .name = "raibert_pneumatic_simple",
        .title = "Vertical hopper on an air spring, simplified: the map alpha E exp(-E)",
        .reference = "Koditschek, Buehler, Int. J. Robotics Research 10(6), 1991, Eqs (15), (19)",
        .time_unit = "s",
        .parameters = parameters,
        .sections = sections,
        .options = {},
        .extras = {},
        .outcomes = outcomes,
        .trace_columns = state};

    static constexpr contact_info contact{"flight", "touchdown", "m", "m/s",
                                          "foot above the ground"};
    static contact_gap gap(const double* columns, const double* parameters, const int*) {
        return {columns[0] - parameters[liftoff_height], columns[1]};
    }

    /// Variant 0 leaves out the times.
    static constexpr int n_variants = 2;
    static constexpr int n_cheap_variants = n_variants;
    static int variant(const variant_query& scene) { return scene.wants_time ? 1 : 0; }
    static constexpr int full_variant(int) { return 1; }
    static constexpr std::string_view refusal(const double*, const int*) { return {}; }

    template <class Real>
    struct lane {
        Real gain;    // alpha
        Real height;  // chi_l
        Real stiffness;
        Real thrust;
        Real gravity;
        Real energy;      // E at the bottom that the next return starts from, or passes first
        Real log_energy;  // ln E, kept only where E itself underflows
        Real from_touchdown;
        Real time;
        Real events;
    };

    /// Below this energy its logarithm is iterated instead; above `deep_fall` the next one lies
    /// there.
    static constexpr double deep_energy = 1e-290;
    static constexpr double deep_fall = 600.0;

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> begin(lane<Real>& lane, int section, const Real* columns,
                                                 const Real* parameter, const int*, Watch&) {
        const Real zero(0.0);
        const Real one(1.0);
        const Real mass = one + parameter[leg_mass_ratio];
        const Real height = parameter[liftoff_height];
        const Real inertia = height / (parameter[stiffness] * mass * mass);  // alpha over tau
        const Real given = parameter[gain];
        const mask_of<Real> has_gain = given == given;
        lane.gain = select(has_gain, given, parameter[thrust] * inertia);
        lane.thrust = select(has_gain, given / inertia, parameter[thrust]);
        lane.height = height;
        lane.stiffness = parameter[stiffness];
        lane.gravity = parameter[flight_gravity];
        lane.log_energy = lane.time = lane.events = zero;
        lane.from_touchdown = section == at_touchdown ? one : zero;

        const Real x = columns[0];
        mask_of<Real> valid = (x >= zero) & (x < infinity<Real>());
        if (section == at_bottom) {
            valid = (x > zero) & (x <= height);
            const mask_of<Real> is_tiny = x < Real(1e-290) * height;
            const Real safe = select(is_tiny, height, x);
            lane.energy =
                log1p((height - safe) / safe);  // exact difference next to lift-off height
            if (any(is_tiny)) lane.energy = select(is_tiny, log(height) - log(x), lane.energy);
        } else if (section == at_bottom_energy) {
            lane.energy = x;
        } else {
            lane.energy = x / parameter[stiffness] * x * Real(0.5);
            const mask_of<Real> deep = valid & (lane.energy < Real(deep_energy));
            if (any(deep)) {
                const Real level = Real(2.0) * log(x) - log(parameter[stiffness] * Real(2.0));
                lane.log_energy = select(deep, level, zero);
            }
        }
        if (section != at_touchdown) {
            const mask_of<Real> deep = valid & (lane.energy < Real(deep_energy));
            if (any(deep)) lane.log_energy = select(deep, log(lane.energy), zero);
        }
        valid = valid & (lane.energy < infinity<Real>());
        lane.energy = select(valid, lane.energy, one);
        const mask_of<Real> none = valid & !valid;
        return {none, select(valid, zero, code_of<Real>(outcome::invalid_start))};
    }

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> step(lane<Real>& lane, mask_of<Real> active,
                                                Watch& watch) {
        const Real zero(0.0);
        const Real now = lane.energy;
        const mask_of<Real> deep = now < Real(deep_energy);
        Real next = lane.gain * now * exp(-now);
        // from, to or through energies that only their logarithm holds
        const mask_of<Real> leaves_range =
            deep | (now > Real(deep_fall)) | (next < Real(deep_energy));
        if (any(leaves_range)) {
            const Real level = select(deep, lane.log_energy, log(now)) + (log(lane.gain) - now);
            next = select(leaves_range, exp(level), next);
            lane.log_energy = select(active & leaves_range, level, lane.log_energy);
        }
        if constexpr (Variant == 1) {
            if constexpr (Watch::is_active) {
                if (active) report_hop(lane, next, watch);
            }
            const Real touchdown = speed_of(lane.stiffness, next, lane.log_energy);
            const Real flight = Real(2.0) * touchdown / lane.gravity;
            const Real compression =
                compression_time(lane, select(lane.from_touchdown > zero, now, next));
            const Real hop = compression + decompression_time(lane, now) + flight;
            lane.time = select(active, lane.time + hop, lane.time);
        }
        lane.events =
            select(active, lane.events + Real(3.0), lane.events);  // bottom, lift-off, touchdown
        lane.energy = select(active, next, lane.energy);
        // where the thrust behind a gain overflows there are no times, nor a speed where its square
        // does
        const Real square = Real(2.0) * lane.stiffness * next;
        const mask_of<Real> lost =
            active & !((square < infinity<Real>()) & (lane.thrust < infinity<Real>()));
        const mask_of<Real> returned = active & !lost;
        return {returned, select(lost, code_of<Real>(outcome::not_finite), zero)};
    }

    template <class Real>
    HOPSCOTCH_DEVICE static void read_state(const lane<Real>& lane, int section, Real* columns) {
        if (section == at_bottom)
            columns[0] = lane.height * exp(-lane.energy);
        else if (section == at_bottom_energy)
            columns[0] = lane.energy;
        else
            columns[0] = speed_of(lane.stiffness, lane.energy, lane.log_energy);
    }
    template <class Real>
    HOPSCOTCH_DEVICE static void read_extras(const lane<Real>&, Real*) {}

    /// Theorem 1 and the cascade of section 6 of the page: the gain alone tells where an orbit with
    /// E > 0 ends, up to starts of measure zero on unstable cycles.
    template <int Variant, class Real>
    HOPSCOTCH_DEVICE static Real certificate(const lane<Real>& lane) {
        // e^2, then where the cycles of period 2, 4 ... 128 have multiplier -1 (50-digit Newton)
        constexpr doubling_cascade cascade{{0x1.d8e64b8d4ddaep+2, 0x1.904bb5bda06e1p+3,
                                            0x1.c7d0e3d78916ap+3, 0x1.d4e2c4602e61dp+3,
                                            0x1.d7bf75878f56dp+3, 0x1.d85d190e75be0p+3,
                                            0x1.d87ee4ab10ab8p+3, 0x1.d88621f8bb3c6p+3}};
        const mask_of<Real> is_deep = lane.energy < Real(deep_energy);
        const mask_of<Real> at_rest = is_deep & !(lane.log_energy > -infinity<Real>());
        const mask_of<Real> dies = (lane.gain <= Real(1.0)) | at_rest;
        return select(dies, Real(static_cast<double>(resting_label)),
                      cascade_label(cascade, lane.gain));
    }
    static bool certificate_covers(const variant_query&) { return true; }
    static bool describe_label(int label, label_description& text) {
        return describe_cascade_label(label, "hopping dies",
                                      "every start but a set of measure zero (negative Schwarzian)",
                                      text);
    }

private:
    template <class Real>
    HOPSCOTCH_DEVICE static Real speed_of(const Real& stiffness, const Real& energy,
                                          const Real& log_energy) {
        const mask_of<Real> deep = energy < Real(deep_energy);
        const Real usual = sqrt(Real(2.0) * stiffness * select(deep, Real(1.0), energy));
        if (!any(deep)) return usual;
        const Real tiny = sqrt(Real(2.0) * stiffness) * exp(Real(0.5) * log_energy);
        return select(deep, tiny, usual);
    }
    /// chi_l sqrt(2 / eta) D(sqrt E): from touchdown to the bottom of energy E.
    template <class Real>
    HOPSCOTCH_DEVICE static Real compression_time(const lane<Real>& lane, const Real& energy) {
        return lane.height * sqrt(Real(2.0) * energy / lane.stiffness) *
               raibert::dawson_over_root(energy);
    }
    /// The same on the spring eta_2 = tau chi_b that the thrust leaves behind.
    template <class Real>
    HOPSCOTCH_DEVICE static Real decompression_time(const lane<Real>& lane, const Real& energy) {
        return sqrt(Real(2.0) * energy * lane.height / lane.thrust) * exp(Real(0.5) * energy) *
               raibert::dawson_over_root(energy);
    }

    /// Height and velocity `t` after (or before) the bottom of energy E on the spring eta:
    /// t = chi_b sqrt(2 / eta) exp(w^2) D(w), w^2 = ln(chi / chi_b).
    static void stance_state(double bottom, double eta, double energy, double t, double* columns) {
        const auto late = [&](double w) {
            const double growth = exp(w * w);
            const double scale = bottom * sqrt(2.0 / eta);
            return value_and_slope<double>{
                scale * growth * w * raibert::dawson_over_root(w * w) - t, scale * growth};
        };
        const double highest = sqrt(energy);
        const double w = bracketed_root<double>(late, {0.0, highest}, 0.5 * highest, true);
        columns[0] = bottom * exp(w * w);
        columns[1] = sqrt(2.0 * eta) * w;
    }
    template <class Lane, class Watch>
    static void report_compression(const Lane& lane, double energy, double start, Watch& watch) {
        const double duration = compression_time(lane, energy);
        const double bottom = lane.height * exp(-energy);
        const double before[] = {lane.height, -speed_of(lane.stiffness, energy, lane.log_energy)};
        watch.event("touchdown", start, "flight", "compression", before, before, 0.0);
        watch.phase("compression", start, duration, [&](double t, double* columns) {
            stance_state(bottom, lane.stiffness, energy, duration - t, columns);
            columns[1] = -columns[1];
        });
    }
    /// One hop in the order of the section it starts from.
    template <class Lane, class Watch>
    static void report_hop(const Lane& lane, double next, Watch& watch) {
        double now = lane.time;
        const double energy = lane.energy;
        if (lane.from_touchdown > 0.0) {
            report_compression(lane, energy, now, watch);
            now += compression_time(lane, energy);
        }
        const double bottom = lane.height * exp(-energy);
        const double spring = lane.thrust * bottom;
        const double rise = decompression_time(lane, energy);
        const double at_bottom_state[] = {bottom, 0.0};
        watch.event("bottom", now, "compression", "decompression", at_bottom_state, at_bottom_state,
                    (lane.stiffness - spring) * energy);
        watch.phase("decompression", now, rise, [&](double t, double* columns) {
            stance_state(bottom, spring, energy, t, columns);
        });
        now += rise;
        const double touchdown = speed_of(lane.stiffness, next, lane.log_energy);
        const double before[] = {lane.height, sqrt(2.0 * spring * energy)};
        const double after[] = {lane.height, touchdown};
        watch.event("lift-off", now, "decompression", "flight", before, after,
                    spring * energy - lane.stiffness * next);
        const double flight = 2.0 * touchdown / lane.gravity;
        watch.phase("flight", now, flight, [&](double t, double* columns) {
            columns[0] = lane.height + t * (touchdown - 0.5 * lane.gravity * t);
            columns[1] = touchdown - lane.gravity * t;
        });
        now += flight;
        if (!(lane.from_touchdown > 0.0)) report_compression(lane, next, now, watch);
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
