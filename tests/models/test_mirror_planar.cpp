// The planar mirror-law juggler against its page (models/mirror_juggler.md, section 4): closed-form
// identities, hard cases, a dense scan for contacts, and 50-digit truth.
#include "analysis/orbit/instantiate.hpp"
#include "kernels/models/mirror_planar.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace hopscotch {
namespace {

/// Denormal numbers included, which std::stod refuses.
double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

const orbit_functions& table = orbit_table<mirror_planar>;
using runner = orbit_answer (*)(const orbit_row&);
enum law { original, solvable, level };

/// Parameters as decimals, so that 1/7 and its kin can be given to all digits.
struct juggler {
    int law = solvable;
    int energy = 0;
    double alpha = 0.75, gravity = 9.81;
    std::string kappa0 = print_real(real50(1.0) / real50(7.0));
    double kappa1 = 0.05824959953, target_x = 0.5, target_height = 0.5;
    double kappa10 = 0.1, kappa11 = 0.08, shoulder = 0.0, bar = 100.0, floor = -100.0;

    std::vector<std::string> texts() const {
        return {print_real(alpha),   print_real(gravity),  kappa0,
                print_real(kappa1),  print_real(target_x), print_real(target_height),
                print_real(kappa10), print_real(kappa11),  print_real(shoulder),
                print_real(bar),     print_real(floor)};
    }
    double speed() const { return std::sqrt(2 * gravity * target_height); }  // V
    double flight() const { return speed() / gravity; }                      // T
    double gain(double x, double z, double v) const {
        (void)x;
        const double missing = gravity * (target_height - z) - (energy ? v * v / 2 : 0.0);
        return number(kappa0) + kappa1 * missing;
    }
};

template <class Call>
auto with_row(const juggler& j, const std::vector<std::string>& columns, std::uint32_t returns,
              bool derivative, const Call& call) {
    const std::vector<std::string> parameters = j.texts();
    const int options[] = {j.law, j.energy};
    orbit_row row;
    row.options = options;
    row.variant = j.law;
    row.columns = columns;
    row.parameters = parameters;
    row.returns = returns;
    row.derivative = derivative;
    return call(row);
}
using state = std::array<double, 3>;
orbit_answer run(const juggler& j, const state& x, std::uint32_t returns = 1,
                 bool derivative = false, runner how = table.run_double) {
    return with_row(j, {print_real(x[0]), print_real(x[1]), print_real(x[2])}, returns, derivative,
                    how);
}
state end_of(const orbit_answer& a) {
    return {number(a.columns[0]), number(a.columns[1]), number(a.columns[2])};
}
using matrix = std::array<std::array<double, 3>, 3>;
matrix jacobian(const juggler& j, const state& x) {
    const orbit_answer a = run(j, x, 1, true);
    matrix m{};
    for (std::size_t i = 0; i < 9; ++i) m[i / 3][i % 3] = number(a.derivative[i]);
    return m;
}

struct recorder final : orbit_observer {
    std::vector<std::array<double, 4>> before, after;
    std::vector<double> times;
    void phase(const char*, double, double, const sampler&) override {}
    void event(const char*, double time, const char*, const char*, const double* b, const double* a,
               double) override {
        times.push_back(time);
        before.push_back({b[0], b[1], b[2], b[3]});
        after.push_back({a[0], a[1], a[2], a[3]});
    }
};
recorder watch(const juggler& j, const state& x) {
    recorder seen;
    with_row(j, {print_real(x[0]), print_real(x[1]), print_real(x[2])}, 1, false,
             [&](const orbit_row& row) { return table.trace(row, seen); });
    return seen;
}

/// The scene of the page's examples: B = 0.5, kappa11 = 0.5 bx*/V, kappa10 = 0.4 kappa11/T.
juggler example(int law = solvable) {
    juggler j{.law = law};
    j.kappa1 = 0.5 / (1.75 * 9.81 * 0.5);
    j.kappa11 = 0.5 * 0.5 / j.speed();
    j.kappa10 = 0.4 * j.kappa11 / j.flight();
    return j;
}

// ------------------------------------------------------------------------- the page's numbers

TEST(mirror_planar, gives_the_illustrative_return) {
    const state end = end_of(run(example(), {0.55, 0.6, -0.1}));
    EXPECT_NEAR(end[0], 0.494566150124, 6e-13);  // half of the last printed digit
    EXPECT_NEAR(end[1], 0.485733988340, 6e-13);
    EXPECT_NEAR(end[2], -0.064570030411, 6e-13);
}

TEST(mirror_planar, carries_the_line_map_on_the_invariant_slice) {
    for (int law : {original, solvable, level}) {
        for (const char* height : {"0.3", "0.5", "0.72"}) {
            const juggler j = example(law);
            const orbit_answer a = with_row(j, {"0.5", height, "0"}, 1, false, table.run_mp50);
            const real50 z = parse_real<real50>(height);
            const real50 gain = parse_real<real50>(j.kappa0) +
                                parse_real<real50>(j.texts()[3]) *
                                    parse_real<real50>(j.texts()[1]) * (real50(0.5) - z);
            const real50 m = real50(0.75) + real50(1.75) * gain;
            EXPECT_LT(abs(parse_real<real50>(a.columns[0]) - real50(0.5)), real50(1e-48));
            EXPECT_LT(abs(parse_real<real50>(a.columns[2])), real50(1e-48));
            // 50 printed digits; the kappa0 text is 50 digits too
            EXPECT_LT(abs(parse_real<real50>(a.columns[1]) - m * m * z), real50(1e-48)) << law;
        }
    }
}

TEST(mirror_planar, has_the_block_triangular_jacobian_of_the_table) {
    for (int law : {original, solvable, level}) {
        juggler j = example(law);
        j.kappa10 = 0.07;
        j.kappa11 = 0.06;
        const matrix m = jacobian(j, {0.5, 0.5, 0.0});
        const double T = j.flight(), V = j.speed();
        const double G = law == solvable ? 2 * V / j.target_x
                         : law == level  ? 1.75 * V / j.target_x
                                         : 1.75 * V;
        const double k11 = law == original ? j.kappa11 + T * j.kappa10 : j.kappa11;
        EXPECT_NEAR(m[1][1], 1 - 2 * 0.5, 2e-14);
        EXPECT_NEAR(m[0][1], 0.0, 1e-14);  // x and v do not see z
        EXPECT_NEAR(m[2][1], 0.0, 1e-14);
        EXPECT_NEAR(m[0][0] + m[2][2], 2 - T * G * j.kappa10 - G * k11, 3e-14);
        EXPECT_NEAR(m[0][0] * m[2][2] - m[0][2] * m[2][0], 1 + T * G * j.kappa10 - G * k11, 3e-14);
        if (law == original) {
            EXPECT_GT(std::abs(m[1][2]), 1e-3);  // v drives z at first order
        } else {
            EXPECT_NEAR(m[1][0], 0.0, 1e-14);
            EXPECT_NEAR(m[1][2], 0.0, 1e-14);
        }
    }
}

TEST(mirror_planar, is_stable_inside_the_closed_form_triangle_and_not_outside) {
    const state start{0.502, 0.503, 0.004};
    const auto settles = [&](juggler j) {
        const orbit_answer a = run(j, start, 3000);
        if (a.end != outcome::ok) return false;
        const state x = end_of(a);
        return std::abs(x[0] - 0.5) + std::abs(x[1] - 0.5) + std::abs(x[2]) < 1e-6;
    };
    for (int law : {original, solvable, level}) {
        juggler j = example(law);
        const double T = j.flight(), V = j.speed();
        const double G = law == solvable ? 2 * V / 0.5 : law == level ? 1.75 * V / 0.5 : 1.75 * V;
        const auto set = [&](double position, double velocity,
                             double B) {  // T k10' and k11' in 2/G
            j.kappa10 = position * 2 / G / T;
            j.kappa11 = velocity * 2 / G - (law == original ? position * 2 / G : 0.0);
            j.kappa1 = B / (1.75 * 9.81 * 0.5);
            return j;
        };
        EXPECT_TRUE(settles(set(0.3, 0.6, 0.5))) << law;
        EXPECT_TRUE(settles(set(0.05, 0.97, 0.95))) << law;
        EXPECT_FALSE(settles(set(0.3, 1.04, 0.5))) << law;   // k11' > 2/G
        EXPECT_FALSE(settles(set(0.5, 0.45, 0.5))) << law;   // T k10' > k11'
        EXPECT_FALSE(settles(set(-0.05, 0.6, 0.5))) << law;  // k10' < 0
        EXPECT_FALSE(settles(set(0.3, 0.6, 1.05))) << law;   // B > 1
    }
}

TEST(mirror_planar, settles_in_15_to_55_cycles) {
    for (int law : {original, solvable, level}) {
        const juggler j = example(law);
        state x{0.55, 0.6, -0.1};
        int cycles = 0;
        while (std::abs(x[0] - 0.5) + std::abs(x[1] - 0.5) + std::abs(x[2]) > 1e-9 &&
               cycles < 1000) {
            x = end_of(run(j, x));
            ++cycles;
        }
        EXPECT_GE(cycles, 15) << law;
        EXPECT_LE(cycles, 100) << law;  // "typical" on the page
    }
}

TEST(mirror_planar, has_the_transverse_jacobian_and_exponents_of_the_page) {
    const auto larger_exponent = [](double B) {
        juggler j;
        j.kappa1 = B / (1.75 * 9.81 * 0.5);
        j.kappa11 = 0.5 * 0.5 / j.speed();
        j.kappa10 = 0.3 * j.kappa11 / j.flight();
        double z = B < 1 ? 0.5 : 0.43, sum = 0, a = 1, b = 0.3;
        const int transient = 500, cycles = 3000;
        for (int i = 0; i < transient + cycles; ++i) {
            const matrix m = jacobian(j, {0.5, z, 0.0});
            const double gain = j.gain(0.5, z, 0), mn = 0.75 + 1.75 * gain;
            const double T = std::sqrt(2 * z / 9.81), c = (1 + mn) * 9.81 * T, ta = mn * T;
            if (i < 20) {
                EXPECT_NEAR(m[0][0], 1 - ta * c * j.kappa10 / 0.5, 1e-13);
                EXPECT_NEAR(m[0][2], T + ta - ta * c * j.kappa11 / 0.5, 1e-13);
                EXPECT_NEAR(m[2][0], -c * j.kappa10 / 0.5, 1e-13);
                EXPECT_NEAR(m[2][2], 1 - c * j.kappa11 / 0.5, 1e-13);
            }
            const double p = m[0][0] * a + m[0][2] * b, q = m[2][0] * a + m[2][2] * b;
            const double growth = std::hypot(p, q);
            a = p / growth, b = q / growth;
            if (i >= transient) sum += std::log(growth);
            z = end_of(run(j, {0.5, z, 0.0}))[1];
        }
        return sum / cycles;
    };
    EXPECT_NEAR(larger_exponent(0.7), -0.602, 6e-4);
    EXPECT_NEAR(larger_exponent(1.38), -0.554, 2e-3);
    EXPECT_NEAR(larger_exponent(1.53), -0.486, 1e-2);  // chaotic: statistical error of 3000 cycles
}

TEST(mirror_planar, contacts_lie_where_equations_15_and_16_put_them) {
    const state x{0.55, 0.6, -0.1};
    const juggler j15 = example(solvable), j16 = example(level);
    const double regulation = j15.kappa10 * 0.05 + j15.kappa11 * -0.1;
    const auto contact15 = watch(j15, x).before.at(0), contact16 = watch(j16, x).before.at(0);
    EXPECT_NEAR(contact15[1] * 0.55, regulation * contact15[0], 1e-16);  // (15): (1 + K) cancels
    const double gain = j16.gain(x[0], x[1], x[2]);
    EXPECT_NEAR(contact16[1], regulation / (1 + gain), 1e-15);  // (16) with k = -K
}

TEST(mirror_planar, reflects_with_restitution_relative_to_the_bar) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> x(0.3, 0.8), z(0.3, 0.8), v(-0.3, 0.3);
    for (int i = 0; i < 60; ++i) {
        juggler j = example(i % 3);
        j.energy = (i / 3) % 2;
        const state start{x(random), z(random), v(random)};
        const recorder seen = watch(j, start);
        ASSERT_EQ(seen.before.size(), 1u);
        const auto &b = seen.before[0], &a = seen.after[0];
        const double gain = j.gain(start[0], start[1], start[2]);
        const double square = b[0] * b[0] + b[1] * b[1], rho = std::sqrt(square);
        const double theta_rate = (b[0] * b[3] - b[1] * b[2]) / square;
        const double bar_rate =
            -gain * theta_rate + (j.law == original ? j.kappa10 * start[2] : 0.0);
        const double nx = -b[1] / rho, nz = b[0] / rho;
        const double before = b[2] * nx + b[3] * nz - rho * bar_rate;
        const double after = a[2] * nx + a[3] * nz - rho * bar_rate;
        EXPECT_LT(before, 0.0);
        EXPECT_NEAR(after, -0.75 * before, 1e-13);
        EXPECT_NEAR(a[2] * nz - a[3] * nx, b[2] * nz - b[3] * nx, 1e-13);  // along the bar
    }
}

// ------------------------------------------------------------------------------- hard cases

TEST(mirror_planar, original_law_takes_the_first_of_two_roots) {
    juggler j{.law = original, .kappa0 = "0.487"};
    j.kappa10 = -2.3533;
    j.kappa11 = -0.0367;
    const orbit_answer a = run(j, {0.1287, 0.2363, 1.8285});
    EXPECT_EQ(a.end, outcome::downward);              // the impact leaves the ball going down
    EXPECT_NEAR(number(a.extras[0]), 0.30262, 6e-6);  // and not 0.4212
}

TEST(mirror_planar, original_law_finds_the_first_contact_of_a_dense_scan) {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> u(0, 1);
    int contacts = 0, misses = 0;
    for (int i = 0; i < 400; ++i) {
        juggler j{.law = original};
        j.kappa0 = print_real(-0.5 + u(random));
        j.kappa10 = 8 * (u(random) - 0.5);
        j.kappa11 = u(random) - 0.5;
        j.shoulder = 0.02;
        j.floor = -1.0;
        const state x{0.1 + u(random), 0.1 + u(random), 4 * (u(random) - 0.5)};
        const double gain = 1 + j.gain(x[0], x[1], x[2]);
        const auto F = [&](double t) {
            return gain * std::atan2(x[1] - j.gravity * t * t / 2, x[0] + x[2] * t) -
                   (j.kappa10 * (x[0] + x[2] * t - 0.5) + j.kappa11 * x[2]);
        };
        if (gain <= 0 || F(0) <= 0) continue;
        const double fall = std::sqrt(2 * (x[1] + 1.0) / j.gravity);
        const double pass = x[2] < 0 ? (x[0] - 0.02) / -x[2] : 1e9;
        const double end = std::min(fall, pass);
        double root = -1;
        const int n = 20000;
        for (int k = 1; k <= n && root < 0; ++k) {
            if (F(end * k / n) > 0) continue;
            double low = end * (k - 1) / n, high = end * k / n;
            for (int b = 0; b < 50; ++b) (F((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
            root = high;
        }
        const orbit_answer a = run(j, x);
        if (root < 0) {
            ++misses;
            EXPECT_EQ(a.end, pass <= fall ? outcome::over_shoulder : outcome::fell) << i;
        } else if (a.end == outcome::ok || a.end == outcome::downward) {
            ++contacts;
            EXPECT_NEAR(number(a.extras[0]), root, 1e-10) << i;
        } else {
            EXPECT_NE(a.end, outcome::fell) << i;
        }
    }
    EXPECT_GT(contacts, 60);
    EXPECT_GT(misses, 20);
}

TEST(mirror_planar, keeps_its_digits_where_the_plain_root_formula_cancels) {
    for (double v : {30.0, -30.0}) {  // s v large of both signs
        juggler j = example();
        j.kappa10 = 0.8;
        j.kappa11 = 0.0;
        const state x{40.0, 33.0, v};
        const orbit_answer got = run(j, x), truth = run(j, x, 1, false, table.run_mp50);
        ASSERT_EQ(got.end, truth.end);
        for (std::size_t c = 0; c < 3; ++c) {
            const double exact = number(truth.columns[c]);
            EXPECT_NEAR(number(got.columns[c]), exact, 1e-12 * (1 + std::abs(exact)));
        }
    }
}

TEST(mirror_planar, basin_boundary_of_low_apexes_is_discontinuous) {
    // z - L = 1e-14: contact at once where the ray falls away, after a flight where it rises
    juggler j = example();
    j.kappa10 = 0.2;
    j.kappa11 = 0.0;
    const auto start = [&](double v) { return state{1.0, 0.1 + 1e-14, v}; };
    EXPECT_LT(number(run(j, start(0.5)).extras[0]), 1e-12);
    EXPECT_NEAR(number(run(j, start(-0.5)).extras[0]), 2 * 0.1 * 0.5 / 9.81, 1e-9);
    EXPECT_EQ(run(j, {1.0, 0.1 - 1e-14, 0.5}).end, outcome::apex_below);
}

TEST(mirror_planar, almost_pacing_the_ball_is_legal_and_pacing_is_not) {
    for (int law : {original, solvable, level}) {
        juggler j = example(law);
        j.kappa1 = 0.0;
        j.kappa10 = j.kappa11 = 0.0;
        j.kappa0 = "-0.999999999999";
        EXPECT_EQ(run(j, {0.5, 0.5, 0.0}).end, outcome::downward) << law;  // hardly an impact
        j.kappa0 = "-1";
        EXPECT_EQ(run(j, {0.5, 0.5, 0.0}).end, outcome::invalid_gain) << law;
    }
}

TEST(mirror_planar, survives_states_next_to_the_shoulder) {
    juggler j = example();
    const orbit_answer a = run(j, {1e-8, 0.5, 0.0}),
                       truth = run(j, {1e-8, 0.5, 0.0}, 1, false, table.run_mp50);
    EXPECT_EQ(a.end, truth.end);
    for (std::size_t c = 0; c < 3; ++c) {
        const double exact = number(truth.columns[c]);
        EXPECT_NEAR(number(a.columns[c]), exact, 1e-12 * (1 + std::abs(exact)));
    }
}

// --------------------------------------------------------------------------------- outcomes

TEST(mirror_planar, reaches_every_outcome_in_the_order_of_the_page) {
    juggler j = example();
    j.shoulder = 0.1;
    j.floor = -0.5;
    EXPECT_EQ(run(j, {0.5, 0.5, 0.0}).end, outcome::ok);
    EXPECT_EQ(run(j, {0.1, 0.5, 0.0}).end, outcome::over_shoulder);    // starts there
    EXPECT_EQ(run(j, {0.15, 0.5, -2.0}).end, outcome::over_shoulder);  // passes it before contact
    juggler low = j;
    low.kappa0 = "-3";
    EXPECT_EQ(run(low, {0.5, 0.5, 0.0}).end, outcome::invalid_gain);
    EXPECT_EQ(run(low, {0.1, 0.5, 0.0}).end, outcome::over_shoulder);  // before the gain
    EXPECT_EQ(run(j, {0.5, -0.1, 0.0}).end, outcome::apex_below);
    juggler steep = j;
    steep.kappa10 = -8.0;  // the ray falls faster than the ball may
    EXPECT_EQ(run(steep, {1.5, 0.5, 1.0}).end, outcome::fell);
    juggler shorter = j;
    shorter.bar = 0.4;
    EXPECT_EQ(run(shorter, {0.5, 0.5, 0.0}).end, outcome::off_bar);
    juggler soft = j;
    soft.kappa0 = "-0.6";  // m = 0.75 - 1.05 < 0
    EXPECT_EQ(run(soft, {0.5, 0.5, 0.0}).end, outcome::downward);
    EXPECT_EQ(with_row(j, {"nan", "0.5", "0"}, 1, false, table.run_double).end,
              outcome::invalid_start);
}

TEST(mirror_planar, an_apex_behind_the_shoulder_ends_the_orbit_and_is_reported) {
    juggler j = example();
    j.shoulder = 0.1;
    j.target_x = 0.12;
    j.kappa10 = 0.8;  // throws the ball back over the shoulder
    j.kappa11 = 0.0;
    const orbit_answer a = run(j, {0.3, 0.5, 0.0});
    EXPECT_EQ(a.end, outcome::over_shoulder);
    EXPECT_EQ(a.returns, 0u);
    EXPECT_LE(number(a.columns[0]), 0.1);
    EXPECT_LT(number(a.columns[2]), -1.0);
    const double parameters[] = {0.75, 9.81, 0.1, 0, 0.5, 0.5, 0, 0, 2.0, 1.0, -1.0};
    EXPECT_FALSE(mirror_planar::refusal(parameters, nullptr).empty());
}

TEST(mirror_planar, total_energy_counts_horizontal_motion) {
    juggler total = example();
    total.energy = 1;
    EXPECT_EQ(run(total, {0.5, 0.6, 0.0}).columns, run(example(), {0.5, 0.6, 0.0}).columns);
    EXPECT_NE(run(total, {0.5, 0.6, 0.2}).columns, run(example(), {0.5, 0.6, 0.2}).columns);
    // the same as vertical energy with its set point lowered by v^2 / 2 in the gain alone
    juggler lowered = example();
    lowered.kappa0 = print_real(1.0 / 7.0 - lowered.kappa1 * 0.02);
    const state a = end_of(run(total, {0.55, 0.6, 0.2})),
                b = end_of(run(lowered, {0.55, 0.6, 0.2}));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 2e-15);
}

// ------------------------------------------------------------------------ truth and derivatives

TEST(mirror_planar, one_return_is_exact_to_a_few_ulp_against_50_digits) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> u(0, 1);
    int compared = 0;
    for (int i = 0; i < 300; ++i) {
        juggler j = example(i % 3);
        j.energy = (i / 3) % 2;
        j.kappa10 *= 4 * u(random);
        j.kappa11 *= 2 * u(random);
        const state x{0.2 + u(random), 0.2 + u(random), 2 * u(random) - 1};
        const orbit_answer got = run(j, x), truth = run(j, x, 1, false, table.run_mp50);
        ASSERT_EQ(got.end, truth.end) << i;
        if (got.end != outcome::ok) continue;
        ++compared;
        const matrix m = jacobian(j, x);
        for (std::size_t c = 0; c < 3; ++c) {
            double spread = 1;
            for (double d : m[c]) spread += std::abs(d);
            EXPECT_NEAR(number(got.columns[c]), number(truth.columns[c]), 2e-15 * spread) << i;
        }
    }
    EXPECT_GT(compared, 150);
}

TEST(mirror_planar, derivatives_match_50_digit_central_differences) {
    std::mt19937_64 random(6);
    std::uniform_real_distribution<double> u(0, 1);
    for (int i = 0; i < 24; ++i) {
        juggler j = example(i % 3);
        j.energy = (i / 3) % 2;
        const state x{0.4 + 0.3 * u(random), 0.4 + 0.3 * u(random), 0.4 * u(random) - 0.2};
        const std::vector<std::string> at{print_real(x[0]), print_real(x[1]), print_real(x[2])};
        const orbit_answer got = with_row(j, at, 1, true, table.run_mp50);
        ASSERT_EQ(got.end, outcome::ok);
        const real50 step("1e-18");
        for (std::size_t c = 0; c < 3; ++c) {
            std::vector<std::string> up = at, down = at;
            up[c] = print_real(real50(x[c]) + step);
            down[c] = print_real(real50(x[c]) - step);
            const orbit_answer a = with_row(j, up, 1, false, table.run_mp50);
            const orbit_answer b = with_row(j, down, 1, false, table.run_mp50);
            for (std::size_t r = 0; r < 3; ++r) {
                const double slope = to_double(
                    (parse_real<real50>(a.columns[r]) - parse_real<real50>(b.columns[r])) /
                    (step + step));
                EXPECT_NEAR(number(got.derivative[3 * r + c]), slope,
                            1e-14 * (1 + std::abs(slope)));
            }
        }
    }
}

}  // namespace
}  // namespace hopscotch
