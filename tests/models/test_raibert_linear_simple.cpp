// Raibert's hopper on the simplified linear spring: Eq (17) in its valid form, the cut thrust
// beyond it, Theorem 2, and the numerically hard cases of the page.
#include "kernels/models/raibert_linear_simple.hpp"
#include "tests/models/orbit_runner.hpp"
#include "tests/models/trace_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hopscotch::testing_models {
namespace {

using model = raibert_linear_simple;

struct hopper {
    double w = 20.0, b = 0.2, tau = 1.0, delta = 0.01;
    orbit_answer from(const std::string& section, const std::string& start,
                      std::uint32_t returns = 1, arithmetic kind = arithmetic::plain,
                      bool derivative = false) const {
        return run_row<model>({section,
                               {start},
                               {{"frequency", print_real(w)},
                                {"damping", print_real(b)},
                                {"thrust", print_real(tau)},
                                {"thrust_time", print_real(delta)}},
                               {},
                               returns,
                               derivative},
                              kind);
    }
    double q() const { return std::sqrt(1.0 + b * b); }
    // corrected (24), (25); z is never small here
    double z() const { return 2.0 * w * b * delta; }
    double moved() const { return tau / (4.0 * w * w * b * b) * (z() - 1.0 + std::exp(-z())); }
    double speed() const { return tau / (2.0 * w * b) * (1.0 - std::exp(-z())); }
    double psi() const { return w * q() * moved() + b * speed() / q(); }
    double psi_rate() const { return speed() / q(); }
    double rho() const { return psi() / psi_rate(); }
    double bound() const { return q() * std::exp(-b * (0.5 * M_PI + std::atan(b))); }
    /// Phase of the fixed point: cos p + rho sin p = exp(-b (pi - p)), by bisection.
    double fixed_phase() const {
        double low = 1e-9;
        double high = M_PI - 1e-9;
        for (int i = 0; i < 200; ++i) {
            const double p = 0.5 * (low + high);
            (std::cos(p) + rho() * std::sin(p) > std::exp(-b * (M_PI - p)) ? low : high) = p;
        }
        return low;
    }
};
double state_of(const orbit_answer& answer) { return number(answer.columns[0]); }
double cut_of(const orbit_answer& answer) { return number(answer.extras[0]); }

TEST(RaibertLinearSimple, figure_2_has_the_reproduced_fixed_point) {
    const hopper h;
    EXPECT_NEAR(h.rho(), 0.305387, 1e-6);
    EXPECT_NEAR(h.bound(), 0.716034, 1e-6);
    EXPECT_NEAR(h.psi() * h.psi(), 8.2824e-6, 1e-10);
    for (const char* start : {"1e-5", "4e-5", "1e-3", "1"}) {
        EXPECT_NEAR(state_of(h.from("bottom", start, 60)), 4.76713e-5,
                    1e-10);  // the page's six digits
    }
    const auto answer = h.from("bottom", "4.76713e-5", 1, arithmetic::plain, true);
    EXPECT_NEAR(number(answer.derivative[0]), 0.140806, 2e-6);
    EXPECT_EQ(cut_of(answer), 0.0);
}

TEST(RaibertLinearSimple, fixed_point_obeys_its_equation_in_all_sections) {
    const hopper h{14.0, 0.13, 3.0, 0.02};
    const double p = h.fixed_phase();
    const double r = h.psi() + h.psi_rate() / std::tan(p);
    EXPECT_NEAR(state_of(h.from("phase", "1", 200)), p, 1e-13);
    EXPECT_NEAR(state_of(h.from("bottom", "0.001", 200)), r * r, 1e-13 * r);
    const double ratio = std::exp(-h.b * std::atan(1.0 / h.b));
    EXPECT_NEAR(state_of(h.from("touchdown", "0.3", 200)), r / ratio, 1e-13);
    // multiplier sin^2 p (cot p - b) (cot p + rho), the same in every coordinate
    const double cot = 1.0 / std::tan(p);
    const double want = std::sin(p) * std::sin(p) * (cot - h.b) * (cot + h.rho());
    for (const auto& [section, start] : std::vector<std::pair<std::string, double>>{
             {"phase", p}, {"bottom", r * r}, {"touchdown", r / ratio}}) {
        const auto answer = h.from(section, print_real(start), 1, arithmetic::plain, true);
        EXPECT_NEAR(number(answer.derivative[0]), want, 1e-12) << section;
    }
}

TEST(RaibertLinearSimple, theorem_2_every_start_of_valid_parameters_converges) {
    std::mt19937_64 bits(4);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    int tested = 0;
    while (tested < 60) {
        hopper h{5.0 + 25.0 * uniform(bits), 0.02 + 0.4 * uniform(bits), 0.5 + 20.0 * uniform(bits),
                 0.001 + 0.05 * uniform(bits)};
        if (h.rho() > h.bound()) continue;
        ++tested;
        const double p = h.fixed_phase();
        const double cot = 1.0 / std::tan(p);
        const double multiplier = std::sin(p) * std::sin(p) * (cot - h.b) * (cot + h.rho());
        EXPECT_GT(multiplier, -0.197);  // page, section 9
        EXPECT_LT(multiplier, 0.98);
        for (const char* start : {"0.01", "0.8", "1.57"}) {
            EXPECT_NEAR(state_of(h.from("phase", start, 2000)), p, 1e-11);
            EXPECT_LT(state_of(h.from("phase", start)), 0.5 * M_PI + 1e-12);
        }
    }
}

TEST(RaibertLinearSimple, hop_agrees_with_an_integration_of_the_equations) {
    // Runge-Kutta 4, 2e5 steps per second: error below 1e-11 for w = 10
    for (const double r : {0.05, 0.3, 0.6, 1.5}) {
        const hopper h{10.0, 0.2, 10.0, 0.1};
        const double friction = 2.0 * h.w * h.b;
        const double stiffness = h.w * h.w * (1.0 + h.b * h.b);
        double x = -r / (h.w * h.q());
        double v = 0.0;
        double t = 0.0;
        const double dt = 5e-6;
        const auto force = [&](double at, double position, double velocity) {
            const bool thrusts = at < h.delta - 0.5 * dt;
            return (thrusts ? h.tau : -stiffness * position) - friction * velocity;
        };
        double last_x = x;
        double last_v = v;
        while (x < 0.0) {
            last_x = x;
            last_v = v;
            const double k1 = force(t, x, v);
            const double k2 = force(t, x + 0.5 * dt * v, v + 0.5 * dt * k1);
            const double k3 = force(t, x + 0.5 * dt * v + 0.25 * dt * dt * k1, v + 0.5 * dt * k2);
            const double k4 = force(t, x + dt * v + 0.5 * dt * dt * k2, v + dt * k3);
            x += dt * v + dt * dt / 6.0 * (k1 + k2 + k3);
            v += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
            t += dt;
        }
        const double share = last_x / (last_x - x);
        const double liftoff = last_v + share * (v - last_v);  // next touchdown speed
        const double ratio = std::exp(-h.b * std::atan(1.0 / h.b));
        const auto answer = h.from("touchdown", print_real(r / ratio));
        EXPECT_NEAR(state_of(answer), liftoff, 1e-7) << r;
        const double stance = t - dt + share * dt + std::atan(1.0 / h.b) / h.w;
        EXPECT_NEAR(number(answer.time), stance + 2.0 * liftoff / 10.0, 1e-7) << r;
        EXPECT_EQ(cut_of(answer), r < h.psi() - h.b * h.psi_rate() ? 1.0 : 0.0) << r;
        EXPECT_EQ(answer.events, cut_of(answer) == 1.0 ? 3u : 4u);
    }
}

TEST(RaibertLinearSimple, slope_jumps_where_the_thrust_is_cut) {
    const hopper h{10.0, 0.2, 10.0, 0.1};
    const auto below = h.from("touchdown", "0.5898", 1, arithmetic::plain, true);
    const auto above = h.from("touchdown", "0.5900", 1, arithmetic::plain, true);
    EXPECT_EQ(cut_of(below), 1.0);
    EXPECT_EQ(cut_of(above), 0.0);
    // the page's three digits, and 1e-4 of distance times curvature
    EXPECT_NEAR(number(below.derivative[0]), 0.606, 1e-3);
    EXPECT_NEAR(number(above.derivative[0]), -0.298, 1e-3);
    EXPECT_NEAR(state_of(below), state_of(above), 1e-4);
}

TEST(RaibertLinearSimple, bottoms_below_psi_take_the_right_branch_of_the_arctangent) {
    const hopper h{10.0, 0.2, 10.0, 0.1};
    // between psi - b psi' and psi the phase theta is below pi/2
    const double r = h.psi() - 0.5 * h.b * h.psi_rate();
    const double left = h.psi() - r;
    const double theta = std::atan2(h.psi_rate(), left);
    ASSERT_LT(theta, 0.5 * M_PI);
    const double want = (left * left + h.psi_rate() * h.psi_rate()) * std::exp(-2.0 * h.b * theta);
    const auto answer = h.from("bottom", print_real(r * r));
    EXPECT_EQ(cut_of(answer), 0.0);
    EXPECT_NEAR(state_of(answer), want, 1e-14 * want);
}

TEST(RaibertLinearSimple, short_thrusts_keep_their_digits) {
    for (const double delta : {1e-9, 1e-6, 1e-3, 0.01, 0.3}) {
        const hopper h{20.0, 0.2, 50.0, delta};
        const double speed = 50.0 * delta;
        for (const double start : {0.01 * speed, 0.5 * speed, 3.0 * speed}) {
            const auto plain = h.from("touchdown", print_real(start));
            const auto truth = h.from("touchdown", print_real(start), 1, arithmetic::mp50);
            ASSERT_EQ(cut_of(plain), cut_of(truth));
            EXPECT_NEAR(state_of(plain) / state_of(truth), 1.0, 4e-15) << delta << " " << start;
            EXPECT_NEAR(number(plain.time) / number(truth.time), 1.0, 4e-15);
        }
    }
}

TEST(RaibertLinearSimple, without_thrust_the_energy_falls_by_exp_minus_2_pi_b) {
    const hopper h{20.0, 0.2, 1.0, 0.0};
    EXPECT_NEAR(state_of(h.from("bottom", "0.5")), 0.5 * std::exp(-0.4 * M_PI), 1e-15);
    EXPECT_EQ(cut_of(h.from("bottom", "0.5")), 0.0);
    EXPECT_EQ(h.from("bottom", "0.5").events, 3u);
    EXPECT_EQ(state_of(h.from("bottom", "0")), 0.0);
    EXPECT_EQ(h.from("phase", "1").end, outcome::invalid_start);  // no thrust, no phase
}

TEST(RaibertLinearSimple, tiny_impacts_leave_like_the_root_of_their_depth) {
    // touchdown at the spring's rest position: v' = sqrt(2 tau depth), P'(0) is infinite
    const hopper h;
    for (const double v : {1e-4, 1e-8, 1e-12}) {
        const auto plain = h.from("touchdown", print_real(v));
        const auto truth = h.from("touchdown", print_real(v), 1, arithmetic::mp50);
        EXPECT_EQ(plain.end, outcome::ok);
        EXPECT_EQ(cut_of(plain), 1.0);
        EXPECT_NEAR(state_of(plain) / state_of(truth), 1.0, 4e-15);
        const double depth = v * std::exp(-h.b * std::atan(1.0 / h.b)) / (h.w * h.q());
        EXPECT_NEAR(state_of(plain) / std::sqrt(2.0 * depth), 1.0, 20.0 * std::sqrt(depth));
    }
}

TEST(RaibertLinearSimple, agrees_with_50_digits) {
    std::mt19937_64 bits(8);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int i = 0; i < 150; ++i) {
        const hopper h{5.0 + 25.0 * uniform(bits), 0.02 + 0.5 * uniform(bits),
                       0.5 + 20.0 * uniform(bits), 0.1 * uniform(bits)};
        const std::string start = print_real(2.0 * uniform(bits));
        const auto plain = h.from("touchdown", start);
        const auto wide = h.from("touchdown", start, 1, arithmetic::wide);
        const auto truth = h.from("touchdown", start, 1, arithmetic::mp50);
        EXPECT_EQ(cut_of(plain), cut_of(truth));
        // psi - r cancels at most to psi', so a few ulp of (psi + r) / psi'
        const double scale = 1.0 + (number(start) + h.psi()) / h.psi_rate();
        EXPECT_NEAR(state_of(plain) / state_of(truth), 1.0, 1e-15 * (4.0 + scale));
        const real50 error =
            parse_real<real50>(wide.columns[0]) / parse_real<real50>(truth.columns[0]) -
            real50(1.0);
        EXPECT_LT(to_double(abs(error)), 1e-28 * scale);
    }
}

TEST(RaibertLinearSimple, derivatives_agree_with_50_digit_differences) {
    const real50 h(0x1p-70);
    const hopper hop{10.0, 0.2, 10.0, 0.1};
    for (const auto& [section, start] : std::vector<std::pair<std::string, double>>{
             {"bottom", 0.03125}, {"bottom", 1.25}, {"touchdown", 0.25}, {"phase", 1.25}}) {
        const auto exact = hop.from(section, print_real(start), 2, arithmetic::mp50, true);
        const auto plain = hop.from(section, print_real(start), 2, arithmetic::plain, true);
        const auto high = hop.from(section, to_string(real50(start) + h, 64), 2, arithmetic::mp50);
        const auto low = hop.from(section, to_string(real50(start) - h, 64), 2, arithmetic::mp50);
        const double slope = to_double(
            (parse_real<real50>(high.columns[0]) - parse_real<real50>(low.columns[0])) / (h + h));
        EXPECT_NEAR(number(exact.derivative[0]), slope, 1e-14 * (1.0 + std::abs(slope)))
            << section << start;
        EXPECT_NEAR(number(plain.derivative[0]), slope, 1e-12 * (1.0 + std::abs(slope)))
            << section << start;
    }
}

TEST(RaibertLinearSimple, certificate_labels_valid_parameters_only) {
    const auto label = [](const hopper& h, const std::string& energy) {
        const std::vector<std::string> parameters{print_real(h.w), print_real(h.b),
                                                  print_real(h.tau), print_real(h.delta), "10"};
        const std::vector<std::string> columns{energy};
        orbit_row row{.variant = 1, .columns = columns, .parameters = parameters, .returns = 100};
        row.decided_by = decision::certificate;
        row.died_label = 1;
        return orbits_of<model>().run_double(row).label;
    };
    EXPECT_EQ(label({}, "0.001"), 2);
    EXPECT_EQ(label({}, "1e-7"), 2);  // enters the trap after a hop or two
    EXPECT_EQ(label({10.0, 0.2, 10.0, 0.3}, "0.1"), 0);
    EXPECT_EQ(label({20.0, 0.2, 1.0, 0.0}, "0.1"), 1);
    const double fig_2[] = {20.0, 0.2, 1.0, 0.01, 10.0};
    const double outside[] = {20.0, 0.2, 1.0, 0.2, 10.0};
    EXPECT_TRUE(model::certificate_covers({fig_2, fig_2, nullptr}));
    EXPECT_FALSE(model::certificate_covers({fig_2, outside, nullptr}));
}

TEST(RaibertLinearSimple, traced_phases_join_without_a_gap) {
    for (const char* delta : {"0", "0.01", "0.2"}) {
        for (const char* section : {"bottom", "touchdown"}) {
            trace_row<model>({section, {"0.0625"}, {{"thrust_time", delta}}, {}, 3}, 1e-13);
        }
    }
}

TEST(RaibertLinearSimple, starts_outside_the_domain_are_invalid) {
    const hopper h;
    EXPECT_EQ(h.from("bottom", "-1").end, outcome::invalid_start);
    EXPECT_EQ(h.from("touchdown", "-1").end, outcome::invalid_start);
    EXPECT_EQ(h.from("phase", "0").end, outcome::invalid_start);
    EXPECT_EQ(h.from("phase", "3.1").end,
              outcome::invalid_start);  // beyond the deepest phase: r < 0
    EXPECT_EQ(h.from("bottom", "nan").end, outcome::invalid_start);
}

}  // namespace
}  // namespace hopscotch::testing_models
