// The passive hopper and the passive juggler as models of the engine. One set of equations serves
// both (CPRR Eq (6)); they differ in the coordinates that users type and read.
#pragma once

#include "kernels/passive/nonlinear_map.hpp"
#include "kernels/passive/nonlinear_trace.hpp"
#include "kernels/passive/return_map.hpp"
#include "kernels/passive/symmetric_hop.hpp"
#include "kernels/passive/trace.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::passive {

inline constexpr parameter_info parameters[] = {
    {"mass_ratio",
     "M",
     "1",
     1.0,
     {0.0, unbounded, false, true},
     "m2 / m1: foot over body, hand over ball"},
    {"restitution", "e", "1", 0.0, {0.0, 1.0}, "restitution of the impact; 0 is plastic"},
    {"damping_ratio",
     "zeta",
     "1",
     0.0,
     {0.0, 1.0, true, false},
     "spring damping; force s + 2 zeta s'"},
    {"speed_increment",
     "epsilon",
     "1",
     0.0,
     {-unbounded, unbounded, false, false},
     "added to the launch velocity at every hop (Fig. 8)"},
    {"quadratic_stiffness", "", "1", 0.0, any_finite, "q of the spring force s + q s^2 + c s^3"},
    {"cubic_stiffness", "", "1", 0.0, any_finite, "c of the spring force s + q s^2 + c s^3"},
    {"gravity_gradient",
     "gamma",
     "1",
     0.0,
     {-1.0, unbounded, false, false},
     "gravity 1 + gamma y at height y; hopper only"},
};
enum parameter_index {
    mass_ratio,
    restitution,
    damping_ratio,
    speed_increment,
    quadratic_stiffness,
    cubic_stiffness,
    gravity_gradient
};

inline constexpr column_info lift_off_columns[] = {
    {"liftoff_speed",
     "1",
     {0.0, unbounded, true, false},
     "alpha, velocity of the body at lift-off from sustained contact"}};

inline constexpr extra_info extras[] = {
    {"bounces", "1", "impacts without sustained contact, summed over returns"},
    {"loss", "1", "alpha^2 - f^2 taken by impacts, summed over returns"}};

inline constexpr outcome outcomes[] = {outcome::ok, outcome::stuck, outcome::rest, outcome::escaped,
                                       outcome::unresolved_event};

inline bool is_nonlinear(const double* parameter) {
    return parameter[quadratic_stiffness] != 0.0 || parameter[cubic_stiffness] != 0.0 ||
           parameter[gravity_gradient] != 0.0;
}

/// The compiled variant with nonlinear spring and gravity; it has every other term too.
inline constexpr int nonlinear_variant = 4;

/// Which of the compiled variants serves a scene.
inline int variant_for(const variant_query& scene) {
    if (is_nonlinear(scene.lowest) || is_nonlinear(scene.highest)) return nonlinear_variant;
    if (scene.highest[damping_ratio] > 0.0) return 3;
    if (scene.highest[restitution] > 0.0) return 2;
    return scene.wants_time ? 1 : 0;
}

template <int Variant>
struct variant_type;
template <>
struct variant_type<0> {
    using type = plastic_untimed;
};
template <>
struct variant_type<1> {
    using type = plastic;
};
template <>
struct variant_type<2> {
    using type = elastic;
};
template <>
struct variant_type<3> {
    using type = damped;
};

/// Sets a lane's parameters and everything else to its neutral value.
template <class Real>
HOPSCOTCH_DEVICE inline void clear_lane(hopper_lane<Real>& lane, const Real* parameter) {
    const Real mass = parameter[mass_ratio];
    const Real zero(0.0);
    const Real one(1.0);
    lane.inverse_mass = one / mass;
    lane.mu = one / (one + lane.inverse_mass);  // M = infinity: 1
    lane.inverse_total = one / (one + mass);
    lane.kappa = lane.mu * lane.inverse_total;
    lane.restitution = parameter[restitution];
    lane.damping = parameter[damping_ratio];
    lane.increment = parameter[speed_increment];
    lane.cell = lane.centre = lane.centre_low = lane.beta = zero;
    lane.centre_cosine = one;
    lane.is_bounce = lane.eta = lane.velocity = lane.rebound = zero;
    lane.energy = lane.loss = lane.from_flight = lane.trapped = zero;
    lane.time = lane.events = lane.bounces = lane.total_loss = zero;
}

/// The same for the variant with nonlinear terms; its tolerance is set already.
template <class Real>
HOPSCOTCH_DEVICE inline void take_parameters(nonlinear_lane<Real>& lane, const Real* parameter) {
    hopper_lane<Real> linear;
    clear_lane(linear, parameter);
    const Real zero(0.0);
    lane.mu = linear.mu;
    lane.kappa = linear.kappa;
    lane.inverse_total = linear.inverse_total;
    lane.restitution = linear.restitution;
    lane.damping = linear.damping;
    lane.increment = linear.increment;
    lane.spring = {parameter[quadratic_stiffness], parameter[cubic_stiffness]};
    lane.gradient = parameter[gravity_gradient];
    lane.lift_extension = extension_at(lane.spring, Real(1.0));
    lane.alpha = lane.s = lane.rate = lane.gap = lane.gap_rate = lane.pull = zero;
    lane.in_contact = lane.gap_zeros = lane.fresh = lane.contact_time = lane.settling = zero;
    lane.energy = lane.loss = lane.from_flight = zero;
    lane.time = lane.events = lane.bounces = lane.total_loss = zero;
}

/// Starts at lift-off from sustained contact.
template <class Real>
HOPSCOTCH_DEVICE inline progress<Real> begin_at_lift_off(hopper_lane<Real>& lane, Real alpha) {
    const Real zero(0.0);
    const mask_of<Real> valid = is_finite(alpha) & (alpha >= zero);
    const mask_of<Real> every = valid | !valid;
    const mask_of<Real> none = valid & !valid;
    set_lift_off_speed(lane, select(valid, alpha, zero), every);
    launch_from_section(lane, every);
    return {none, select(valid, zero, code_of<Real>(outcome::invalid_start))};
}

/// Starts from any state with the foot on or above the ground; the table of degenerate states of
/// section 2. Flies to the first impact, so that afterwards every flight starts from the ground.
template <class Variant, class Real, class Watch>
HOPSCOTCH_DEVICE inline progress<Real> begin_anywhere(hopper_lane<Real>& lane,
                                                      const engine_state<Real>& start,
                                                      Watch& watch) {
    const Real zero(0.0);
    const Real one(1.0);
    const Real two(2.0);
    constexpr bool is_damped = Variant::is_damped;
    const mask_of<Real> valid = is_finite(start.spring) & is_finite(start.spring_rate) &
                                is_finite(start.gap) & is_finite(start.gap_rate) &
                                (start.gap >= zero);
    const mask_of<Real> grounded = valid & (start.gap == zero);
    const mask_of<Real> flies = valid & ((start.gap > zero) | (start.gap_rate > zero));
    const mask_of<Real> impacts = grounded & (start.gap_rate < zero);
    const mask_of<Real> stands = grounded & (start.gap_rate == zero);

    const Real pull = is_damped ? fma(two * lane.damping, start.spring_rate, start.spring - one)
                                : start.spring - one;  // F - 1
    const Real pull_rate =
        is_damped ? start.spring_rate - two * lane.damping * (pull + one) : start.spring_rate;
    const mask_of<Real> lifts = stands & (pull == zero) & (pull_rate > zero);
    const mask_of<Real> departs = stands & ((pull > zero) | lifts);
    const mask_of<Real> stays = stands & !departs;

    const Real frequency = is_damped ? sqrt(fma(-lane.damping, lane.damping, one)) : one;
    const free_flight<is_damped, Real> flow{
        {start.spring, start.spring_rate, lane.damping, frequency}, start.gap, start.gap_rate};
    const mask_of<Real> airborne = flies | departs;
    landing<Real> end{zero, start.spring - one,
                      fma(start.gap_rate, lane.inverse_total, start.spring_rate), start.gap_rate};
    mask_of<Real> found = impacts | stays;
    if (any(airborne)) {
        const auto flight = land_from(flow, lane.inverse_total, lifts, airborne);
        end = select_landing(airborne, flight.end, end);
        found = found | (airborne & flight.found);
        if constexpr (Watch::is_active) watch.flight(lane, flow, end.duration);
    }
    lane.from_flight = one;
    lane.energy =
        energy_on_ground(contact_start<Real>{end.eta, end.velocity}, lane.mu, lane.inverse_total);
    // y1 and v1 are unchanged by the impact, so this is the energy after it, its rebound left out
    const mask_of<Real> none = valid & !valid;
    progress<Real> result = land<Variant>(lane, end, stays, stays, none, valid & found, watch);
    if constexpr (Variant::has_rebound) {
        lane.energy = lane.energy + lane.kappa * lane.rebound * lane.rebound;
    }
    result.ended = select(valid & !found, code_of<Real>(outcome::unresolved_event), result.ended);
    result.ended = select(valid, result.ended, code_of<Real>(outcome::invalid_start));
    return result;
}

/// The model, in the coordinates of one of the two machines.
template <class Coordinates>
struct model {
    static constexpr int n_variants = 5;
    static constexpr int n_cheap_variants = 3;  // without damping
    static constexpr int n_parameter_fields = passive::n_parameter_fields;
    static int variant(const variant_query& scene) { return variant_for(scene); }
    static std::string_view refusal(const double* parameter, const int*) {
        if (!Coordinates::has_gravity_gradient && parameter[gravity_gradient] != 0.0) {
            return "height-dependent gravity breaks the equivalence that defines the juggler by "
                   "the hopper's equations";
        }
        return refusal_of_spring(parameter[quadratic_stiffness], parameter[cubic_stiffness],
                                 parameter[gravity_gradient]);
    }

    template <class Real>
    using lane = hopper_lane<Real>;
    template <int Variant, class Real>
    using variant_lane =
        std::conditional_t<Variant == nonlinear_variant, nonlinear_lane<Real>, hopper_lane<Real>>;

    template <int Variant, class Real>
    requires(Variant == nonlinear_variant) HOPSCOTCH_DEVICE
        static void set_tolerance(nonlinear_lane<Real>& lane, double tolerance) {
        lane.tolerance = Real(taylor::tolerance_for<Real>(tolerance));
    }

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> begin(lane<Real>& lane, int section, const Real* columns,
                                                 const Real* parameter, const int*, Watch& watch) {
        clear_lane(lane, parameter);
        reporter<Coordinates, Watch> report{watch};
        progress<Real> done =
            section == 0
                ? begin_at_lift_off(lane, columns[0])
                : begin_anywhere<typename variant_type<Variant>::type>(
                      lane, Coordinates::template read<Real>(columns, parameter[mass_ratio]),
                      report);
        const mask_of<Real> has_numbers = is_finite(lane.inverse_mass) &
                                          is_finite(lane.restitution) & is_finite(lane.damping) &
                                          is_finite(lane.increment);
        done.returned = done.returned & has_numbers;
        done.ended = select(has_numbers, done.ended, code_of<Real>(outcome::not_finite));
        return done;
    }

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> begin(nonlinear_lane<Real>& lane, int section,
                                                 const Real* columns, const Real* parameter,
                                                 const int*, Watch& watch) {
        take_parameters(lane, parameter);
        nonlinear_reporter<Coordinates, Watch> report{watch};
        const Real code =
            section == 0
                ? begin_at_lift_off(lane, columns[0])
                : begin_anywhere(lane,
                                 Coordinates::template read<Real>(columns, parameter[mass_ratio]),
                                 report);
        const mask_of<Real> has_numbers = is_finite(lane.mu) & is_finite(lane.restitution) &
                                          is_finite(lane.damping) & is_finite(lane.increment) &
                                          is_finite(lane.gradient) & is_finite(lane.lift_extension);
        const mask_of<Real> none = has_numbers & !has_numbers;
        return {none, select(has_numbers, code, code_of<Real>(outcome::not_finite))};
    }

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> step(lane<Real>& lane, mask_of<Real> active,
                                                Watch& watch) {
        reporter<Coordinates, Watch> report{watch};
        return fly_and_land<typename variant_type<Variant>::type>(lane, active, report);
    }
    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> step(nonlinear_lane<Real>& lane, mask_of<Real> active,
                                                Watch& watch) {
        nonlinear_reporter<Coordinates, Watch> report{watch};
        return step_nonlinear(lane, active, report);
    }

    template <class Real>
    HOPSCOTCH_DEVICE static void read_state(const lane<Real>& lane, int, Real* columns) {
        columns[0] = lift_off_speed(lane);
    }
    template <class Real>
    HOPSCOTCH_DEVICE static void read_state(const nonlinear_lane<Real>& lane, int, Real* columns) {
        columns[0] = lane.alpha;
    }

    template <template <class> class Lane, class Real>
    HOPSCOTCH_DEVICE static void read_extras(const Lane<Real>& lane, Real* extra) {
        extra[0] = lane.bounces;
        extra[1] = lane.total_loss;
    }

    /// Label k + 1 of the lossless motion alpha*_k whose trapping set T_k holds the orbit; label 1
    /// is "hopping dies", proved below alpha*_1 when nothing adds energy (page, section 4).
    template <int Variant, class Real>
    HOPSCOTCH_DEVICE static Real certificate(const lane<Real>& lane) {
        const Real one(1.0);
        const Real zero(0.0);
        const mask_of<Real> settled = !(lane.from_flight > zero);
        const mask_of<Real> below_first =
            settled & (lane.increment <= zero) &
            ((lane.cell == zero) | ((lane.cell == one) & (lane.beta < zero)));
        return select(below_first, one, lane.trapped);
    }

    /// With nonlinear terms the lossless points move, and T_k is not known; but a damper takes
    /// energy from every flight, and without lossless flights every orbit dies.
    template <int Variant, class Real>
    HOPSCOTCH_DEVICE static Real certificate(const nonlinear_lane<Real>& lane) {
        const Real zero(0.0);
        const mask_of<Real> dies =
            (lane.damping > zero) & (lane.increment <= zero) & !(lane.from_flight > zero);
        return select(dies, Real(1.0), zero);
    }

    /// With plastic impacts and no damping T_k decides; with damping every orbit dies; elastic
    /// impacts and added energy need traps that are found numerically (analysis/labels).
    static bool certificate_covers(const variant_query& scene) {
        const bool adds_energy = scene.highest[speed_increment] > 0.0;
        const bool all_damped = scene.lowest[damping_ratio] > 0.0;
        const bool plain = scene.highest[restitution] == 0.0 &&
                           scene.highest[damping_ratio] == 0.0 &&
                           variant_for(scene) != nonlinear_variant;
        return !adds_energy && (all_damped || plain);
    }

    static bool describe_label(int label, label_description& text) {
        if (label == 1) {
            text = {.kind = "hopping dies", .trap = "liftoff_speed < alpha*_1, or stuck"};
            return true;
        }
        map_branch branch{};
        if (!linear_branch(label - 1, branch)) return false;
        text = {.kind = "fixed point",
                .index = label - 1,
                .has_point = true,
                .point = branch.base,
                .multiplier = 1.0,
                .trap = "T_k = [alpha*_k, alpha*_k + r_k(M)]: mapped into itself, f <= identity"};
        return true;
    }

    /// Branch k of the return map at a parameter point: from the lossless speed alpha_k to the
    /// first bounce; [alpha*_k, (k + 1) pi] where spring and gravity are linear.
    static bool branch(int index, const double* parameter, map_branch& result) {
        if (!is_nonlinear(parameter)) return linear_branch(index, result);
        nonlinear_lane<double> lane;
        take_parameters(lane, parameter);
        return nonlinear_branch(lane, index, result);
    }
    static bool linear_branch(int index, map_branch& result) {
        if (index < 0 || index > 100000) return false;
        const lossless<double> point = lossless_point(static_cast<double>(index));
        result = {point.high, (index + 1) * pi<double>()};
        return true;
    }

    /// Variant 0 computes the same as 1 without times.
    static constexpr int full_variant(int variant) { return variant == 0 ? 1 : variant; }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::passive
