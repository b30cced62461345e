// One cycle of the planar mirror-law juggler, from apex to apex: flight, impact on the bar, flight.
// Source: models/mirror_juggler.md, section 4; Rizzi and Koditschek, Eqs (10)-(16).
#pragma once

#include "kernels/elementary/arctangent.hpp"
#include "kernels/elementary/sin_cos.hpp"
#include "kernels/lanes/implicit_root.hpp"
#include "kernels/mirror/flight.hpp"
#include "kernels/mirror/polynomial.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::mirror {

template <class Real>
struct planar_lane {
    // parameters
    Real restitution;
    Real gravity;
    Real gain_offset;
    Real energy_gain;
    Real target_x;
    Real target_height;
    Real position_gain;
    Real velocity_gain;
    Real shoulder_radius;
    Real bar_length;
    Real floor_height;
    Real horizontal_share;  // of v^2 in the regulated energy: 0 vertical, 1/2 total

    // the apex
    Real x;
    Real z;
    Real speed;  // horizontal velocity

    Real time;
    Real events;
    Real flight_time;
};

/// The ball at contact and how the bar meets it.
template <class Real>
struct planar_contact {
    mask_of<Real> has_gap;
    mask_of<Real> found;
    Real time;
    Real x;
    Real z;
    Real slope;    // of the bar, z / x
    Real closing;  // (z' - slope x') - (the same of the bar), < 0 at contact
};

/// (15): the bar's angle at contact is that of the ray of slope L / b_x, whatever K.
template <class Real>
HOPSCOTCH_DEVICE inline planar_contact<Real> solvable_contact(const planar_lane<Real>& lane,
                                                              const Real& regulation,
                                                              const Real& gain,
                                                              const Real& flight_end) {
    const Real slope = regulation / lane.x;
    const Real gap = lane.z - regulation;
    const ray_contact<Real> met = fall_on_ray(gap, slope * lane.speed, lane.gravity);
    const Real x = fma(lane.speed, met.time, lane.x);
    const mask_of<Real> has_gap = gap > Real(0.0);
    const mask_of<Real> found = met.time <= flight_end;
    const Real closing = -((Real(1.0) + gain) * met.closing);
    return {has_gap, found, met.time, x, slope * x, slope, closing};
}

/// Literal (16): contact at height H = L / (1 + K).
template <class Real>
HOPSCOTCH_DEVICE inline planar_contact<Real> level_contact(const planar_lane<Real>& lane,
                                                           const Real& regulation, const Real& gain,
                                                           const Real& flight_end) {
    const Real zero(0.0);
    const Real height = regulation / (Real(1.0) + gain);
    const Real drop = lane.z - height;
    const Real time = sqrt(Real(2.0) * drop / lane.gravity);
    const Real x = fma(lane.speed, time, lane.x);
    // theta_b > theta_c at the apex; theta_c lies beyond +-pi/2 where the ball has passed the
    // shoulder
    const mask_of<Real> above = fma(lane.z, x, -(height * lane.x)) > zero;
    const mask_of<Real> has_gap =
        (drop > zero) & ((above & (x > zero)) | (!(x > zero) & (height < zero)));
    const mask_of<Real> found = time <= flight_end;
    const Real slope = height / x;
    const Real closing = -((Real(1.0) + gain) * fma(lane.gravity, time, slope * lane.speed));
    return {has_gap, found, time, x, height, slope, closing};
}

/// (12): the regulation follows the ball; contact where (1 + K) theta_b = l, first root certified.
template <class Real>
struct original_law {
    Real x, z, speed, gravity;
    Real gain;    // 1 + K
    Real offset;  // l(0)
    Real position_gain;

    HOPSCOTCH_DEVICE value_and_slope<Real> at(const Real& t) const {
        const Real ball_x = fma(speed, t, x);
        const Real ball_z = fma(t * t, Real(-0.5) * gravity, z);
        const Real turning = -fma(gravity * t, ball_x, ball_z * speed);  // rho^2 theta_b'
        const Real square = fma(ball_x, ball_x, ball_z * ball_z);
        return {fma(gain, atan2(ball_z, ball_x), -fma(position_gain * speed, t, offset)),
                fma(gain, turning / square, -(position_gain * speed))};
    }
    /// rho^2 F', whose sign changes split F into monotone pieces.
    HOPSCOTCH_DEVICE void slope_polynomial(Real (&c)[5]) const {
        const Real pull = position_gain * speed;
        const Real half = Real(0.5) * gravity;
        c[0] = -fma(gain * speed, z, pull * fma(x, x, z * z));
        c[1] = -fma(gain * gravity, x, Real(2.0) * pull * speed * x);
        c[2] = -fma(gain * speed, half, pull * fma(speed, speed, -(gravity * z)));
        c[3] = Real(0.0);
        c[4] = -(pull * half * half);
    }
};

template <class Real>
HOPSCOTCH_DEVICE inline planar_contact<Real> original_contact(const planar_lane<Real>& lane,
                                                              const Real& gain,
                                                              const Real& flight_end,
                                                              const mask_of<Real>& active) {
    using plain = primal_of<Real>;
    const Real one(1.0);
    const Real offset =
        fma(lane.position_gain, lane.x - lane.target_x, lane.velocity_gain * lane.speed);
    const original_law<Real> law{lane.x,     lane.z, lane.speed,        lane.gravity,
                                 one + gain, offset, lane.position_gain};
    const original_law<plain> value{
        primal(law.x),    primal(law.z),      primal(law.speed),        primal(law.gravity),
        primal(law.gain), primal(law.offset), primal(law.position_gain)};
    const mask_of<Real> has_gap = value.at(plain(0.0)).value > plain(0.0);
    const mask_of<Real> wanted =
        active & has_gap & (value.gain > plain(0.0)) & (primal(flight_end) < infinity<plain>());
    plain polynomial[5];
    value.slope_polynomial(polynomial);
    const plain end = select(wanted, primal(flight_end), plain(1.0));
    const auto falling = [&](const plain& t) { return value.at(t); };
    const first_fall<plain> fall = first_fall_of<4>(falling, polynomial, end, wanted, wanted);
    const Real time =
        implicit_root(fall.time, law.at(Real(fall.time)).value, value.at(fall.time).slope);
    const Real x = fma(lane.speed, time, lane.x);
    const Real z = fma(time * time, Real(-0.5) * lane.gravity, lane.z);
    // From the law's angle, not from the ball's place: next to the shoulder that keeps the digits.
    // A gain near -1 spoils the angle instead.
    const mask_of<Real> by_angle = law.gain > Real(0.25);
    const Real angle = fma(law.position_gain * law.speed, time, law.offset) / law.gain;
    const Real slope = select(by_angle, tan(angle), z / x);
    // of bar against ball: rho (1 + K) theta_b' - rho l', times rho / x
    const Real closing = -fma(one + gain, fma(slope, lane.speed, lane.gravity * time),
                              lane.position_gain * lane.speed * fma(slope, z, x));
    return {has_gap, fall.found, time, x, z, slope, closing};
}

/// Tells a Watch about a completed cycle.
template <class Real, class Watch>
void report_cycle(const planar_lane<Real>& lane, const planar_contact<Real>& contact,
                  const Real& speed, const Real& rise, const Real& rise_time, Watch& watch) {
    const auto ballistic = [&](Real x, Real z, Real vx, Real vz) {
        return [=, g = lane.gravity](Real t, Real* column) {
            column[0] = x + vx * t;
            column[1] = z + t * (vz - Real(0.5) * g * t);
            column[2] = vx;
            column[3] = vz - g * t;
        };
    };
    const auto descent = ballistic(lane.x, lane.z, lane.speed, Real(0.0));
    const auto ascent = ballistic(contact.x, contact.z, speed, rise);
    Real before[4];
    Real after[4];
    descent(contact.time, before);
    ascent(Real(0.0), after);
    const Real kinetic = Real(0.5) * (before[2] * before[2] + before[3] * before[3] -
                                      after[2] * after[2] - after[3] * after[3]);
    watch.phase("flight", lane.time, contact.time, descent);
    watch.event("impact", lane.time + contact.time, "flight", "flight", before, after, kinetic);
    if (rise > Real(0.0)) watch.phase("flight", lane.time + contact.time, rise_time, ascent);
}

/// One cycle for every active lane.
template <int Law, class Real, class Watch>
HOPSCOTCH_DEVICE inline progress<Real> planar_cycle(planar_lane<Real>& lane,
                                                    const mask_of<Real>& active, Watch& watch) {
    const Real zero(0.0);
    const Real one(1.0);
    const Real missing = fma(-lane.horizontal_share, lane.speed * lane.speed,
                             lane.gravity * (lane.target_height - lane.z));
    const Real gain = fma(lane.energy_gain, missing, lane.gain_offset);
    const Real regulation =
        fma(lane.position_gain, lane.x - lane.target_x, lane.velocity_gain * lane.speed);
    const horizontal<Real> motion{lane.x, lane.x * lane.speed, lane.speed * lane.speed, zero};
    const Real shoulder = shoulder_time(motion, lane.shoulder_radius);
    const Real floor = floor_time(lane.z, lane.floor_height, lane.gravity);
    const Real flight_end = smaller(shoulder, floor);

    planar_contact<Real> contact;
    if constexpr (Law == solvable) {
        contact = solvable_contact(lane, regulation, gain, flight_end);
    } else if constexpr (Law == level) {
        contact = level_contact(lane, regulation, gain, flight_end);
    } else {
        contact = original_contact(lane, gain, flight_end, active);
    }
    // the impulse is along (-slope, 1)
    const Real impulse =
        -((one + lane.restitution) * contact.closing) / fma(contact.slope, contact.slope, one);
    const Real speed = fma(-contact.slope, impulse, lane.speed);
    const Real rise = fma(-lane.gravity, contact.time, impulse);
    const Real rise_time = rise / lane.gravity;
    const Real x = fma(speed, rise_time, contact.x);
    const Real z = fma(rise, Real(0.5) * rise_time, contact.z);

    const Real reach = sqrt(fma(contact.x, contact.x, contact.z * contact.z));
    const cycle_tests<Real> tests{lane.x <= lane.shoulder_radius,
                                  contact.has_gap,
                                  contact.found,
                                  shoulder <= floor,
                                  reach <= lane.bar_length,
                                  rise > zero,
                                  x <= lane.shoulder_radius};
    Real ended = outcome_of(tests, gain);
    const Real sum = x + z + speed;
    const mask_of<Real> finite = sum - sum == zero;
    ended = select((ended == zero) & !finite, code_of<Real>(outcome::not_finite), ended);
    const mask_of<Real> returned = active & (ended == zero);
    // an apex beyond the shoulder ends the orbit but is reported
    const mask_of<Real> impacts = active & !tests.starts_at_shoulder & (gain > -one) &
                                  tests.has_gap & tests.has_contact & tests.on_bar & finite;
    const mask_of<Real> reaches_apex = impacts & tests.rises;
    if constexpr (Watch::is_active) {
        if (impacts) report_cycle(lane, contact, speed, rise, rise_time, watch);
    }
    const Real duration = contact.time + select(reaches_apex, rise_time, zero);
    lane.time = select(impacts, lane.time + duration, lane.time);
    lane.flight_time = select(impacts, lane.flight_time + contact.time, lane.flight_time);
    lane.events = select(impacts, lane.events + one, lane.events);
    lane.x = select(reaches_apex, x, lane.x);
    lane.z = select(reaches_apex, z, lane.z);
    lane.speed = select(reaches_apex, speed, lane.speed);
    return {returned, ended};
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::mirror
