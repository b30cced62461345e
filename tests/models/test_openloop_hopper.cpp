// The clock-driven hopper against its page (models/openloop_hopper.md): published numbers, hard
// cases, invariants, a step-by-step simulation that knows nothing of closed forms, and 50-digit
// truth.
#include "analysis/orbit/instantiate.hpp"
#include "kernels/models/openloop_hopper.hpp"

#include <cmath>
#include <complex>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace hopscotch {
namespace {

using orbit = orbit_answer;

struct machine {
    double w = 30.0, zeta = 0.2, thrust = 1.55, on = 0.08, period = 0.26;
    int guard = 0;

    std::vector<std::string> texts() const {
        return {print_real(w), print_real(zeta), print_real(thrust), print_real(on),
                print_real(period)};
    }
    int variant() const { return 2 * guard + (zeta < 1.0 ? 0 : 1); }
};
machine long_thrust(double period = 0.26) { return {.period = period}; }
machine short_thrust(double period = 0.15) { return {.thrust = 3.8, .on = 0.02, .period = period}; }

using runner = orbit_answer (*)(const orbit_row&);
const orbit_functions& table = orbit_table<openloop_hopper>;

orbit run_texts(runner run, const machine& m, int section, const std::vector<std::string>& columns,
                std::uint32_t returns, bool derivative = false) {
    const std::vector<std::string> parameters = m.texts();
    const int options[] = {m.guard};
    orbit_row row;
    row.section = section;
    row.options = options;
    row.variant = m.variant();
    row.columns = columns;
    row.parameters = parameters;
    row.returns = returns;
    row.derivative = derivative;
    return run(row);
}
orbit run(const machine& m, int section, double first, double second, std::uint32_t returns = 1,
          bool derivative = false, runner how = table.run_double) {
    return run_texts(how, m, section, {print_real(first), print_real(second)}, returns, derivative);
}

/// A stroboscopic state in scaled units, and its return with the Jacobian.
struct point {
    double height, velocity;
};
struct image {
    point to;
    double j[4];
    outcome end;
    double trace() const { return j[0] + j[3]; }
    double det() const { return j[0] * j[3] - j[1] * j[2]; }
    double fold() const { return 1.0 - trace() + det(); }
    double flip() const { return 1.0 + trace() + det(); }
    double larger() const {  // of two real multipliers, the one of larger modulus
        const double root = std::sqrt(trace() * trace() / 4 - det());
        return trace() / 2 + (trace() < 0 ? -root : root);
    }
};
image map(const machine& m, point from, std::uint32_t returns = 1) {
    const double w = m.w;
    const orbit a = run(m, 0, from.height / (w * w), from.velocity / w, returns, true);
    image result{{std::stod(a.columns[0]) * w * w, std::stod(a.columns[1]) * w}, {}, a.end};
    const double scale[] = {1.0, w, 1.0 / w, 1.0};
    for (std::size_t i = 0; i < 4; ++i) result.j[i] = std::stod(a.derivative[i]) * scale[i];
    return result;
}

/// Newton's method for a periodic point.
point periodic_point(const machine& m, point x, std::uint32_t returns = 1) {
    for (int i = 0; i < 30; ++i) {
        const image f = map(m, x, returns);
        const double a = f.j[0] - 1, d = f.j[3] - 1, det = a * d - f.j[1] * f.j[2];
        const double r = f.to.height - x.height, s = f.to.velocity - x.velocity;
        const double dh = -(d * r - f.j[1] * s) / det, dv = -(a * s - f.j[2] * r) / det;
        x = {x.height + dh, x.velocity + dv};
        if (std::abs(dh) + std::abs(dv) < 1e-13) break;
    }
    return x;
}

/// A branch of period-1 orbits, parametrised by the activation velocity: the stride period and
/// height.
struct branch_point {
    machine m;
    point x;
    image f;
};
branch_point on_branch(machine m, point x) {
    for (int i = 0; i < 40; ++i) {
        const image f = map(m, x);
        const double step = 1e-6;
        machine shifted = m;
        shifted.period += step;
        const image g = map(shifted, x);
        // unknowns height and period, velocity fixed
        const double a = f.j[0] - 1, b = (g.to.height - f.to.height) / step;
        const double c = f.j[2], d = (g.to.velocity - f.to.velocity) / step;
        const double r = f.to.height - x.height, s = f.to.velocity - x.velocity;
        const double det = a * d - b * c;
        x.height -= (d * r - b * s) / det;
        m.period -= (a * s - c * r) / det;
        if (std::abs(r) + std::abs(s) < 1e-12) break;
    }
    return {m, x, map(m, x)};
}
/// Where `test` vanishes along the branch between two activation velocities.
branch_point find_on_branch(machine m, point x, double from, double to,
                            const std::function<double(const branch_point&)>& test) {
    const int steps = 12;  // continuation in small steps, then bisection
    branch_point left{m, x, {}};
    double at = from;
    x.velocity = from;
    left = on_branch(m, x);
    for (int i = 1; i <= steps; ++i) {
        const double next = from + (to - from) * i / steps;
        branch_point right = on_branch(left.m, {left.x.height, next});
        if (test(left) * test(right) <= 0) {
            double low = at, high = next;
            for (int k = 0; k < 30; ++k) {
                const double middle = (low + high) / 2;
                const branch_point there = on_branch(left.m, {left.x.height, middle});
                if (test(left) * test(there) <= 0) {
                    high = middle;
                    right = there;
                } else {
                    low = middle;
                }
            }
            return right;
        }
        left = right;
        at = next;
    }
    ADD_FAILURE() << "no change of sign along the branch";
    return left;
}

struct seen_event {
    std::string name;
    double time;
    double before[4];
};
struct recorder final : orbit_observer {
    std::vector<seen_event> events;
    double stance = 0.0;
    double lowest_force = 0.0;
    double velocity_squared = 0.0;  // integral over stance
    void phase(const char* mode, double, double duration, const sampler& at) override {
        if (std::string(mode) == "air") return;
        stance += duration;
        double c[4];
        const int n = 200;
        for (int i = 0; i <= n; ++i) {  // Simpson's rule
            at.state_at(duration * i / n, c);
            lowest_force = std::min(lowest_force, c[3]);
            const double weight = i == 0 || i == n ? 1 : i % 2 ? 4 : 2;
            velocity_squared += weight * c[1] * c[1] * duration / n / 3;
        }
    }
    void event(const char* name, double time, const char*, const char*, const double* before,
               const double*, double) override {
        events.push_back({name, time, {before[0], before[1], before[2], before[3]}});
    }
    std::string word() const {
        std::string letters;
        for (const auto& e : events) {
            letters += e.name == "take-off"    ? 'T'
                       : e.name == "landing"   ? 'L'
                       : e.name == "thrust on" ? '+'
                                               : '-';
        }
        return letters;
    }
    double take_off_speed() const {
        double fastest = 0.0;
        for (const auto& e : events) {
            if (e.name == "take-off") fastest = std::max(fastest, e.before[1]);
        }
        return fastest;
    }
};
recorder watch(const machine& m, double y, double v, std::uint32_t returns = 1, int section = 0) {
    const std::vector<std::string> columns{print_real(y), print_real(v)}, parameters = m.texts();
    const int options[] = {m.guard};
    orbit_row row;
    row.section = section;
    row.options = options;
    row.variant = m.variant();
    row.columns = columns;
    row.parameters = parameters;
    row.returns = returns;
    recorder seen;
    table.trace(row, seen);
    return seen;
}
recorder watch(const machine& m, point x) {
    return watch(m, x.height / (m.w * m.w), x.velocity / m.w);
}

double column(const orbit& a, std::size_t i) { return std::stod(a.columns[i]); }

// ---------------------------------------------------------------- published facts (page, section
// 7)

TEST(openloop_hopper, has_three_period_one_orbits_at_0_26_s) {
    struct row {
        point x;
        double mu;
    };  // printed to three decimals
    for (const row& r :
         {row{{-2.448, -0.725}, 0.0}, row{{-1.705, 0.931}, 1.536}, row{{-0.677, 0.265}, 0.0}}) {
        const point x = periodic_point(long_thrust(), r.x);
        EXPECT_NEAR(x.height, r.x.height, 6e-4);
        EXPECT_NEAR(x.velocity, r.x.velocity, 6e-4);
        const image f = map(long_thrust(), x);
        if (r.mu > 0) {
            EXPECT_NEAR(f.larger(), 1.536, 1e-3);
            EXPECT_NEAR(f.det() / f.larger(), 0.126, 1e-3);
        } else {
            EXPECT_LT(std::abs(f.det()), 1.0);
            EXPECT_GT(f.fold(), 0.0);
            EXPECT_GT(f.flip(), 0.0);
        }
        EXPECT_EQ(watch(long_thrust(), x).word(), "T-L+");
    }
}

TEST(openloop_hopper, long_thrust_folds_at_248_65_and_275_11_ms) {
    const auto fold = [](const branch_point& b) { return b.f.fold(); };
    const branch_point right = find_on_branch(long_thrust(), {-2.448, -0.725}, -0.725, 0.5, fold);
    const branch_point left = find_on_branch(long_thrust(), {-0.677, 0.265}, 0.265, 0.8, fold);
    EXPECT_NEAR(right.m.period, 0.27511, 6e-6);  // half a unit of the last printed digit
    EXPECT_NEAR(left.m.period, 0.24865, 6e-6);
    EXPECT_NEAR(right.f.larger(), 1.0, 1e-5);
    EXPECT_NEAR(left.f.larger(), 1.0, 1e-5);
}

TEST(openloop_hopper, long_thrust_is_highest_where_activation_is_at_lowest_point) {
    const branch_point still = on_branch(long_thrust(0.273), {-2.67, 0.0});
    // The table prints v_N = 0 at 273.1 ms. The page's own w tau = 8.197 (below the table) is
    // 273.23 ms, and so is the solution in 50 digits: its residual vanishes here.
    EXPECT_NEAR(still.m.period * 30.0, 8.197, 5e-4);
    const orbit truth = run(still.m, 0, still.x.height / 900, 0.0, 1, false, table.run_mp50);
    EXPECT_NEAR(std::stod(truth.columns[0]), still.x.height / 900, 1e-14);
    EXPECT_NEAR(std::stod(truth.columns[1]), 0.0, 1e-13);
    EXPECT_NEAR(map(still.m, still.x).larger(), 0.53, 0.03);  // the page's 0.53 is at 273.2 ms
    const auto apex = [&](double period) {
        machine m = long_thrust(period);
        const double u = watch(m, periodic_point(m, still.x)).take_off_speed();
        return u * u / 2;
    };
    EXPECT_GT(apex(0.2732), apex(0.2728));
    EXPECT_GT(apex(0.2732), apex(0.2736));
}

TEST(openloop_hopper, settles_lower_and_attracts_more_strongly_in_hop_settle_fire) {
    const point high = periodic_point(long_thrust(), {-2.448, -0.725});
    const point low = periodic_point(long_thrust(), {-0.677, 0.265});
    const auto apex = [](point x) {
        const double u = watch(long_thrust(), x).take_off_speed() * 30.0;
        return u * u / 2;
    };
    EXPECT_NEAR(apex(high), 2.64, 6e-3);
    EXPECT_NEAR(apex(low), 0.44, 6e-3);
    EXPECT_NEAR(std::sqrt(map(long_thrust(), low).det()), 0.31,
                6e-3);  // complex pairs: modulus^2 = det
    EXPECT_NEAR(std::sqrt(map(long_thrust(), high).det()), 0.53, 6e-3);
}

TEST(openloop_hopper, short_thrust_doubles_its_period_between_123_5_and_156_0_ms) {
    const auto flip = [](const branch_point& b) { return b.f.flip(); };
    const point x = periodic_point(short_thrust(), {-1.5, -0.6});
    const image f = map(short_thrust(), x);
    EXPECT_NEAR(f.larger(), -1.014, 1e-3);
    EXPECT_NEAR(f.det() / f.larger(), -0.307, 1e-3);
    EXPECT_NEAR(find_on_branch(short_thrust(), x, x.velocity, x.velocity + 0.25, flip).m.period,
                0.1560, 6e-5);
    EXPECT_NEAR(find_on_branch(short_thrust(), x, x.velocity, x.velocity - 0.6, flip).m.period,
                0.1235, 6e-5);
}

TEST(openloop_hopper, short_thrust_orbit_at_0_15_s_has_the_figure_10_condition) {
    const machine m = short_thrust();
    const point x = periodic_point(m, {-1.5, -0.6});
    const recorder seen = watch(m, x);
    const double frequency = std::sqrt(1 - m.zeta * m.zeta);
    const double stance = seen.stance * m.w;
    const double b = std::sin(frequency * stance) / frequency;
    const double u = seen.take_off_speed() * m.w;
    EXPECT_NEAR(u * b, 0.223, 6e-4);
    // q = v_T b - cos theta; multipliers -e^{-zeta T}(q +- sqrt(q^2 - 1)), the exact form of Eqs
    // (54)-(60)
    const double q = u * b - std::cos(frequency * stance);
    EXPECT_NEAR(map(m, x).larger(), -std::exp(-m.zeta * stance) * (q + std::sqrt(q * q - 1)),
                1e-11);
    EXPECT_EQ(seen.word(), "-TL+");
}

TEST(openloop_hopper, short_thrust_period_two_attracts_at_0_15_s) {
    const machine m = short_thrust();
    const orbit late = run(m, 0, -0.001, 0.0, 3000);
    const double y = column(late, 0), v = column(late, 1);
    const orbit once = run(m, 0, y, v, 1), twice = run(m, 0, y, v, 2);
    EXPECT_GT(std::abs(column(once, 0) - y), 1e-5);
    EXPECT_NEAR(column(twice, 0), y, 1e-15);
}

TEST(openloop_hopper, short_thrust_passes_zero_activation_velocity_at_223_6_ms) {
    const machine start = short_thrust(0.22);
    const point near = periodic_point(start, {-2.8, -0.05});
    EXPECT_NEAR(on_branch(start, {near.height, 0.0}).m.period, 0.2236, 6e-5);
}

TEST(openloop_hopper, short_thrust_ends_at_347_2_ms_where_thrust_ends_at_take_off) {
    machine m = short_thrust(0.34715);
    const point x = periodic_point(m, {-1.5965, 1.7557});
    const recorder before = watch(m, x);
    EXPECT_EQ(before.word(), "-TL+");
    EXPECT_NEAR(before.events[1].time, 0.02, 1e-4);  // take-off just after the thrust
    EXPECT_LT(map(m, x).trace() * map(m, x).trace(), 4 * map(m, x).det());  // a complex pair
    // the saddle that it meets: the multiplier has not passed 1
    const point saddle = periodic_point(m, {-1.5894, 1.7546});
    EXPECT_EQ(watch(m, saddle).word(), "T-L+");
    EXPECT_NEAR(map(m, saddle).larger(), 3.76, 6e-3);
    // take-off time minus t_on is linear in the distance along each branch; both reach it together
    const auto lead = [&](double period, point guess) {
        m.period = period;
        const recorder seen = watch(m, periodic_point(m, guess));
        return (seen.events[0].name == "take-off" ? seen.events[0] : seen.events[1]).time - 0.02;
    };
    const double early = lead(0.3471, {-1.588625, 1.754059}),
                 late = lead(0.3472, {-1.590201, 1.755130});
    EXPECT_NEAR(0.3471 - early * 1e-4 / (late - early), 0.3472, 6e-5);
}

TEST(openloop_hopper, negative_ground_force_matters_for_short_thrust_only) {
    for (const point& guess : {point{-2.448, -0.725}, point{-1.705, 0.931}, point{-0.677, 0.265}}) {
        const point x = periodic_point(long_thrust(), guess);
        EXPECT_GE(watch(long_thrust(), x).lowest_force, 0.0);
        machine by_force = long_thrust();
        by_force.guard = 1;
        EXPECT_NEAR(map(by_force, x).to.height, x.height,
                    1e-12);  // the same orbit under both guards
        EXPECT_NEAR(map(by_force, x).to.velocity, x.velocity, 1e-12);
    }
    const point x = periodic_point(short_thrust(), {-1.5, -0.6});
    EXPECT_NEAR(watch(short_thrust(), x).lowest_force, -0.32, 6e-3);
    for (double period : {0.12, 0.15, 0.2}) {
        machine by_force = short_thrust(period);
        by_force.guard = 1;
        const orbit late = run(by_force, 0, -0.001, 0.0, 4000);
        const double y = column(late, 0), v = column(late, 1);
        EXPECT_GT(std::abs(column(run(by_force, 0, y, v), 0) - y), 1e-5) << period;
        EXPECT_NEAR(column(run(by_force, 0, y, v, 2), 0), y, 1e-12) << period;
    }
}

TEST(openloop_hopper, never_hops_with_the_long_thrust_force_for_a_short_time) {
    machine m = long_thrust(0.2);
    m.on = 0.02;
    EXPECT_EQ(run(m, 0, 0.0, 0.0, 500).extras[1], print_real(0.0));
}

TEST(openloop_hopper, hop_settle_fire_fills_53_percent_of_the_wide_window) {
    const machine m = long_thrust();
    const int n = 30;
    int hop_settle_fire = 0;
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < n; ++k) {
            const double height = -4 + 6 * (i + 0.5) / n, velocity = -3 + 6 * (k + 0.5) / n;
            const orbit a = run(m, 0, height / 900, velocity / 30, 200);
            if (column(a, 0) * 900 > -1.5) ++hop_settle_fire;
        }
    }
    // sampling error of 900 cells 1.7 % (the page's own of 2000 is 1.1 %)
    EXPECT_NEAR(hop_settle_fire / (1.0 * n * n), 0.53, 0.04);
}

double lyapunov(const machine& m, point x, int periods) {
    const int transient = 300;
    double tangent[2] = {1.0, 0.3}, sum = 0.0;
    for (int i = 0; i < transient + periods; ++i) {
        const image f = map(m, x);
        const double a = f.j[0] * tangent[0] + f.j[1] * tangent[1];
        const double b = f.j[2] * tangent[0] + f.j[3] * tangent[1];
        const double growth = std::hypot(a, b);
        tangent[0] = a / growth;
        tangent[1] = b / growth;
        if (i >= transient) sum += std::log(growth);
        x = f.to;
    }
    return sum / periods / m.period;
}

TEST(openloop_hopper, knows_the_lyapunov_exponents_of_its_regimes) {
    const machine no_hop{.thrust = 2.5, .on = 0.02, .period = 0.15};
    EXPECT_NEAR(lyapunov(no_hop, {-1.0, 0.1}, 400), -6.0,
                0.1);  // -zeta w; rotation averages slowly
    machine fast{.thrust = 6.5, .on = 0.02, .period = 0.09};
    EXPECT_NEAR(lyapunov(fast, {-1.0, 0.1}, 3000), 5.0, 1.5);  // "about 5 per second"
    machine chaotic{.on = 0.2, .period = 0.24};
    double largest = -1e3;
    for (const point& x :
         {point{-0.5, 0.0}, point{-1.5, 1.0}, point{0.5, 0.5}, point{-2.5, -1.0}}) {
        largest = std::max(largest, lyapunov(chaotic, x, 1500));
    }
    EXPECT_NEAR(largest, 3.6, 0.8);  // beside a stable period-1 orbit
}

// ------------------------------------------------------------------------------- invariants

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

// --------------------------------------------------- independent simulation (no closed forms, no
// guards shared)

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

// ------------------------------------------------------------------- truth and derivatives

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
        const orbit truth = run(m, 0, x.height / 900, x.velocity / 30, 1, false, table.run_mp50);
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
            run_texts(table.run_mp50, m, 0, {print_real(x[0]), print_real(x[1])}, 1, true);
        for (std::size_t c = 0; c < 2; ++c) {
            std::vector<std::string> up{print_real(x[0]), print_real(x[1])}, down = up;
            up[c] = print_real(x[c] + step);
            down[c] = print_real(x[c] - step);
            const orbit a = run_texts(table.run_mp50, m, 0, up, 1),
                        b = run_texts(table.run_mp50, m, 0, down, 1);
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

// ------------------------------------------------------------------- hard cases (page, section 8)

TEST(openloop_hopper, unforced_graze_is_at_landing_speed_2_7249892) {
    machine m = short_thrust(5.0);  // no thrust after the landing
    m.thrust = 0.0;
    EXPECT_EQ(watch(m, 0.0, -2.7249891 / 30).word(), "-+");
    EXPECT_EQ(watch(m, 0.0, -2.7249893 / 30).word().substr(0, 2), "-T");
}

TEST(openloop_hopper, forced_graze_is_at_landing_speed_1_0899957) {
    machine m{.thrust = 0.6, .on = 4.0, .period = 5.0};
    EXPECT_EQ(watch(m, 0.0, -1.0899956 / 30).word(), "-+");
    EXPECT_EQ(watch(m, 0.0, -1.0899958 / 30).word().substr(0, 2), "TL");
    // square-root singularity: the Jacobian grows like distance^(-1/2)
    m.on = 0.22;
    m.period = 0.25;
    const auto size = [&](double d) { return std::abs(map(m, {0.0, -1.08999572 - d}).j[3]); };
    EXPECT_GT(size(1e-6), 5 * size(1e-4));
}

TEST(openloop_hopper, a_landing_on_a_clock_edge_comes_before_it) {
    machine m = long_thrust();
    m.on = 0.02;
    EXPECT_EQ(watch(m, 2e-4, 0.0).word().substr(0, 2), "L-");  // sqrt(2 y) = t_on
    machine whole = long_thrust();
    const recorder seen = watch(whole, 0.0, 0.13);  // 2 v = tau
    EXPECT_EQ(seen.word(), "-L+");
    const orbit a = run(whole, 0, 0.0, 0.13);
    EXPECT_NEAR(column(a, 0), 0.0, 1e-16);
    EXPECT_NEAR(column(a, 1), -0.13, 1e-16);
    const orbit landing =
        run(whole, 2, 0.0, 0.13);  // take-off at phase 0: back at phase 0, not at tau
    EXPECT_LT(column(landing, 0), whole.period);
}

TEST(openloop_hopper, chatter_is_followed_flight_by_flight) {
    machine m{.thrust = 1.55, .on = 0.2, .period = 0.21};
    EXPECT_EQ(run(m, 0, 0.0, 1e-4).extras[1], print_real(464.0));
    EXPECT_EQ(run(m, 0, 0.0, 1e-5).extras[1], print_real(4644.0));
    const recorder seen = watch(m, 0.0, 1e-5);
    double last = 0.0;
    for (const auto& e : seen.events) {
        if (e.name == "take-off") last = e.before[1];
    }
    EXPECT_NEAR(last / 1e-5, 0.597, 6e-4);
}

TEST(openloop_hopper, a_body_at_the_two_fold_is_held_until_the_thrust_ends) {
    machine m{.thrust = 1.55, .on = 0.2, .period = 0.21};
    EXPECT_EQ(watch(m, 0.0, 0.0).word(), "-+");
    const orbit held = run(m, 0, 0.0, 0.0), nearly = run(m, 0, 1e-18, 0.0);
    EXPECT_EQ(nearly.end, outcome::ok);
    EXPECT_LT(std::stod(nearly.extras[1]), 3.0);              // not ten million flights
    EXPECT_NEAR(column(nearly, 1), column(held, 1), 1.5e-9);  // sqrt(2 y)
    m.thrust = 1.0;                                           // equilibrium
    EXPECT_EQ(watch(m, 0.0, 0.0).word(), "-+");
    m.thrust = 0.9;
    EXPECT_EQ(watch(m, 0.0, 0.0).word(), "-+");
}

TEST(openloop_hopper, chatter_beyond_the_budget_is_reported) {
    machine m{.thrust = 1.55, .on = 0.2, .period = 0.21};
    const orbit a = run(m, 0, 0.0, 2e-7);
    EXPECT_EQ(a.end, outcome::budget);
    EXPECT_EQ(column(a, 1), 2e-7);  // the last section state is the start
}

TEST(openloop_hopper, tiny_thrust_time_tends_to_no_thrust) {
    for (double on : {1e-9, 1e-12}) {
        machine m = short_thrust();
        m.on = on;
        machine none = m;
        none.thrust = 0.0;
        const double impulse = m.thrust * on;  // change of velocity, at most
        EXPECT_NEAR(column(run(m, 0, -1e-3, 0.02), 1), column(run(none, 0, -1e-3, 0.02), 1),
                    10 * impulse + 1e-16);
    }
}

TEST(openloop_hopper, huge_thrust_for_a_tiny_time_keeps_its_digits) {
    const machine m{.thrust = 1e6, .on = 1e-8, .period = 0.2};
    const orbit got = run(m, 0, -1e-3, -0.01);
    const orbit truth = run(m, 0, -1e-3, -0.01, 1, false, table.run_mp50);
    EXPECT_NEAR(column(got, 0) * 900, std::stod(truth.columns[0]) * 900, 2e-13);
    EXPECT_NEAR(column(got, 1) * 30, std::stod(truth.columns[1]) * 30, 2e-13);
}

TEST(openloop_hopper, a_long_flight_passes_all_clock_edges) {
    const machine m = long_thrust();
    const recorder seen = watch(m, 0.5, 3.0, 30);
    int edges = 0;
    for (const auto& e : seen.events) {
        if (e.name == "landing") break;
        ++edges;
    }
    EXPECT_GT(edges, 20);
    const auto& landing = seen.events[static_cast<std::size_t>(edges)];
    EXPECT_NEAR(landing.time, 3 + std::sqrt(10.0), 2e-15 * 10);
    EXPECT_NEAR(landing.before[1], -std::sqrt(10.0), 1e-15 * 4);
}

TEST(openloop_hopper, lands_with_exactly_the_take_off_speed) {
    const machine m = long_thrust();
    const orbit landing = run(m, 1, 0.2, -0.09);
    const recorder seen = watch(m, 0.2, -0.09, 1, 1);
    for (const auto& e : seen.events) {
        if (e.name == "take-off") EXPECT_EQ(-e.before[1], column(landing, 1));
    }
}

TEST(openloop_hopper, critical_damping_is_smooth_from_both_sides) {
    machine m = long_thrust();
    const auto at = [&](double zeta) {
        m.zeta = zeta;
        return map(m, {0.5, 1.0}).to;
    };
    const point below = at(1 - 1e-10), critical = at(1), above = at(1 + 1e-10);
    EXPECT_NEAR(below.height, critical.height, 1e-9);
    EXPECT_NEAR((below.height + above.height) / 2, critical.height, 1e-15 * 8);
    EXPECT_NEAR((below.velocity + above.velocity) / 2, critical.velocity, 1e-15 * 8);
}

TEST(openloop_hopper, undamped_guards_are_the_same) {
    machine length = short_thrust(0.2), force = length;
    length.zeta = force.zeta = 0.0;
    force.guard = 1;
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> h(-2, 1), v(-2, 2);
    for (int i = 0; i < 50; ++i) {
        const point x{h(random), v(random)};
        const image a = map(length, x), b = map(force, x);
        double spread = 1;
        for (double j : a.j) spread = std::max(spread, std::abs(j));
        EXPECT_NEAR(a.to.height, b.to.height, 1e-13 * spread);
        EXPECT_NEAR(a.to.velocity, b.to.velocity, 1e-13 * spread);
    }
}

TEST(openloop_hopper, weak_attraction_is_not_mistaken_for_period_two) {
    const machine m{.on = 0.1, .period = 0.26};
    const point x = periodic_point(m, {-0.7176, 0.3013});
    EXPECT_NEAR(map(m, x).larger(), -0.98, 6e-4);
}

// ---------------------------------------------------------------------------- outcomes

TEST(openloop_hopper, sections_of_events_report_that_none_will_come) {
    const machine m{.thrust = 2.5, .on = 0.02, .period = 0.15};
    EXPECT_EQ(run(m, 1, 0.1, -0.05).end, outcome::no_hop);
    EXPECT_EQ(run(m, 2, 0.1, 0.02, 3).end, outcome::no_hop);
    EXPECT_LT(run(m, 2, 0.1, 0.02, 3).returns, 3u);
    EXPECT_EQ(run(m, 0, -0.001, 0.0, 3).end,
              outcome::ok);  // the stroboscopic section always returns
}

TEST(openloop_hopper, refuses_what_is_no_start) {
    const machine m = long_thrust();
    EXPECT_EQ(run(m, 1, 0.1, 0.05).end, outcome::invalid_start);
    EXPECT_EQ(run(m, 2, 0.1, -0.05).end, outcome::invalid_start);
    EXPECT_EQ(run(m, 1, 0.26, -0.05).end, outcome::invalid_start);
    EXPECT_EQ(run_texts(table.run_double, m, 0, {"nan", "0"}, 1).end, outcome::invalid_start);
    EXPECT_EQ(run(m, 0, 1e300, 1e300).end, outcome::not_finite);
    machine reversed = m;
    reversed.on = 0.3;
    EXPECT_EQ(run(reversed, 0, 0.0, 0.0).end, outcome::invalid_start);
    const double parameters[] = {30, 0.2, 1.55, 0.3, 0.26};
    EXPECT_FALSE(openloop_hopper::refusal(parameters, nullptr).empty());
}

TEST(openloop_hopper, counts_time_events_and_hops) {
    const orbit a = run(long_thrust(), 0, -0.00272, -0.0242, 1000);
    EXPECT_EQ(a.events, 4000u);
    EXPECT_EQ(std::stod(a.extras[1]), 1000.0);
    EXPECT_NEAR(std::stod(a.time), 260.0, 260 * 1e-13);
}

}  // namespace
}  // namespace hopscotch
