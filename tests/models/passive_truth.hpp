// The passive hopper a second time, for tests only: marching in 50-digit arithmetic with a step
// that cannot pass the first contact, straight from the equations of motion. It shares no formula
// with kernels/passive (no half flight times, no pieces, no brackets). Also the closed forms of the
// page's section 3.
#pragma once

#include "analysis/truth/real50.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace hopscotch::inline HOPSCOTCH_TARGET::passive_truth {

inline real50 pi50() { return pi<real50>(); }
inline real50 truth(const char* decimal) { return real50(std::string(decimal)); }

/// alpha*_k = tan alpha*_k as the fixed point of x = k pi + atan x.
inline real50 lossless(int k) {
    if (k == 0) return real50(0.0);
    static std::map<int, real50> known;
    if (const auto found = known.find(k); found != known.end()) return found->second;
    real50 x = (real50(k) + 0.5) * pi50();
    for (int i = 0; i < 12; ++i) {  // Newton's method; 12 doublings from 1e-2
        const real50 residual = x - real50(k) * pi50() - atan(x);
        x = x - residual * (x * x + 1.0) / (x * x);
    }
    known.emplace(k, x);
    return x;
}

struct machine {
    real50 mass_ratio = 1.0;
    real50 restitution = 0.0;
    real50 damping = 0.0;
    bool is_unbounded = false;  // mass_ratio = infinity

    real50 inverse_total() const {
        return is_unbounded ? real50(0.0) : real50(1.0) / (mass_ratio + 1.0);
    }
    real50 mu() const { return real50(1.0) - inverse_total(); }
    real50 kappa() const { return mu() * inverse_total(); }
};

/// Spring extension, gap = (1 + M) y2 = w1 - w2, and their rates.
struct motion {
    real50 spring, spring_rate, gap, gap_rate;
};

enum class launch { free, rest, lift_off };

/// What one return made of a start.
struct history {
    bool lifts = false;  // false: stuck
    real50 speed = 0.0;  // at the next lift-off
    real50 time = 0.0;
    real50 loss = 0.0;
    int impacts = 0;      // including the one that begins sustained contact
    int audible = 0;      // bounces with |v2-| > 1e-8, what the model counts for restitution > 0
    motion at_contact{};  // just after the impact that began it
    real50 flight_time = 0.0;        // of the first flight
    double least_clearance = 1e300;  // over the samples taken, away from launch and landing
};

class simulator {
public:
    explicit simulator(const machine& of) : machine_(of) {}

    motion lift_off_state(const real50& alpha) const {
        return {real50(1.0) - machine_.damping * 2.0 * alpha, alpha, 0.0, 0.0};
    }
    motion hopper_state(double y1, double v1, double y2, double v2) const {
        const real50 total = machine_.mass_ratio + 1.0;
        return {real50(y1) - y2, real50(v1) - v2, total * y2, total * v2};
    }

    motion at(const motion& start, const real50& t) const {
        motion now{};
        const real50 zeta = machine_.damping;
        const real50 frequency = sqrt(real50(1.0) - zeta * zeta);
        const auto turn = sin_cos(frequency * t);
        const real50 decay = zeta == 0.0 ? real50(1.0) : exp(-(zeta * t));
        const real50 s = start.spring;
        const real50 v = start.spring_rate;
        now.spring = decay * (s * turn.cos + (v + zeta * s) / frequency * turn.sin);
        now.spring_rate = decay * (v * turn.cos - (s + zeta * v) / frequency * turn.sin);
        // c = s + G - 1 falls freely
        const real50 c = start.spring + start.gap - 1.0;
        const real50 c_rate = start.spring_rate + start.gap_rate;
        now.gap = c + c_rate * t - t * t * 0.5 + 1.0 - now.spring;
        now.gap_rate = c_rate - t - now.spring_rate;
        return now;
    }
    real50 force(const motion& now) const {
        return now.spring + machine_.damping * 2.0 * now.spring_rate;
    }

    /// First t > 0 with gap 0. Every step is shorter than the time the gap needs to vanish under
    /// the bounds |F|, |F'|, |F''| <= (1 + 2 zeta)^n sqrt(s^2 + s'^2), which hold for all later
    /// times.
    real50 first_contact(const motion& start, launch kind, double* clearance = nullptr) const {
        const double grown = 1.0 + 2.0 * to_double(machine_.damping);
        const double reach =
            to_double(sqrt(start.spring * start.spring + start.spring_rate * start.spring_rate));
        const double force_rate_bound = reach * grown * grown * (1.0 + 1e-9);
        const double bend_rate_bound = force_rate_bound * grown;
        const double curvature_bound = 1.0 + reach * grown * (1.0 + 1e-9);
        real50 t(0.0);
        if (kind == launch::rest) {  // G >= eta t^2 / 2 - |F'| t^3 / 6
            t = (force(start) - 1.0) * (2.9 / force_rate_bound);
        } else if (kind == launch::lift_off) {  // G >= F' t^3 / 6 - |F''| t^4 / 24
            const real50 force_rate = start.spring_rate - machine_.damping * 2.0 * force(start);
            t = force_rate * (3.9 / bend_rate_bound);
        }
        for (int i = 0; i < 2000000; ++i) {
            const motion now = at(start, t);
            const double gap = to_double(now.gap);
            const double rate = to_double(now.gap_rate);
            const double bend = std::abs(to_double(force(now) - 1.0));
            double step = 0.0;
            for (double window = 4.0; window > 1e-40; window *= 0.25) {
                const double bound = std::min(bend + force_rate_bound * window, curvature_bound);
                // the positive root of G + G' d - L d^2 / 2, without cancellation
                const double root = std::sqrt(rate * rate + 2.0 * bound * gap);
                const double d = rate > 0.0 ? (rate + root) / bound : 2.0 * gap / (root - rate);
                step = std::max(step, std::min(d, window));
                if (window < step) break;
            }
            if (clearance != nullptr && t > 0.3 && step > 0.05)
                *clearance = std::min(*clearance, gap);
            if (rate < 0.0 && step < 1e-9 && gap < 1e-6 * rate * rate) return polished(start, t);
            t += real50(step * (1.0 - 1e-12));
        }
        throw std::runtime_error("the truth found no contact");
    }

    /// From a state in the air (or launched from the ground) to the next lift-off from sustained
    /// contact.
    history next_lift_off(motion from, launch kind) const {
        history past;
        for (int flight = 0; flight < 1000000; ++flight) {
            const real50 duration =
                first_contact(from, kind, flight == 0 ? &past.least_clearance : nullptr);
            motion at_impact = at(from, duration);
            if (flight == 0) past.flight_time = duration;
            past.time += duration;
            if (strike(at_impact, past)) return rest_on_ground(at_impact, past);
            from = at_impact;
            kind = from.gap_rate > 0.0 ? launch::free : launch::rest;
        }
        throw std::runtime_error("the truth bounced too often");
    }
    history from_lift_off(const real50& alpha) const {
        return next_lift_off(lift_off_state(alpha), launch::lift_off);
    }

    /// Sustained contact from y1 = spring, v1 = spring_rate to the next lift-off.
    history rest_on_ground(const motion& begin, history past = {}) const {
        past.at_contact = begin;
        const real50 y = begin.spring;
        const real50 v = begin.spring_rate;
        const real50 mu = machine_.mu();
        const real50 lightness =
            machine_.is_unbounded ? real50(0.0) : real50(1.0) / machine_.mass_ratio;
        const real50 zeta = machine_.damping;
        const real50 decay = zeta * mu;
        const real50 frequency = sqrt(mu - decay * decay);
        // z = y1 + 1/M oscillates about 0; F + 1/M = z + 2 zeta z'
        const real50 z0 = y + lightness;
        const auto z_at = [&](const real50& t, real50& rate) {
            const auto turn = sin_cos(frequency * t);
            const real50 fade = zeta == 0.0 ? real50(1.0) : exp(-(decay * t));
            rate = fade * (v * turn.cos - (mu * z0 + decay * v) / frequency * turn.sin);
            return fade * (z0 * turn.cos + (v + decay * z0) / frequency * turn.sin);
        };
        const auto excess = [&](const real50& t) {
            real50 rate;
            const real50 z = z_at(t, rate);
            return z + zeta * 2.0 * rate - 1.0 - lightness;
        };
        const auto excess_rate = [&](const real50& t) {
            real50 rate;
            const real50 z = z_at(t, rate);
            return rate - zeta * 2.0 * (mu * z + decay * 2.0 * rate);
        };
        const real50 period = pi50() * 2.0 / frequency;
        const int n = 40;
        real50 before(0.0);
        for (int i = 1; i <= n + n / 4; ++i) {
            real50 after = period * (static_cast<double>(i) / n);
            if (excess_rate(before) > 0.0 &&
                excess_rate(after) < 0.0) {  // a maximum: not beyond it
                real50 fallen = after;
                after = before;
                for (int j = 0; j < 200; ++j) {
                    const real50 middle = (after + fallen) * 0.5;
                    (excess_rate(middle) > 0.0 ? after : fallen) = middle;
                }
            }
            if (excess(before) <= 0.0 && excess(after) > 0.0) {
                for (int j = 0; j < 200; ++j) {
                    const real50 middle = (before + after) * 0.5;
                    (excess(middle) > 0.0 ? after : before) = middle;
                }
                past.lifts = true;
                past.time += after;
                z_at(after, past.speed);
                return past;
            }
            before = period * (static_cast<double>(i) / n);
        }
        return past;
    }

private:
    machine machine_;

    real50 polished(const motion& start, real50 t) const {
        for (int i = 0; i < 6; ++i) {  // from 1e-9 relative: 4 doublings exhaust 64 digits
            const motion now = at(start, t);
            t = t - now.gap / now.gap_rate;
        }
        return t;
    }

    /// The impact. True where sustained contact begins (chatter: below 1e-22, whose third power is
    /// the error).
    bool strike(motion& now, history& past) const {
        const real50 share = machine_.inverse_total();
        const real50 body_rate = now.spring_rate + now.gap_rate * share;
        const real50 kept = machine_.restitution * machine_.restitution;
        past.loss += machine_.kappa() * (real50(1.0) - kept) * now.gap_rate * now.gap_rate;
        past.impacts += 1;
        const real50 foot = machine_.is_unbounded ? now.gap_rate : now.gap_rate * share;
        now.gap = 0.0;
        now.gap_rate = -(machine_.restitution * now.gap_rate);
        now.spring_rate = body_rate - now.gap_rate * share;
        const bool pressed = force(now) <= 1.0;
        if (pressed && now.gap_rate < 1e-22) {
            now.gap_rate = 0.0;
            now.spring_rate = body_rate;
            return true;
        }
        if (-foot > 1e-8) past.audible += 1;
        return false;
    }
};

/// One branch of the return map with a single impact, as functions of half the flight time (page,
/// section 3).
struct half_flight {
    real50 x, sine, cosine, p, q;
    explicit half_flight(const real50& half_time) : x(half_time) {
        const auto turn = sin_cos(x);
        sine = turn.sin;
        cosine = turn.cos;
        p = x * cosine - sine;
        q = x - sine * cosine;
    }
    real50 alpha() const { return (x * x - sine * sine) / q; }
    real50 slope() const { return p * p * 2.0 / (q * q); }
    real50 gap_rate() const { return p * p * -2.0 / q; }
    real50 toll() const { return gap_rate() * gap_rate(); }  // W
};

/// Half the flight time of the lift-off speed alpha, by bisection on the rising h(x).
inline half_flight half_flight_of(const real50& alpha) {
    // h(m pi) = m pi: h and x share their cell
    const real50 m = floor(alpha / pi50());
    real50 low = m * pi50();
    real50 high = low + pi50();
    if (m == 0.0) low = real50(1e-30);
    for (int i = 0; i < 60; ++i) {
        const real50 middle = (low + high) * 0.5;
        (half_flight(middle).alpha() < alpha ? low : high) = middle;
    }
    real50 x = (low + high) * 0.5;
    for (int i = 0; i < 80;
         ++i) {  // Newton, kept inside the bracket; slow only next to the triple root
        const half_flight here(x);
        const real50 residual = here.alpha() - alpha;
        (residual < 0.0 ? low : high) = x;
        real50 next = x - residual / here.slope();
        if (!(next > low && next < high)) next = (low + high) * 0.5;
        if (abs(next - x) < x * 1e-60) return half_flight(next);
        x = next;
    }
    return half_flight(x);
}

/// Root of a function that changes sign on [low, high].
template <class Function>
real50 bisect(const Function& f, real50 low, real50 high, int steps = 180) {
    const bool rises = f(high) > real50(0.0);
    for (int i = 0; i < steps; ++i) {
        const real50 middle = (low + high) * 0.5;
        ((f(middle) > real50(0.0)) == rises ? high : low) = middle;
    }
    return (low + high) * 0.5;
}

/// Argument of the least value of a function with one minimum in [low, high].
template <class Function>
real50 minimise(const Function& f, real50 low, real50 high, int steps = 60) {
    const real50 share = (sqrt(real50(5.0)) - 1.0) * 0.5;
    real50 a = high - share * (high - low);
    real50 b = low + share * (high - low);
    real50 fa = f(a);
    real50 fb = f(b);
    for (int i = 0; i < steps; ++i) {
        if (fa < fb) {
            high = b;
            b = a;
            fb = fa;
            a = high - share * (high - low);
            fa = f(a);
        } else {
            low = a;
            a = b;
            fa = fb;
            b = low + share * (high - low);
            fb = f(b);
        }
    }
    return (low + high) * 0.5;
}

/// D(x) = (alpha^2 - alpha*_k^2) / W: the kappa above which the branch of alpha*_k is left downward
/// at x.
inline real50 escaping_kappa(int k, const real50& x) {
    const half_flight here(x);
    const real50 point = lossless(k);
    const real50 alpha = here.alpha();
    return (alpha - point) * (alpha + point) / here.toll();
}

/// Place (half flight time) of the least D on the branch of alpha*_k.
inline real50 least_escape_place(int k) {
    const real50 point = lossless(k);
    const real50 end = pi50() * (k + 1.0);
    return minimise([&](const real50& x) { return escaping_kappa(k, x); },
                    point + (end - point) * 0.02, end);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::passive_truth
