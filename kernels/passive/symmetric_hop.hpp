// Persistent hops of a hopper with a nonlinear spring or height-dependent gravity: every lossless
// motion is symmetric in time about mid-flight (CPRR section 5), so it is found by shooting from
// there to a landing with y2 = y2' = y2'' = 0. Source: models/passive_hopper.md section 6. Called
// by the host, to name the branches of the return map.
#pragma once

#include "kernels/passive/lossless_point.hpp"
#include "kernels/passive/nonlinear_map.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::passive {

/// A lossless hop. At mid-flight all velocities vanish.
template <class Real>
struct symmetric_hop {
    Real height;       // h: centre of mass y1 - 1 + M y2 at mid-flight
    Real compression;  // a = -s there
    Real half_time;    // T
    Real alpha;        // lift-off speed
    bool found = false;
};

/// The state a time T after mid-flight, and whether the foot was in the air until just before.
template <class Real>
struct shot {
    nonlinear_lane<Real> end;
    bool is_free = true;
};
template <class Real>
inline shot<Real> shoot(nonlinear_lane<Real> lane, const Real& height, const Real& compression,
                        const Real& half_time) {
    using plain = primal_of<Real>;
    const Real zero(0.0);
    lane.s = -compression;
    lane.gap = height + Real(1.0) + compression;
    lane.rate = lane.gap_rate = lane.in_contact = lane.gap_zeros = lane.fresh = zero;
    lane.tolerance = Real(taylor::default_tolerance<Real>);
    shot<Real> result;
    Real left = half_time;
    for (int i = 0; i < 10000; ++i) {
        lane.pull = pull_of(lane);
        nonlinear_motion<Real> a;
        expand(a, lane);
        taylor::step_length<Real> size;
        size.watch(a.s);
        size.watch(a.rate);
        size.watch(a.gap);
        const plain horizon = size.length(primal(lane.tolerance), plain(1e6));
        const bool is_last = !(horizon < primal(left));
        const Real t = is_last ? left : Real(horizon);
        // the landing itself is a triple zero: looked for up to a thousandth before
        const plain searched = is_last ? primal(left) - primal(half_time) * plain(1e-3) : horizon;
        if (searched > plain(0.0) && taylor::first_zero(a.gap, searched, true).found)
            result.is_free = false;
        const Real gap_rate = a.gap_rate(t);
        lane.s = taylor::evaluate(a.s, t);
        lane.rate = taylor::evaluate(a.rate, t);
        lane.gap = taylor::evaluate(a.gap, t);
        lane.gap_rate = gap_rate;
        if (is_last) break;
        left = left - t;
    }
    lane.pull = pull_of(lane);
    result.end = lane;
    return result;
}

/// Newton's method on y2 = y2' = y2'' = 0. `hop` holds the start, and the solution where found.
///
/// \param close  relative change at which it may stop; 0: full precision
template <class Real>
inline void solve_symmetric_hop(const nonlinear_lane<Real>& parameters, double close,
                                symmetric_hop<Real>& hop) {
    using number = dual<Real, 3>;
    nonlinear_lane<number> lane;
    lane.mu = number(parameters.mu);
    lane.inverse_total = number(parameters.inverse_total);
    lane.kappa = lane.restitution = lane.damping = lane.increment = number(0.0);
    lane.spring = {number(parameters.spring.quadratic), number(parameters.spring.cubic)};
    lane.gradient = number(parameters.gradient);
    Real x[3] = {hop.height, hop.compression, hop.half_time};
    hop.found = false;
    Real last(1e300);
    for (int i = 0; i < 40; ++i) {
        const shot<number> there = shoot(lane, number::variable(x[0], 0), number::variable(x[1], 1),
                                         number::variable(x[2], 2));
        const number r[3] = {there.end.gap, there.end.gap_rate, there.end.pull};
        // Cramer's rule; the columns are the slopes
        const auto minor = [&](int column, const Real* by) {
            Real m[3][3];
            for (int row = 0; row < 3; ++row) {
                for (int c = 0; c < 3; ++c)
                    m[row][c] = c == column && by != nullptr ? by[row] : r[row].slope[c];
            }
            return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                   m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                   m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
        };
        const Real values[3] = {r[0].value, r[1].value, r[2].value};
        const Real whole = minor(-1, nullptr);
        Real change(0.0);
        for (int c = 0; c < 3; ++c) {
            const Real step = minor(c, values) / whole;
            x[c] = x[c] - step;
            change = larger(change, abs(step) / (Real(1.0) + abs(x[c])));
        }
        if (!(change - change == Real(0.0)) || change > Real(10.0)) return;
        // at full precision: steps are at rounding, or small and shrink no more
        const bool has_settled =
            change <= Real(close) || change <= Real(lane_traits<Real>::rounding * 4.0) ||
            (change <= Real(lane_traits<Real>::root_rounding) && change >= last * Real(0.5));
        if (has_settled) {
            hop = {x[0], x[1], x[2], -there.end.rate.value, true};
            return;
        }
        last = change;
    }
}

/// Solves to full precision; found only where the foot is in the air until the landing.
template <class Real>
inline void finish_symmetric_hop(const nonlinear_lane<Real>& parameters, symmetric_hop<Real>& hop) {
    solve_symmetric_hop(parameters, 0.0, hop);
    if (!hop.found) return;
    nonlinear_lane<Real> lane = parameters;
    lane.damping = Real(0.0);
    const shot<Real> whole = shoot(lane, hop.height, hop.compression, hop.half_time);
    hop.alpha = -whole.end.rate;
    hop.found = whole.is_free;
}

/// The persistent hop that the linear one with alpha*_k becomes when the nonlinear terms grow to
/// their values; found = false where it ends on the way, or is no free flight.
template <class Real>
inline symmetric_hop<Real> persistent_hop(const nonlinear_lane<Real>& parameters, int k) {
    if constexpr (!std::same_as<Real, double>) {  // polished from the one in double
        nonlinear_lane<double> narrow;
        narrow.mu = to_double(parameters.mu);
        narrow.inverse_total = to_double(parameters.inverse_total);
        narrow.spring = {to_double(parameters.spring.quadratic),
                         to_double(parameters.spring.cubic)};
        narrow.gradient = to_double(parameters.gradient);
        const symmetric_hop<double> start = persistent_hop(narrow, k);
        symmetric_hop<Real> hop{Real(start.height), Real(start.compression), Real(start.half_time),
                                Real(start.alpha), start.found};
        if (start.found) finish_symmetric_hop(parameters, hop);
        return hop;
    }
    const lossless<Real> point = lossless_point(Real(static_cast<double>(k)));
    const Real alpha = point.high + point.low;
    const Real reach = sqrt(Real(1.0) + alpha * alpha);
    symmetric_hop<Real> hop{alpha * alpha * Real(0.5), k % 2 == 1 ? reach : -reach, alpha, alpha,
                            true};
    nonlinear_lane<Real> lane = parameters;
    symmetric_hop<Real> before = hop;  // one stride back
    double done = 0.0;
    double last_stride = 1.0;
    double stride = 0.0625;
    while (done < 1.0) {
        if (stride < 1e-4) return {hop.height, hop.compression, hop.half_time, hop.alpha, false};
        const double next = done + stride < 1.0 ? done + stride : 1.0;
        const Real share(next);
        lane.spring = {parameters.spring.quadratic * share, parameters.spring.cubic * share};
        lane.gradient = parameters.gradient * share;
        const Real ratio((next - done) / last_stride);
        const symmetric_hop<Real> expected{
            fma(ratio, hop.height - before.height, hop.height),
            fma(ratio, hop.compression - before.compression, hop.compression),
            fma(ratio, hop.half_time - before.half_time, hop.half_time), hop.alpha, false};
        symmetric_hop<Real> trial = expected;
        solve_symmetric_hop(lane, 1e-4, trial);
        // no jumps to another hop: they lie half a period of the spring apart
        const bool is_near =
            abs(trial.half_time - expected.half_time) < Real(0.1) &&
            abs(trial.compression - expected.compression) < Real(0.1) * abs(expected.compression);
        if (trial.found && is_near) {
            before = hop;
            hop = trial;
            last_stride = next - done;
            done = next;
            stride *= 2.0;
        } else {
            stride *= 0.5;
        }
    }
    finish_symmetric_hop(lane, hop);
    return hop;
}

/// Does a flight from lift-off speed alpha end in sustained contact at its first landing?
inline bool lands_for_good(nonlinear_lane<double> lane, double alpha) {
    lane.tolerance = taylor::default_tolerance<double>;
    lane.damping = lane.restitution = 0.0;
    begin_at_lift_off(lane, alpha);
    unwatched watch;
    for (int i = 0; i < 1000 && lane.events == 0.0; ++i) {
        if (step_nonlinear(lane, true, watch).ended != 0.0) break;
    }
    return lane.events > 0.0 && lane.in_contact > 0.0;
}

/// Branch k of the return map: from alpha_k to the first speed whose landing is a bounce.
inline bool nonlinear_branch(const nonlinear_lane<double>& parameters, int k, map_branch& result) {
    if (k < 0 || k > 1000) return false;
    const auto speed = [&](int index, double& alpha) {
        if (index == 0) return alpha = 0.0, true;
        const symmetric_hop<double> hop = persistent_hop(parameters, index);
        return alpha = hop.alpha, hop.found;
    };
    double next = 0.0;
    if (!speed(k, result.base) || !speed(k + 1, next)) return false;
    double low = result.base + 1e-3 * (next - result.base);
    double high = next - 1e-3 * (next - result.base);
    result.end = low;
    if (!lands_for_good(parameters, low)) return true;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (lands_for_good(parameters, middle) ? low : high) = middle;
    }
    result.end = low;
    return true;
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::passive
