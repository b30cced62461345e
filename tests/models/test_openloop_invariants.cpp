// The clock-driven hopper: invariants, a step-by-step simulation that knows nothing of closed
// forms, and 50-digit truth.
#include "tests/models/openloop_machine.hpp"

#include "kernels/models/openloop_hopper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace hopscotch {
namespace {

using namespace testing_models::openloop_machine;

TEST(openloop_hopper, no_hop_orbit_is_the_linear_fixed_point) {
    const machine m{.thrust = 2.5, .on = 0.02, .period = 0.15};
    const point x = periodic_point(m, {-1.0, 0.1});
    // Y* - Y_off = (I - e^{A tau})^{-1} e^{A(tau - t_on)} (I - e^{A t_on}) (Y_on - Y_off)
    const auto flow = [&](double t, double* e) {
        const double s = t * m.w, d = std::sqrt(1 - m.zeta * m.zeta);
        const double scale = std::exp(-m.zeta * s), c = scale * std::cos(d * s);
        const double i = scale * std::sin(d * s) / d;
        e[0] = c + m.zeta * i, e[1] = i, e[2] = -i, e[3] = c - m.zeta * i;
    };
    double whole[4], off[4], on[4];
    flow(m.period, whole);
    flow(m.period - m.on, off);
    flow(m.on, on);
    const double p = (1 - on[0]) * m.thrust, q = -on[2] * m.thrust;
    const double r = off[0] * p + off[1] * q, s = off[2] * p + off[3] * q;
    const double det = (1 - whole[0]) * (1 - whole[3]) - whole[1] * whole[2];
    EXPECT_NEAR(x.height, -1 + ((1 - whole[3]) * r + whole[1] * s) / det, 1e-13);
    EXPECT_NEAR(x.velocity, (whole[2] * r + (1 - whole[0]) * s) / det, 1e-13);
    const image f = map(m, x);
    EXPECT_NEAR(f.j[0], whole[0], 1e-13);
    EXPECT_NEAR(f.j[1], whole[1], 1e-13);
    EXPECT_EQ(watch(m, x).word(), "-+");
}

TEST(openloop_hopper, determinant_is_the_decay_over_total_stance_time) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> h(-4, 2), v(-3, 3), tau(0.09, 0.45);
    for (int i = 0; i < 200; ++i) {
        const machine m = i % 2 ? long_thrust(tau(random)) : short_thrust(tau(random));
        const point x{h(random), v(random)};
        const double stance = watch(m, x).stance * m.w;
        const image f = map(m, x);
        const double size = std::abs(f.j[0] * f.j[3]) + std::abs(f.j[1] * f.j[2]);  // what cancels
        EXPECT_NEAR(f.det(), std::exp(-2 * m.zeta * stance), 1e-12 * (1 + size)) << i;
    }
}

TEST(openloop_hopper, work_is_what_damping_takes_on_a_periodic_orbit) {
    const machine m = long_thrust();
    const point x = periodic_point(m, {-2.448, -0.725});
    const double work = std::stod(run(m, 0, x.height / 900, x.velocity / 30).extras[2]);
    // Simpson's rule with 200 intervals per phase: relative error below 1e-7
    EXPECT_NEAR(work, 2 * m.zeta * m.w * watch(m, x).velocity_squared, 1e-8 * work + 1e-10);
}

TEST(openloop_hopper, multipliers_agree_on_all_sections) {
    const machine m = long_thrust();
    const point x = periodic_point(m, {-1.705, 0.931});
    const recorder seen = watch(m, x);  // T - L +
    const image strobe = map(m, x);
    for (int section : {1, 2}) {
        const auto& e = seen.events[section == 1 ? 2u : 0u];
        ASSERT_EQ(e.name, section == 1 ? "landing" : "take-off");
        const orbit a = run(m, section, e.time, e.before[1], 1, true);
        EXPECT_EQ(a.end, outcome::ok);
        EXPECT_NEAR(column(a, 0), e.time, 1e-13);
        EXPECT_NEAR(column(a, 1), e.before[1], 1e-13);
        const double j[] = {std::stod(a.derivative[0]), std::stod(a.derivative[1]),
                            std::stod(a.derivative[2]), std::stod(a.derivative[3])};
        EXPECT_NEAR(j[0] + j[3], strobe.trace(), 1e-10);
        EXPECT_NEAR(j[0] * j[3] - j[1] * j[2], strobe.det(), 1e-10);
    }
}

TEST(openloop_hopper, take_off_and_landing_sections_are_one_flight_apart) {
    const machine m = long_thrust();
    const orbit to_landing = run(m, 1, 0.25, -0.07);
    const orbit to_take_off = run(m, 2, std::stod(to_landing.columns[0]) - 2 * 0.05 + 0.0, 0.05);
    EXPECT_EQ(to_take_off.end, outcome::ok);
    EXPECT_GT(column(to_take_off, 1), 0.0);
    EXPECT_LT(column(to_landing, 1), 0.0);
    EXPECT_GE(column(to_landing, 0), 0.0);
    EXPECT_LT(column(to_landing, 0), m.period);
}

/// Fixed small Runge-Kutta steps, events by bisection inside the step. Scaled units; state at tau.
point stepped(const machine& m, point x, int& hops) {
    const double on = m.on * m.w, period = m.period * m.w, c = 2 * m.zeta;
    double t = 0, y = x.height, v = x.velocity, leg = 0;
    bool air = y > 0 || (y == 0 && v > 0);
    hops = 0;
    const auto advance = [&](double h, double& py, double& pv, double& pl, double f) {
        if (air) {
            // the leg by its exact relaxation, the body by its parabola
            pl = std::min(0.0, f - (f - pl) * std::exp(-h / c));
            py += h * (pv - h / 2);
            pv -= h;
            return;
        }
        const auto a = [&](double q, double r) { return f - 1 - q - c * r; };
        const double k1 = pv, l1 = a(py, pv), k2 = pv + h / 2 * l1, l2 = a(py + h / 2 * k1, k2);
        const double k3 = pv + h / 2 * l2, l3 = a(py + h / 2 * k2, k3), k4 = pv + h * l3,
                     l4 = a(py + h * k3, k4);
        py += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        pv += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
        pl = py;
    };
    const auto guard = [&](double py, double pv, double pl,
                           double f) {  // event where it becomes > 0
        if (air) return (m.guard ? pl : 0.0) - py;
        const double pull = py + c * pv - f;
        return m.guard ? std::max(py, pull) : py;
    };
    while (t < period - 1e-13) {
        const double f = t < on - 1e-13 ? m.thrust : 0.0;
        double h = std::min(5e-4, (t < on - 1e-13 ? on : period) - t);
        double ny = y, nv = v, nl = leg;
        advance(h, ny, nv, nl, f);
        const bool at_once = !air && m.guard && y + c * v - f > 0 && v > 0;
        if (at_once || guard(ny, nv, nl, f) > 0) {
            double low = 0, high = at_once ? 0 : h;
            for (int i = 0; i < 60; ++i) {
                const double middle = (low + high) / 2;
                ny = y, nv = v, nl = leg;
                advance(middle, ny, nv, nl, f);
                (guard(ny, nv, nl, f) > 0 ? high : low) = middle;
            }
            ny = y, nv = v, nl = leg;
            advance(high, ny, nv, nl, f);
            const bool leaves = !air && (nv > 0);
            const bool lands = air && (high > 1e-12);
            h = high;
            y = ny, v = nv, leg = nl;
            t += h;
            if (leaves) {
                air = true;
                ++hops;
                const double tiny = 1e-9;  // leave the guard
                advance(tiny, y, v, leg, f);
                t += tiny;
            } else if (lands) {
                air = false;
                y = std::min(y, 0.0);
            }
            continue;
        }
        y = ny, v = nv, leg = nl;
        t += h;
    }
    return {y, v};
}

TEST(openloop_hopper, agrees_with_a_stepped_simulation_under_both_guards) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> h(-3, 1.5), v(-2, 2), tau(0.09, 0.35), z(0.05, 1.6),
        f(0, 5);
    int hopping = 0;
    for (int i = 0; i < 150; ++i) {
        machine m{.zeta = z(random),
                  .thrust = f(random),
                  .on = i % 3 ? 0.02 : 0.08,
                  .period = tau(random)};
        m.guard = i % 2;
        const point x{h(random), v(random)};
        int hops = 0;
        const point truth = stepped(m, x, hops);
        const image got = map(m, x);
        double spread = 1;
        for (double j : got.j) spread = std::max(spread, std::abs(j));
        // steps of 5e-4 and the nudge of 1e-9 after take-off
        EXPECT_NEAR(got.to.height, truth.height, 3e-8 * spread) << i;
        EXPECT_NEAR(got.to.velocity, truth.velocity, 3e-8 * spread) << i;
        hopping += hops;
    }
    EXPECT_GT(hopping, 60);
}

TEST(openloop_hopper, one_period_has_errors_below_1e_13_times_the_condition) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> h(-4, 2), v(-3, 3), tau(0.09, 0.45), z(0.0, 1.7),
        f(0.2, 6);
    for (int i = 0; i < 300; ++i) {
        machine m{.zeta = i % 7 == 0 ? 1.0 : z(random),
                  .thrust = f(random),
                  .on = i % 2 ? 0.02 : 0.08,
                  .period = tau(random)};
        m.guard = (i / 2) % 2;
        const point x{h(random), v(random)};
        const image got = map(m, x);
        const orbit truth = run(m, 0, x.height / 900, x.velocity / 30, 1, false, table().run_mp50);
        ASSERT_EQ(got.end, truth.end) << i;
        double spread = 1;
        for (double j : got.j) spread = std::max(spread, std::abs(j));
        const double height = to_double(parse_real<real50>(truth.columns[0]) * real50(900.0));
        const double velocity = to_double(parse_real<real50>(truth.columns[1]) * real50(30.0));
        EXPECT_NEAR(got.to.height, height, 1e-13 * spread) << i << " zeta " << m.zeta;
        EXPECT_NEAR(got.to.velocity, velocity, 1e-13 * spread) << i << " zeta " << m.zeta;
    }
}

TEST(openloop_hopper, derivatives_match_50_digit_central_differences) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> h(-3, 1.5), v(-2, 2), z(0.05, 1.5);
    for (int i = 0; i < 24; ++i) {
        machine m = i % 2 ? long_thrust() : short_thrust(0.2);
        m.zeta = z(random);
        m.guard = (i / 2) % 2;
        const real50 x[2] = {real50(h(random) / 900), real50(v(random) / 30)};
        const real50 step("1e-18");
        const orbit got =
            run_texts(table().run_mp50, m, 0, {print_real(x[0]), print_real(x[1])}, 1, true);
        for (std::size_t c = 0; c < 2; ++c) {
            std::vector<std::string> up{print_real(x[0]), print_real(x[1])}, down = up;
            up[c] = print_real(x[c] + step);
            down[c] = print_real(x[c] - step);
            const orbit a = run_texts(table().run_mp50, m, 0, up, 1),
                        b = run_texts(table().run_mp50, m, 0, down, 1);
            for (std::size_t r = 0; r < 2; ++r) {
                const double slope = to_double(
                    (parse_real<real50>(a.columns[r]) - parse_real<real50>(b.columns[r])) /
                    (step + step));
                const double derived = std::stod(got.derivative[2 * r + c]);
                EXPECT_NEAR(derived, slope, 1e-12 * (1 + std::abs(slope))) << i;
            }
        }
    }
}

}  // namespace
}  // namespace hopscotch
