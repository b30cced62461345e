// The spring-mass runner (SLIP) whose leg is reset to a fixed angle in flight: linear or air
// spring, gravity acting or neglected in stance. Speed at touchdown is conserved, so that a stride
// maps one angle. Source: models/slip.md; Ghigliazza, Altendorfer, Holmes, Koditschek, SIAM Review
// 47 (2005) 519-549.
#pragma once

#include "kernels/spring_leg/gravity_free_stance.hpp"
#include "kernels/spring_leg/stance_under_gravity.hpp"
#include "kernels/spring_leg/stride.hpp"
#include "kernels/spring_leg/trace.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

struct slip {
    static constexpr parameter_info parameters[] = {
        {"mass", "m", "kg", 1.0, positive, "mass of the body"},
        {"leg_length", "eta0", "m", 1.5, positive, "rest length of the leg"},
        {"stiffness", "k, c", "N/m or N m^3", 100.0, positive,
         "linear: k, force k (eta0 - eta); air: c, force c / eta^3"},
        {"gravity", "g", "m/s^2", 9.81, positive, "gravitational acceleration"},
        {"touchdown_angle",
         "beta",
         "rad",
         1.25,
         {0.0, 0x1.921fb54442d18p+0, false, false},
         "leg above the horizontal at touchdown, in (0, pi/2)"}};
    enum parameter_index { mass, leg_length, stiffness, gravity, touchdown_angle };

    static constexpr column_info touchdown_columns[] = {
        {"speed", "m/s", positive, "v, touchdown speed"},
        {"angle",
         "rad",
         {-0x1.921fb54442d18p+1, 0x1.921fb54442d18p+1},
         "delta, velocity below the horizontal; failing values (delta <= beta - pi/2) are legal"}};
    static constexpr column_info apex_columns[] = {
        {"apex_height", "m", any_finite, "height of the body at the apex"},
        {"forward_speed", "m/s", any_finite, "horizontal velocity at the apex"}};
    static constexpr section_info sections[] = {
        {"touchdown", touchdown_columns, 0, "the foot touches the ground"},
        {"apex", apex_columns, 1, "top of the flight (behind lift-off where that already falls)"}};
    static constexpr std::string_view springs[] = {"linear", "air"};
    static constexpr std::string_view gravities[] = {"on", "off"};
    static constexpr option_info options[] = {
        {"spring", springs, "force law of the leg"},
        {"stance_gravity", gravities, "whether gravity acts while the foot is on the ground"}};
    static constexpr extra_info extras[] = {
        {"sweep_angle", "rad", "angle that the leg turned in the last stance"}};
    static constexpr outcome outcomes[] = {
        outcome::ok,         outcome::no_contact, outcome::ground,  outcome::energy_deficit,
        outcome::no_liftoff, outcome::stumble,    outcome::reverse, outcome::unresolved_event};
    static constexpr column_info trace_columns[] = {
        {"x", "m", any_finite, "forward of the foothold of the phase"},
        {"y", "m", any_finite, "height"},
        {"x_rate", "m/s", any_finite, "forward velocity"},
        {"y_rate", "m/s", any_finite, "upward velocity"}};
    static constexpr model_info info{
        .name = "slip",
        .title = "Spring-loaded inverted pendulum with fixed leg reset",
        .reference = "Ghigliazza, Altendorfer, Holmes, Koditschek, SIAM Review 47(3), 2005",
        .time_unit = "s",
        .parameters = parameters,
        .sections = sections,
        .options = options,
        .extras = extras,
        .outcomes = outcomes,
        .trace_columns = trace_columns};

    static constexpr contact_info contact{"flight", "touchdown", "m", "m/s",
                                          "foot of the leg as it will land, above the ground"};
    static contact_gap gap(const double* columns, const double* parameters, const int*) {
        const double landing = parameters[leg_length] * sin(parameters[touchdown_angle]);
        return {columns[1] - landing, columns[3]};
    }

    static constexpr int n_variants = 4;
    static int variant(const variant_query& scene) {
        return scene.options[0] + 2 * scene.options[1];
    }
    static constexpr std::string_view refusal(const double*, const int*) { return {}; }
    template <int Variant>
    static constexpr bool has_air_spring = Variant % 2 == 1;
    template <int Variant>
    static constexpr bool has_stance_gravity = Variant < 2;

    template <class Real>
    using lane = spring_leg::runner<Real>;

    template <int Variant, class Real>
    requires(has_stance_gravity<Variant>) HOPSCOTCH_DEVICE
        static void set_tolerance(lane<Real>& lane, double tolerance) {
        lane.tolerance = Real(taylor::tolerance_for<Real>(tolerance));
    }

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> begin(lane<Real>& lane, int section, const Real* columns,
                                                 const Real* parameter, const int*, Watch&) {
        const Real zero(0.0);
        const Real one(1.0);
        const auto leg = sin_cos(parameter[touchdown_angle]);
        lane.leg = parameter[leg_length];
        lane.beta = parameter[touchdown_angle];
        lane.beta_sin = leg.sin;
        lane.beta_cos = leg.cos;
        lane.at_apex = section == 1 ? one : zero;
        lane.sweep = lane.time = lane.events = zero;
        lane.x = lane.y = lane.x_rate = lane.y_rate = lane.in_stance = lane.elapsed = zero;
        lane.untouched = lane.length = one;

        Real fall(0.0);  // v^2 sin^2 delta
        if (section == 1) {
            fall = Real(2.0) * parameter[gravity] * (columns[0] - lane.leg * lane.beta_sin);
            lane.speed = sqrt(larger(fma(columns[1], columns[1], fall), zero));
            lane.angle = atan2(sqrt(larger(fall, zero)), columns[1]);
        } else {
            lane.speed = columns[0];
            lane.angle = columns[1];
        }
        const Real square = lane.speed * lane.speed;
        lane.time_unit = lane.leg / lane.speed;
        lane.height_unit = square / parameter[gravity];
        lane.gravity = lane.leg / lane.height_unit;
        const Real per_mass = parameter[stiffness] / (parameter[mass] * square);
        if constexpr (has_air_spring<Variant>) {
            lane.stiffness = per_mass / (lane.leg * lane.leg);
        } else {
            lane.stiffness = per_mass * (lane.leg * lane.leg);
        }
        const mask_of<Real> finite = (lane.speed - lane.speed == zero) &
                                     (lane.angle - lane.angle == zero) & (fall - fall == zero);
        const mask_of<Real> valid = finite & (lane.speed > zero);
        const mask_of<Real> low = valid & (fall < zero);
        const mask_of<Real> none = valid & !valid;
        Real ended = select(valid, select(low, code_of<Real>(outcome::stumble), zero),
                            code_of<Real>(outcome::invalid_start));
        if (section == 1) {  // under so little gravity the next apex is beyond all numbers
            const mask_of<Real> unbounded_apex = !(lane.height_unit < infinity<Real>());
            ended =
                select((ended == zero) & unbounded_apex, code_of<Real>(outcome::not_finite), ended);
        }
        return {none, ended};
    }

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> step(lane<Real>& lane, mask_of<Real> active,
                                                Watch& watch) {
        const Real zero(0.0);
        const mask_of<Real> starts = active & (lane.in_stance == zero);
        lane.time = select(starts, lane.time + spring_leg::descent(lane), lane.time);
        progress<Real> done;
        if constexpr (has_stance_gravity<Variant>) {
            done = step_of_stance<has_air_spring<Variant>>(lane, active, starts, watch);
        } else {
            if constexpr (Watch::is_active) {
                spring_leg::reporter<has_air_spring<Variant>, Watch>{watch}.gravity_free_stride(
                    lane);
            }
            const Real ended = stride_without_gravity<has_air_spring<Variant>>(lane, active);
            const mask_of<Real> completed = active & (ended == zero);
            done = {completed, ended};
        }
        const mask_of<Real> arrived =
            done.returned | (active & (done.ended == code_of<Real>(outcome::reverse)));
        lane.time = select(arrived, lane.time - spring_leg::descent(lane), lane.time);
        return done;
    }

    template <class Real>
    HOPSCOTCH_DEVICE static void read_state(const lane<Real>& lane, int section, Real* columns) {
        if (section == 0) {
            columns[0] = lane.speed;
            columns[1] = lane.angle;
            return;
        }
        const auto velocity = sin_cos(lane.angle);
        columns[0] = fma(Real(0.5) * lane.height_unit, velocity.sin * velocity.sin,
                         lane.leg * lane.beta_sin);
        columns[1] = lane.speed * velocity.cos;
    }

    template <class Real>
    HOPSCOTCH_DEVICE static void read_extras(const lane<Real>& lane, Real* extra) {
        extra[0] = lane.sweep;
    }

private:
    /// One stride with gravity neglected in stance; returns the outcome's code, 0 while all is
    /// well.
    template <bool IsAir, class Real>
    HOPSCOTCH_DEVICE static Real stride_without_gravity(lane<Real>& lane, mask_of<Real> active) {
        using namespace spring_leg;
        const Real zero(0.0);
        const Real one(1.0);
        const Real two(2.0);
        const auto turn = sin_cos(lane.beta - lane.angle);
        const impact_angle<Real> alpha{turn.sin, turn.cos};
        const mask_of<Real> contact = active & (alpha.cos > zero);
        mask_of<Real> collapses = contact & !contact;
        sweep<Real> stance;
        if constexpr (IsAir) {
            stance = air_sweep(alpha, lane.stiffness);
        } else {
            collapses = contact & (alpha.sin == zero) & (lane.stiffness <= one);
            stance = linear_sweep(alpha, lane.stiffness, contact & !collapses);
        }
        const auto lifted = sin_cos(lane.beta + stance.angle);
        const mask_of<Real> grounds = collapses | (contact & (lifted.sin <= zero));
        const auto half = sin_cos(Real(0.5) * stance.angle);
        const auto middle = sin_cos(fma(Real(0.5), stance.angle, lane.beta));
        const Real rise = two * middle.cos * half.sin;
        const Real energy = fma(-two * lane.gravity, rise, one);
        const mask_of<Real> lifts = contact & !grounds;
        const mask_of<Real> short_of_energy = lifts & (energy <= zero);
        const mask_of<Real> leaves = lifts & (energy > zero);
        // pi - (2 beta + sweep - angle) is the direction of take-off
        const auto direction = sin_cos(fma(two, lane.beta, stance.angle) - lane.angle);
        const Real speed = sqrt(select(leaves, energy, one));
        const lift_off<Real> from{-(speed * direction.cos), speed * direction.sin, rise};

        const mask_of<Real> swept = contact & !collapses;
        lane.sweep = select(swept, stance.angle, lane.sweep);
        lane.time = select(leaves, fma(stance.duration, lane.time_unit, lane.time), lane.time);
        lane.events = select(grounds, lane.events + one, lane.events);
        Real ended = select(active & !contact, code_of<Real>(outcome::no_contact), zero);
        ended = select(grounds, code_of<Real>(outcome::ground), ended);
        ended = select(short_of_energy, code_of<Real>(outcome::energy_deficit), ended);
        ended =
            select(lifts & !(leaves | short_of_energy), code_of<Real>(outcome::not_finite), ended);
        return ended + book_flight(lane, from, leaves);
    }

    /// Longest stance, in leg lengths over touchdown speed; beyond it there is `no_liftoff`.
    static constexpr double longest_stance = 1e4;

    /// One integrator step of a stance under gravity, with the flight that follows its lift-off.
    template <bool IsAir, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> step_of_stance(lane<Real>& lane,
                                                          const mask_of<Real>& active,
                                                          const mask_of<Real>& starts,
                                                          Watch& watch) {
        using namespace spring_leg;
        const Real zero(0.0);
        const Real one(1.0);
        const auto velocity = sin_cos(lane.angle);
        const Real closing = cos(lane.beta - lane.angle);
        const mask_of<Real> misses = starts & !(closing > zero);
        lane.x = select(starts, -lane.beta_cos, lane.x);
        lane.y = select(starts, lane.beta_sin, lane.y);
        lane.x_rate = select(starts, velocity.cos, lane.x_rate);
        lane.y_rate = select(starts, -velocity.sin, lane.y_rate);
        lane.length = select(starts, one, lane.length);
        lane.elapsed = select(starts, zero, lane.elapsed);
        lane.untouched = select(active, select(starts, one, zero), lane.untouched);
        const mask_of<Real> moves = active & !misses;

        stance_series<Real> a;
        a.x.c[0] = lane.x;
        a.y.c[0] = lane.y;
        a.x_rate.c[0] = lane.x_rate;
        a.y_rate.c[0] = lane.y_rate;
        a.length.c[0] = lane.length;
        if constexpr (IsAir) {
            expand_air(a, lane.stiffness, lane.gravity);
        } else {
            expand_linear(a, lane.stiffness, lane.gravity);
        }
        const stance_step<Real> step = advance(
            a, lane.untouched, IsAir ? Real(2.0) * closing : closing, lane.tolerance, moves);
        const Real s = step.length_of_step;
        const Real passed = IsAir ? s : taylor::evaluate(a.time, s);
        if constexpr (Watch::is_active) {
            reporter<IsAir, Watch> report{watch};
            if (starts) report.event("touchdown", lane, lane.time, "flight", "stance");
            const Real began = fma(lane.elapsed, lane.time_unit, lane.time);
            if (moves) report.stance(lane, a, s, began, passed);
        }
        lane.x = select(moves, taylor::evaluate(a.x, s), lane.x);
        lane.y = select(moves, taylor::evaluate(a.y, s), lane.y);
        lane.x_rate = select(moves, taylor::evaluate(a.x_rate, s), lane.x_rate);
        lane.y_rate = select(moves, taylor::evaluate(a.y_rate, s), lane.y_rate);
        lane.length = select(moves, taylor::evaluate(a.length, s), lane.length);
        lane.elapsed = select(moves, lane.elapsed + passed, lane.elapsed);

        const mask_of<Real> lifts = moves & step.lifts;
        const mask_of<Real> grounds = moves & step.grounds;
        const mask_of<Real> stays = moves & !lifts & !grounds;
        const mask_of<Real> hangs = stays & (lane.elapsed > Real(longest_stance));
        const mask_of<Real> leaves_stance = lifts | grounds | hangs;
        lane.in_stance = select(leaves_stance | misses, zero, select(moves, one, lane.in_stance));
        lane.time = select(leaves_stance, fma(lane.elapsed, lane.time_unit, lane.time), lane.time);
        lane.sweep = select(leaves_stance, swept_angle(lane), lane.sweep);
        lane.events = select(grounds, lane.events + one, lane.events);

        if constexpr (Watch::is_active) {
            reporter<IsAir, Watch> report{watch};
            if (grounds) report.event("ground", lane, lane.time, "stance", "ground");
            if (lifts) report.flight(lane, lane.time);
        }

        const lift_off<Real> from{lane.x_rate, lane.y_rate, lane.y - lane.beta_sin};
        Real ended = select(misses, code_of<Real>(outcome::no_contact), zero);
        ended = select(grounds, code_of<Real>(outcome::ground), ended);
        ended = select(hangs, code_of<Real>(outcome::no_liftoff), ended);
        ended = select(moves & step.unresolved, code_of<Real>(outcome::unresolved_event), ended);
        ended = select(moves & step.broken, code_of<Real>(outcome::not_finite), ended);
        ended = ended + book_flight(lane, from, lifts & (ended == zero));
        const mask_of<Real> completed = lifts & (ended == zero);
        return {completed, ended};
    }

    /// Angle from the leg at touchdown to the leg now, clockwise.
    template <class Real>
    HOPSCOTCH_DEVICE static Real swept_angle(const lane<Real>& lane) {
        return atan2(fma(lane.x, lane.beta_sin, lane.y * lane.beta_cos),
                     fma(-lane.x, lane.beta_cos, lane.y * lane.beta_sin));
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
