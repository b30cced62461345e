// One cycle of the spatial mirror-law juggler, from apex to apex: flight, impact on the paddle,
// flight. Source: models/mirror_juggler.md, section 5; Rizzi and Koditschek, Eq (13).
#pragma once

#include "kernels/elementary/arctangent.hpp"
#include "kernels/elementary/sin_cos.hpp"
#include "kernels/lanes/implicit_root.hpp"
#include "kernels/mirror/flight.hpp"
#include "kernels/mirror/polynomial.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::mirror {

template <class Real>
struct spatial_lane {
    // parameters
    Real restitution;
    Real gravity;
    Real gain_offset;
    Real energy_gain;
    Real target_radius;
    Real target_azimuth;
    Real target_height;
    Real radial_gain;
    Real radial_rate_gain;
    Real lateral_gain;
    Real lateral_rate_gain;
    Real shoulder_radius;
    Real bar_length;
    Real floor_height;
    Real horizontal_share;  // of v^2 in the regulated energy: 0 vertical, 1/2 total

    // the apex
    Real x;
    Real y;
    Real z;
    Real vx;
    Real vy;

    Real time;
    Real events;
    Real flight_time;
};

/// A ballistic flight from its apex, in the arm's coordinates.
template <class Real>
struct arm_flight {
    Real x, y, z, vx, vy, gravity;
    Real distance;  // at the apex
    Real advance;   // position . velocity at the apex
    Real speed_square;
    Real spin;  // x vy - y vx, constant

    HOPSCOTCH_DEVICE static arm_flight with(const Real& x, const Real& y, const Real& z,
                                            const Real& vx, const Real& vy, const Real& gravity) {
        return {x,
                y,
                z,
                vx,
                vy,
                gravity,
                sqrt(fma(x, x, y * y)),
                fma(x, vx, y * vy),
                fma(vx, vx, vy * vy),
                fma(x, vy, -(y * vx))};
    }
    HOPSCOTCH_DEVICE Real distance_at(const Real& t) const {
        const Real there_x = fma(vx, t, x);
        const Real there_y = fma(vy, t, y);
        return sqrt(fma(there_x, there_x, there_y * there_y));
    }
    HOPSCOTCH_DEVICE Real advance_at(const Real& t) const { return fma(speed_square, t, advance); }
    HOPSCOTCH_DEVICE Real height_at(const Real& t) const {
        return fma(t * t, Real(-0.5) * gravity, z);
    }
};

template <class Real>
HOPSCOTCH_DEVICE inline arm_flight<primal_of<Real>> primal_flight(const arm_flight<Real>& f) {
    return {primal(f.x),        primal(f.y),       primal(f.z),
            primal(f.vx),       primal(f.vy),      primal(f.gravity),
            primal(f.distance), primal(f.advance), primal(f.speed_square),
            primal(f.spin)};
}

/// Height over the cone of slope s through the origin and, at the apex, at height `regulation`.
template <class Real>
struct cone_gap {
    arm_flight<Real> ball;
    Real slope;
    Real at_apex;

    HOPSCOTCH_DEVICE value_and_slope<Real> at(const Real& t) const {
        const Real distance = ball.distance_at(t);
        const Real climb = fma(ball.speed_square, t, Real(2.0) * ball.advance) * t /
                           (distance + ball.distance);  // distance - distance(0), uncancelled
        return {fma(-slope, climb, fma(t * t, Real(-0.5) * ball.gravity, at_apex)),
                -fma(ball.gravity, t, slope * ball.advance_at(t) / distance)};
    }
    /// g^2 t^2 R = s^2 (b . v)^2 at every extremum.
    HOPSCOTCH_DEVICE void extremum_polynomial(Real (&c)[5]) const {
        const Real steep = slope * slope;
        const Real square = ball.gravity * ball.gravity;
        c[0] = -(steep * ball.advance * ball.advance);
        c[1] = Real(-2.0) * steep * ball.advance * ball.speed_square;
        c[2] = fma(square * ball.distance, ball.distance,
                   -(steep * ball.speed_square * ball.speed_square));
        c[3] = Real(2.0) * square * ball.advance;
        c[4] = square * ball.speed_square;
    }
};

template <int A, int B, class Real>
HOPSCOTCH_DEVICE inline void add_product(const Real (&a)[A + 1], const Real (&b)[B + 1],
                                         const Real& factor, Real* sum) {
    for (int i = 0; i <= A; ++i) {
        for (int k = 0; k <= B; ++k) sum[i + k] = fma(factor * a[i], b[k], sum[i + k]);
    }
}

/// (1 + K) elevation - regulation of the ball where it is, Eq (13).
template <class Real>
struct current_law {
    arm_flight<Real> ball;
    Real gain;  // 1 + K
    Real radial_gain;
    Real radial_rate_gain;
    Real target_radius;

    HOPSCOTCH_DEVICE Real regulation(const Real& t) const {
        const Real distance = ball.distance_at(t);
        return fma(radial_gain, distance - target_radius,
                   radial_rate_gain * ball.advance_at(t) / distance);
    }
    HOPSCOTCH_DEVICE Real regulation_rate(const Real& t) const {
        const Real distance = ball.distance_at(t);
        const Real turning = ball.spin / distance;
        return fma(radial_gain, ball.advance_at(t), radial_rate_gain * turning * turning) /
               distance;
    }
    HOPSCOTCH_DEVICE value_and_slope<Real> at(const Real& t) const {
        const Real distance = ball.distance_at(t);
        const Real height = ball.height_at(t);
        const Real turning =
            -fma(ball.gravity * t, distance, height * ball.advance_at(t) / distance);
        const Real square = fma(distance, distance, height * height);
        return {fma(gain, atan2(height, distance), -regulation(t)),
                fma(gain, turning / square, -regulation_rate(t))};
    }
    /// r^3 rho^2 F', whose sign changes split F into monotone pieces.
    HOPSCOTCH_DEVICE void slope_polynomial(Real (&c)[8]) const {
        const Real zero(0.0);
        const Real one(1.0);
        const Real radius[3] = {ball.distance * ball.distance, Real(2.0) * ball.advance,
                                ball.speed_square};
        const Real advance[2] = {ball.advance, ball.speed_square};
        const Real height[3] = {ball.z, zero, Real(-0.5) * ball.gravity};
        const Real fall[2] = {zero, -ball.gravity};
        Real turning[4] = {zero, zero, zero, zero};  // z' R - z (b . v)
        add_product<1, 2>(fall, radius, one, turning);
        add_product<1, 2>(advance, height, -one, turning);
        Real square[5] = {radius[0], radius[1], radius[2], zero, zero};  // rho^2
        add_product<2, 2>(height, height, one, square);
        Real pull[4] = {radial_rate_gain * ball.spin * ball.spin, zero, zero, zero};
        add_product<1, 2>(advance, radius, radial_gain, pull);
        for (Real& coefficient : c) coefficient = zero;
        add_product<3, 2>(turning, radius, gain, c);
        add_product<3, 4>(pull, square, -one, c);
    }
};

/// The ball at contact and how the paddle meets it.
template <class Real>
struct spatial_contact {
    mask_of<Real> has_gap;
    mask_of<Real> found;
    Real time;
    Real height;
    Real distance;
    Real slope;    // tangent of the elevation
    Real closing;  // (z' - slope r') of the ball against the paddle, < 0
};

/// First contact with a cone fixed at the apex. For slope >= 0 its extremum is no extra point that
/// matters; for slope < 0 there may be three contacts.
template <class Real>
HOPSCOTCH_DEVICE inline spatial_contact<Real> cone_contact(const arm_flight<Real>& ball,
                                                           const Real& regulation, const Real& gain,
                                                           const Real& flight_end,
                                                           const mask_of<Real>& active) {
    using plain = primal_of<Real>;
    const Real slope = regulation / ball.distance;
    const cone_gap<Real> gap{ball, slope, ball.z - regulation};
    const cone_gap<plain> value{primal_flight(ball), primal(slope), primal(gap.at_apex)};
    const mask_of<Real> has_gap = value.at_apex > plain(0.0);
    const mask_of<Real> wanted = active & has_gap & (primal(flight_end) < infinity<plain>());
    plain polynomial[5];
    value.extremum_polynomial(polynomial);
    const plain end = select(wanted, primal(flight_end), plain(1.0));
    const mask_of<Real> bends = wanted & (value.slope < plain(0.0));
    const auto falling = [&](const plain& t) { return value.at(t); };
    const first_fall<plain> fall = first_fall_of<4>(falling, polynomial, end, bends, wanted);
    const Real time =
        implicit_root(fall.time, gap.at(Real(fall.time)).value, value.at(fall.time).slope);
    const Real distance = ball.distance_at(time);
    const Real closing = (Real(1.0) + gain) * gap.at(time).slope;
    return {has_gap, fall.found, time, slope * distance, distance, slope, closing};
}

/// Contact at height H = L / (1 + K).
template <class Real>
HOPSCOTCH_DEVICE inline spatial_contact<Real> level_contact(const arm_flight<Real>& ball,
                                                            const Real& regulation,
                                                            const Real& gain,
                                                            const Real& flight_end) {
    const Real zero(0.0);
    const Real height = regulation / (Real(1.0) + gain);
    const Real drop = ball.z - height;
    const Real time = sqrt(Real(2.0) * drop / ball.gravity);
    const Real distance = ball.distance_at(time);
    const mask_of<Real> above = fma(ball.z, distance, -(height * ball.distance)) > zero;
    const mask_of<Real> has_gap = (drop > zero) & above;
    const mask_of<Real> found = time <= flight_end;
    const Real slope = height / distance;
    const Real closing =
        -((Real(1.0) + gain) * fma(ball.gravity, time, slope * ball.advance_at(time) / distance));
    return {has_gap, found, time, height, distance, slope, closing};
}

/// First contact under the law that follows the ball.
template <class Real>
HOPSCOTCH_DEVICE inline spatial_contact<Real> current_contact(const current_law<Real>& law,
                                                              const Real& flight_end,
                                                              const mask_of<Real>& active) {
    using plain = primal_of<Real>;
    const arm_flight<Real>& ball = law.ball;
    const current_law<plain> value{primal_flight(ball), primal(law.gain), primal(law.radial_gain),
                                   primal(law.radial_rate_gain), primal(law.target_radius)};
    const mask_of<Real> has_gap = value.at(plain(0.0)).value > plain(0.0);
    const mask_of<Real> wanted =
        active & has_gap & (value.gain > plain(0.0)) & (primal(flight_end) < infinity<plain>());
    plain polynomial[8];
    value.slope_polynomial(polynomial);
    const plain end = select(wanted, primal(flight_end), plain(1.0));
    const auto falling = [&](const plain& t) { return value.at(t); };
    const first_fall<plain> fall = first_fall_of<7>(falling, polynomial, end, wanted, wanted);
    const Real time =
        implicit_root(fall.time, law.at(Real(fall.time)).value, value.at(fall.time).slope);
    const Real distance = ball.distance_at(time);
    const Real height = ball.height_at(time);
    // from the law's angle, as in the plane
    const mask_of<Real> by_angle = law.gain > Real(0.25);
    const Real slope = select(by_angle, tan(law.regulation(time) / law.gain), height / distance);
    const Real meeting = fma(ball.gravity, time, slope * ball.advance_at(time) / distance);
    const Real closing =
        -fma(law.gain, meeting, law.regulation_rate(time) * fma(slope, height, distance));
    return {has_gap, fall.found, time, height, distance, slope, closing};
}

/// An angle brought to [-pi, pi].
template <class Real>
HOPSCOTCH_DEVICE inline Real wrapped(const Real& angle) {
    return fma(-two_pi<Real>(), nearest(angle / two_pi<Real>()), angle);
}

/// Tells a Watch about an impact and the flights around it.
template <class Real, class Watch>
void report_cycle(const spatial_lane<Real>& lane, Real flight_time, const Real (&impact)[6],
                  Real rise_time, Watch& watch) {
    const auto ballistic = [g = lane.gravity](Real x, Real y, Real z, Real vx, Real vy, Real vz) {
        return [=](Real t, Real* column) {
            column[0] = x + vx * t;
            column[1] = y + vy * t;
            column[2] = z + t * (vz - Real(0.5) * g * t);
            column[3] = vx;
            column[4] = vy;
            column[5] = vz - g * t;
        };
    };
    const auto descent = ballistic(lane.x, lane.y, lane.z, lane.vx, lane.vy, Real(0.0));
    const auto ascent = ballistic(impact[0], impact[1], impact[2], impact[3], impact[4], impact[5]);
    Real before[6];
    Real after[6];
    descent(flight_time, before);
    ascent(Real(0.0), after);
    Real lost(0.0);
    for (int i = 3; i < 6; ++i) {
        lost = lost + Real(0.5) * (before[i] * before[i] - after[i] * after[i]);
    }
    watch.phase("flight", lane.time, flight_time, descent);
    watch.event("impact", lane.time + flight_time, "flight", "flight", before, after, lost);
    if (rise_time > Real(0.0)) {
        watch.phase("flight", lane.time + flight_time, rise_time, ascent);
    }
}

/// One cycle for every active lane.
template <int Law, class Real, class Watch>
HOPSCOTCH_DEVICE inline progress<Real> spatial_cycle(spatial_lane<Real>& lane,
                                                     const mask_of<Real>& active, Watch& watch) {
    const Real zero(0.0);
    const Real one(1.0);
    const auto ball =
        arm_flight<Real>::with(lane.x, lane.y, lane.z, lane.vx, lane.vy, lane.gravity);
    const Real missing = fma(-lane.horizontal_share, ball.speed_square,
                             lane.gravity * (lane.target_height - lane.z));
    const Real gain = fma(lane.energy_gain, missing, lane.gain_offset);
    const Real regulation = fma(lane.radial_gain, ball.distance - lane.target_radius,
                                lane.radial_rate_gain * ball.advance / ball.distance);
    const horizontal<Real> motion{ball.distance, ball.advance, ball.speed_square, ball.spin};
    const Real shoulder = shoulder_time(motion, lane.shoulder_radius);
    const Real floor = floor_time(lane.z, lane.floor_height, lane.gravity);
    const Real flight_end = smaller(shoulder, floor);

    spatial_contact<Real> contact;
    if constexpr (Law == solvable) {
        contact = cone_contact(ball, regulation, gain, flight_end, active);
    } else if constexpr (Law == level) {
        contact = level_contact(ball, regulation, gain, flight_end);
    } else {
        const current_law<Real> law{ball, one + gain, lane.radial_gain, lane.radial_rate_gain,
                                    lane.target_radius};
        contact = current_contact(law, flight_end, active);
    }
    const Real x = fma(lane.vx, contact.time, lane.x);
    const Real y = fma(lane.vy, contact.time, lane.y);

    // roll about the arm: from the apex, or current
    const bool is_current = Law == original;
    const Real azimuth = is_current ? atan2(y, x) : atan2(lane.y, lane.x);
    const Real away = is_current ? contact.distance : ball.distance;
    const Real roll = fma(lane.lateral_gain, wrapped(azimuth - lane.target_azimuth),
                          lane.lateral_rate_gain * ball.spin / (away * away));
    const auto turn = sin_cos(roll);

    // impulse J n with n = cos q3 n0 - sin q3 t; n0 = (-sin e, cos e) in the arm's vertical plane
    const Real level_share = one / sqrt(fma(contact.slope, contact.slope, one));  // cos e
    const Real impulse = -((one + lane.restitution) * turn.cos * level_share * contact.closing);
    const Real radial = -(impulse * turn.cos * level_share * contact.slope) / contact.distance;
    const Real lateral = -(impulse * turn.sin) / contact.distance;
    const Real vx = lane.vx + fma(radial, x, -(lateral * y));
    const Real vy = lane.vy + fma(radial, y, lateral * x);
    const Real rise = fma(impulse * turn.cos, level_share, -(lane.gravity * contact.time));
    const Real rise_time = rise / lane.gravity;
    const Real next_x = fma(vx, rise_time, x);
    const Real next_y = fma(vy, rise_time, y);
    const Real next_z = fma(rise, Real(0.5) * rise_time, contact.height);

    const Real reach =
        sqrt(fma(contact.distance, contact.distance, contact.height * contact.height));
    const Real next_distance = sqrt(fma(next_x, next_x, next_y * next_y));
    const cycle_tests<Real> tests{ball.distance <= lane.shoulder_radius,
                                  contact.has_gap,
                                  contact.found,
                                  shoulder <= floor,
                                  reach <= lane.bar_length,
                                  rise > zero,
                                  next_distance <= lane.shoulder_radius};
    Real ended = outcome_of(tests, gain);
    const Real sum = next_x + next_y + next_z + vx + vy;
    const mask_of<Real> finite = sum - sum == zero;
    ended = select((ended == zero) & !finite, code_of<Real>(outcome::not_finite), ended);
    const mask_of<Real> returned = active & (ended == zero);
    // an apex beyond the shoulder ends the orbit but is reported
    const mask_of<Real> impacts = active & !tests.starts_at_shoulder & (gain > -one) &
                                  tests.has_gap & tests.has_contact & tests.on_bar & finite;
    const mask_of<Real> reaches_apex = impacts & tests.rises;
    if constexpr (Watch::is_active) {
        const Real impact[6] = {x, y, contact.height, vx, vy, rise};
        if (impacts) report_cycle(lane, contact.time, impact, rise_time, watch);
    }
    const Real duration = contact.time + select(reaches_apex, rise_time, zero);
    lane.time = select(impacts, lane.time + duration, lane.time);
    lane.flight_time = select(impacts, lane.flight_time + contact.time, lane.flight_time);
    lane.events = select(impacts, lane.events + one, lane.events);
    lane.x = select(reaches_apex, next_x, lane.x);
    lane.y = select(reaches_apex, next_y, lane.y);
    lane.z = select(reaches_apex, next_z, lane.z);
    lane.vx = select(reaches_apex, vx, lane.vx);
    lane.vy = select(reaches_apex, vy, lane.vy);
    return {returned, ended};
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::mirror
