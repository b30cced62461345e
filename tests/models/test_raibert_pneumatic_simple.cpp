// The Ricker map of Koditschek and Buehler's simplified hopper: published figures, Theorem 1, the
// cascade, and the numerically hard cases of its page.
#include "kernels/models/raibert_pneumatic_simple.hpp"
#include "tests/models/orbit_runner.hpp"
#include "tests/models/trace_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hopscotch::testing_models {
namespace {

using model = raibert_pneumatic_simple;
using settings = std::vector<std::pair<std::string, std::string>>;

orbit_answer hop(const std::string& section, const std::string& start, const settings& set,
                 std::uint32_t returns = 1, arithmetic kind = arithmetic::plain,
                 bool derivative = false) {
    return run_row<model>({section, {start}, set, {}, returns, derivative}, kind);
}
double state_of(const orbit_answer& answer) { return number(answer.columns[0]); }

const settings figure_11{{"liftoff_height", "0.5"}, {"thrust", "41.86"}, {"stiffness", "5.81"}};
const settings figure_13{{"liftoff_height", "0.5"}, {"thrust", "41.86"}, {"stiffness", "2.33"}};
// 2-cycle of Fig. 13 to the page's digits
constexpr double low_energy = 1.102138;
constexpr double high_energy = 3.288492;

/// Label that the model's certificate gives an orbit with this gain.
int label_at(const std::string& gain, const std::string& energy = "1.5") {
    std::vector<std::string> parameters =
        all_parameters<model>({"energy", {energy}, {{"gain", gain}}, {}});
    const std::vector<std::string> columns{energy};
    orbit_row row{.section = 1, .variant = 1, .columns = columns, .parameters = parameters};
    row.decided_by = decision::certificate;
    row.died_label = 1;
    return orbits_of<model>().run_double(row).label;
}

TEST(RaibertPneumaticSimple, figure_11_settles_on_the_published_cycle) {
    for (const char* start : {"0.1", "0.2", "0.49"}) {
        // multiplier -0.28: 60 hops shrink any distance below rounding
        EXPECT_NEAR(state_of(hop("bottom", start, figure_11, 60)), 0.138796, 1e-6);
    }
    const double speed = state_of(hop("touchdown", "2.0", figure_11, 60));
    EXPECT_NEAR(0.5 + speed * speed / 20.0, 1.24461, 1e-5);  // apex, to the page's digits
    const auto answer = hop("bottom", "0.138796", figure_11, 1, arithmetic::mp50, true);
    EXPECT_NEAR(number(answer.derivative[0]), -0.2816, 1e-4);
}

TEST(RaibertPneumaticSimple, at_the_fixed_point_without_leg_mass_the_spring_force_is_the_thrust) {
    const double bottom = state_of(hop("bottom", "0.2", figure_11, 80));
    EXPECT_NEAR(5.81 / bottom, 41.86, 1e-12 * 41.86);  // contracted to rounding
}

TEST(RaibertPneumaticSimple, figure_13_limps_between_two_bottoms) {
    const settings& set = figure_13;
    // multiplier about -0.23 per cycle; from the figure's own start
    const double one = state_of(hop("bottom", "0.02", set, 400));
    const double other = state_of(hop("bottom", "0.02", set, 401));
    EXPECT_NEAR(std::max(one, other), 0.16608, 1e-5);
    EXPECT_NEAR(std::min(one, other), 0.018655, 1e-6);
    EXPECT_NEAR(state_of(hop("energy", std::to_string(low_energy), set)), high_energy, 3e-6);
    const double slow = state_of(hop("touchdown", "2.0", set, 400));
    const double fast = state_of(hop("touchdown", "2.0", set, 401));
    EXPECT_NEAR(0.5 + std::min(slow, fast) * std::min(slow, fast) / 20.0, 0.75680, 1e-5);
    EXPECT_NEAR(0.5 + std::max(slow, fast) * std::max(slow, fast) / 20.0, 1.26622, 1e-5);
}

TEST(RaibertPneumaticSimple, figures_3_to_5_have_their_fixed_point_at_one_sixth) {
    const settings set{{"liftoff_height", "1"}, {"stiffness", "1"}, {"thrust", "6"}};
    const double sixth = 1.0 / 6.0;
    EXPECT_NEAR(state_of(hop("bottom", "0.16666666666666666", set)), sixth, 1e-16);
    const auto energy = hop("energy", "1.791759469228055", set, 1, arithmetic::plain, true);
    EXPECT_NEAR(state_of(energy), std::log(6.0), 1e-15);
    EXPECT_NEAR(number(energy.derivative[0]), 1.0 - std::log(6.0), 1e-14);
}

TEST(RaibertPneumaticSimple, gain_replaces_thrust_and_leg_mass) {
    const settings by_thrust{{"stiffness", "2"}, {"thrust", "33.75"}, {"leg_mass_ratio", "0.5"}};
    const settings by_gain{{"stiffness", "2"}, {"gain", "3.75"}, {"leg_mass_ratio", "0.5"}};
    const auto a = hop("energy", "1.25", by_thrust, 3);
    const auto b = hop("energy", "1.25", by_gain, 3);
    EXPECT_EQ(a.columns, b.columns);
    EXPECT_EQ(a.time, b.time);
}

TEST(RaibertPneumaticSimple, the_three_sections_show_the_same_orbit) {
    const settings set{{"gain", "6.5"}, {"stiffness", "3"}, {"liftoff_height", "0.75"}};
    const double energy = state_of(hop("energy", "0.875", set, 7));
    const double bottom = state_of(
        hop("bottom", to_string(real50(0.75) * exp(real50(-0.875)), 40), set, 7, arithmetic::mp50));
    const double speed =
        state_of(hop("touchdown", to_string(sqrt(real50(5.25)), 40), set, 7, arithmetic::mp50));
    // seven hops amplify rounding by at most 6.5^7 / e^7 = 450
    EXPECT_NEAR(bottom, 0.75 * std::exp(-energy), 1e-12);
    EXPECT_NEAR(speed * speed, 6.0 * energy, 1e-11);
}

TEST(RaibertPneumaticSimple, time_of_a_hop_is_the_integral_over_its_phases) {
    // chi_b sqrt(2 / eta) int exp(w^2) dw, by Simpson's rule with 4000 intervals: error below 1e-13
    const double energy = 1.5;
    const double root = std::sqrt(energy);
    double integral = 0.0;
    for (int i = 0; i <= 4000; ++i) {
        const double w = root * i / 4000.0;
        integral += (i % 4000 == 0 ? 1.0 : i % 2 ? 4.0 : 2.0) * std::exp(w * w);
    }
    integral *= root / 12000.0;
    const double chi_b = 0.5 * std::exp(-energy);
    const double compression = chi_b * std::sqrt(2.0 / 5.81) * integral;
    const double decompression = chi_b * std::sqrt(2.0 / (41.86 * chi_b)) * integral;
    const double alpha = 41.86 * 0.5 / 5.81;
    const double speed = std::sqrt(2.0 * 5.81 * alpha * energy * std::exp(-energy));
    const auto answer =
        hop("touchdown", to_string(sqrt(real50(5.81) * real50(3.0)), 30), figure_11);
    EXPECT_NEAR(number(answer.time), compression + decompression + speed / 5.0, 1e-12);
    EXPECT_NEAR(state_of(answer), speed, 1e-14);
    EXPECT_EQ(answer.events, 3u);
}

TEST(RaibertPneumaticSimple, times_agree_with_50_digits_far_into_the_asymptotic_range) {
    for (const char* energy : {"1e-12", "0.3", "7.5", "39.9", "40.1", "80", "300"}) {
        const auto plain = hop("energy", energy, {{"gain", "50"}});
        const auto wide = hop("energy", energy, {{"gain", "50"}}, 1, arithmetic::wide);
        const auto truth = hop("energy", energy, {{"gain", "50"}}, 1, arithmetic::mp50);
        const double want = number(truth.time);
        // exp(E/2) amplifies the rounding of E, and the positive series adds one ulp per term
        EXPECT_NEAR(number(plain.time), want, 3e-14 * want) << energy;
        const real50 error = parse_real<real50>(wide.time) - parse_real<real50>(truth.time);
        EXPECT_LT(to_double(abs(error)), 1e-27 * want) << energy;
    }
}

TEST(RaibertPneumaticSimple, neutral_gain_converges_algebraically) {
    const auto answer = hop("energy", "1", {{"gain", "7.389056098930650"}}, 1000000);
    // |E - 2| ~ sqrt(3 / n) = 1.7e-3 (page, 8.4); the next term of the expansion is below 2 %
    EXPECT_NEAR(std::abs(state_of(answer) - 2.0), std::sqrt(3e-6), 4e-5);
}

TEST(RaibertPneumaticSimple, gain_one_dies_like_one_over_n) {
    const double energy = state_of(hop("energy", "0.5", {{"gain", "1"}}, 100000));
    EXPECT_NEAR(energy * 1e5, 1.0, 1e-3);  // E_n = 1 / (n + ln(n) / 2 + ...)
    EXPECT_LT(state_of(hop("energy", "0.5", {{"gain", "0.9"}}, 2000)), 1e-80);
}

TEST(RaibertPneumaticSimple, gain_100_reaches_tiny_energies_and_comes_back) {
    const double lowest = state_of(hop("energy", "1", {{"gain", "100"}}, 2));
    EXPECT_NEAR(lowest, 3.9e-13, 0.05e-13);  // the page's two digits
    const double later = state_of(hop("energy", "1", {{"gain", "100"}}, 7));
    EXPECT_NEAR(later / (lowest * 1e10), 1.0,
                5e-5);  // five hops of growth by 100 exp(-E), E up to 4e-5
}

TEST(RaibertPneumaticSimple, orbits_survive_energies_below_the_smallest_double) {
    const settings set{{"gain", "3000"}};
    // after the critical point the energy is 1103.6, then e^-1088: only its logarithm exists
    EXPECT_EQ(state_of(hop("energy", "1", set, 2)), 0.0);
    const double speed = state_of(hop("touchdown", "3.4088121097065", set, 2));
    EXPECT_GT(speed, 0.0);  // the speed's square underflows, the speed does not
    for (const std::uint32_t n : {60u, 100u, 130u}) {
        const double got = state_of(hop("energy", "1", set, n));
        const double want = number(hop("energy", "1", set, n, arithmetic::mp50).columns[0]);
        EXPECT_NEAR(got, want, 1e-11 * want) << n;  // 1088 carries rounding 2e-13 per hop
    }
    EXPECT_EQ(hop("energy", "0", set, 5).end, outcome::ok);
    EXPECT_EQ(state_of(hop("energy", "0", set, 5)), 0.0);
}

TEST(RaibertPneumaticSimple, dying_orbits_fade_through_the_smallest_doubles_and_never_come_back) {
    // below 1e-20 a hop multiplies the energy by the gain alone, its speed by the root of it
    const settings set{{"gain", "0.9"}};
    const double early = state_of(hop("touchdown", "1", set, 1000));
    for (const std::uint32_t n : {6000u, 7000u, 7500u}) {  // energies from 1e-275 to 1e-344
        const double late = state_of(hop("touchdown", "1", set, n));
        const double hops = static_cast<double>(n) - 1000.0;
        EXPECT_NEAR(late / (early * std::pow(0.9, 0.5 * hops)), 1.0, 1e-11) << n;
    }
    EXPECT_EQ(state_of(hop("energy", "0.5", set, 7500)), 0.0);
}

TEST(RaibertPneumaticSimple, superstable_cycles_have_multiplier_zero) {
    // E = 1 is the critical point: what is left is the rounding of alpha exp(-E) - alpha E exp(-E)
    const auto fixed =
        hop("energy", "1", {{"gain", "2.718281828459045"}}, 1, arithmetic::plain, true);
    EXPECT_NEAR(number(fixed.derivative[0]), 0.0, 4e-16);
    const auto pair = hop("energy", "1", {{"gain", "9.5489501"}}, 2, arithmetic::plain, true);
    EXPECT_NEAR(state_of(pair), 1.0, 1e-7);  // the gain has eight digits
    EXPECT_NEAR(number(pair.derivative[0]), 0.0, 4e-15);
}

TEST(RaibertPneumaticSimple, labels_follow_the_cascade) {
    EXPECT_EQ(label_at("1"), 1);
    EXPECT_EQ(label_at("1.0000001"), 2);
    EXPECT_EQ(label_at("7.389056"), 2);
    EXPECT_EQ(label_at("7.389057"), 3);
    EXPECT_EQ(label_at("12.509"), 3);
    EXPECT_EQ(label_at("12.51"), 4);
    EXPECT_EQ(label_at("14.2442"), 4);
    EXPECT_EQ(label_at("14.2443"), 5);
    EXPECT_EQ(label_at("14.7667"), last_cascade_label);  // alpha_inf = 14.76661448
    EXPECT_EQ(label_at("5", "0"), 1);
}

TEST(RaibertPneumaticSimple, labelled_periods_are_those_the_critical_orbit_settles_on) {
    // gains in the middle of each window; 2^k hops bring the orbit back, half as many do not
    const std::vector<std::pair<const char*, int>> windows{
        {"5", 1}, {"10", 2}, {"13.5", 4}, {"14.5", 8}, {"14.72", 16}};
    for (const auto& [gain, period] : windows) {
        const auto at = [&](std::uint32_t n) {
            return state_of(hop("energy", "1", {{"gain", gain}}, n));
        };
        const double reference = at(20000);
        EXPECT_NEAR(at(20000 + static_cast<std::uint32_t>(period)), reference, 1e-9) << gain;
        if (period > 1) {
            EXPECT_GT(std::abs(at(20000 + static_cast<std::uint32_t>(period) / 2) - reference),
                      1e-3)
                << gain;
        }
        label_description text;
        ASSERT_TRUE(model::describe_label(label_at(gain), text));
        EXPECT_EQ(text.period, period) << gain;
    }
}

TEST(RaibertPneumaticSimple, derivatives_agree_with_50_digit_differences) {
    const real50 h(0x1p-60);
    for (const char* section : {"bottom", "energy", "touchdown"}) {
        const settings set{{"gain", "8"}};
        const auto exact = hop(section, "0.40625", set, 3, arithmetic::mp50, true);
        const auto high =
            hop(section, to_string(real50(0.40625) + h, 60), set, 3, arithmetic::mp50);
        const auto low = hop(section, to_string(real50(0.40625) - h, 60), set, 3, arithmetic::mp50);
        const real50 slope =
            (parse_real<real50>(high.columns[0]) - parse_real<real50>(low.columns[0])) / (h + h);
        // truncation h^2 = 1e-36 times a third derivative below 1e5
        EXPECT_NEAR(to_double(parse_real<real50>(exact.derivative[0]) / slope), 1.0, 1e-15)
            << section;
        const auto plain = hop(section, "0.40625", set, 3, arithmetic::plain, true);
        EXPECT_NEAR(number(plain.derivative[0]), to_double(slope),
                    1e-13 * (1.0 + std::abs(to_double(slope))))
            << section;
    }
}

TEST(RaibertPneumaticSimple, one_hop_is_right_to_a_few_ulp) {
    std::mt19937_64 bits(11);
    std::uniform_real_distribution<double> energies(0.0, 30.0);
    std::uniform_real_distribution<double> heights(1e-3, 0.5);
    for (int i = 0; i < 200; ++i) {
        const std::string energy = print_real(energies(bits));
        const double want =
            number(hop("energy", energy, figure_11, 1, arithmetic::mp50).columns[0]);
        EXPECT_NEAR(state_of(hop("energy", energy, figure_11)), want, 8e-16 * want);
        const std::string height = print_real(heights(bits));
        const double next =
            number(hop("bottom", height, figure_11, 1, arithmetic::mp50).columns[0]);
        // an error of one ulp in E moves ln(bottom) by alpha ulp(1) at most
        EXPECT_NEAR(state_of(hop("bottom", height, figure_11)), next, 2e-15 * next);
    }
}

TEST(RaibertPneumaticSimple, small_impacts_keep_their_relative_accuracy) {
    // P'(0) = sqrt(alpha): no absolute tolerance anywhere (page, 8.10)
    for (const char* speed : {"1e-4", "1e-8", "1e-12", "1e-200"}) {
        const double v = number(speed);
        EXPECT_NEAR(state_of(hop("touchdown", speed, {{"gain", "4"}})) / v, 2.0, 1e-8 + 1e-15);
        EXPECT_EQ(hop("touchdown", speed, {{"gain", "4"}}).end, outcome::ok);
    }
}

TEST(RaibertPneumaticSimple, starts_outside_the_domain_are_invalid) {
    EXPECT_EQ(hop("bottom", "0.51", figure_11).end, outcome::invalid_start);
    EXPECT_EQ(hop("bottom", "0", figure_11).end, outcome::invalid_start);
    EXPECT_EQ(hop("bottom", "-0.1", figure_11).end, outcome::invalid_start);
    EXPECT_EQ(hop("energy", "-1", figure_11).end, outcome::invalid_start);
    EXPECT_EQ(hop("energy", "nan", figure_11).end, outcome::invalid_start);
    EXPECT_EQ(hop("touchdown", "inf", figure_11).end, outcome::invalid_start);
    EXPECT_EQ(hop("bottom", "0.5", figure_11).end, outcome::ok);  // the resting state
}

TEST(RaibertPneumaticSimple, traced_phases_join_without_a_gap) {
    for (const char* section : {"energy", "touchdown"}) {
        EXPECT_EQ(trace_row<model>({section, {"1.25"}, {{"leg_mass_ratio", "0.2"}}, {}, 4}, 1e-12),
                  12);
    }
}

}  // namespace
}  // namespace hopscotch::testing_models
