// Persistent hops by symmetric shooting, and the states of the nonlinear hopper that need a rule:
// the page's numbers, lossless to 50 digits, semi-stable; then starts on the ground, chatter,
// escape and refusals. Source: models/passive_hopper.md sections 2, 6.
#include "kernels/models/passive_hopper.hpp"
#include "kernels/models/passive_juggler.hpp"

#include "analysis/truth/decimal.hpp"
#include "analysis/truth/real50.hpp"
#include "tests/models/nonlinear_rows.hpp"
#include "tests/models/passive_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hopscotch {
namespace {

using namespace nonlinear_rows;

template <class Real>
passive::nonlinear_lane<Real> lane_for(const terms& of) {
    std::vector<Real> parameters;
    for (const double p : of.parameters()) parameters.push_back(parse_real<Real>(text(p)));
    passive::nonlinear_lane<Real> lane;
    passive::take_parameters(lane, parameters.data());
    return lane;
}

TEST(passive_persistent, of_the_linear_hopper_is_the_page_s) {
    const auto hop = passive::persistent_hop(lane_for<double>({.mass_ratio = 1.0}), 1);
    ASSERT_TRUE(hop.found);
    EXPECT_NEAR(hop.height, 10.0953642783, 1e-10);
    EXPECT_NEAR(hop.compression, 4.6033388488, 1e-10);
    EXPECT_NEAR(hop.half_time, 4.493409457909, 1e-12);
    EXPECT_NEAR(hop.alpha, 4.493409457909, 1e-12);
}

TEST(passive_persistent, of_a_cubic_spring_is_the_page_s) {
    const auto lane = lane_for<double>({.mass_ratio = 1.0, .cubic = 0.01});
    EXPECT_NEAR(lane.lift_extension, 0.990288524, 5e-10);
    const auto hop = passive::persistent_hop(lane, 1);
    ASSERT_TRUE(hop.found);
    EXPECT_NEAR(hop.alpha, 4.20508972130, 5e-12);
    EXPECT_NEAR(hop.half_time, hop.alpha, 1e-13);  // momentum, gravity constant
}

TEST(passive_persistent, hops_lift_off_after_their_half_time_exactly_where_gravity_is_constant) {
    for (int k = 1; k <= 4; ++k) {
        const auto level = passive::persistent_hop(
            lane_for<double>({.mass_ratio = 3.0, .quadratic = 0.06, .cubic = 0.01}), k);
        ASSERT_TRUE(level.found) << k;
        EXPECT_NEAR(level.half_time, level.alpha, 1e-12 * level.alpha);
        const auto graded =
            passive::persistent_hop(lane_for<double>({.mass_ratio = 3.0, .gradient = 0.01}), k);
        ASSERT_TRUE(graded.found) << k;
        EXPECT_GT(std::abs(graded.half_time - graded.alpha), 1e-3);
    }
}

TEST(passive_persistent, return_to_themselves_to_40_digits_and_lose_to_both_sides) {
    const terms cases[] = {{.mass_ratio = 1.0, .cubic = 0.01},
                           {.mass_ratio = 0.2, .quadratic = -0.08, .cubic = 0.01},
                           {.mass_ratio = 5.0, .cubic = 0.005, .gradient = 0.02},
                           {.mass_ratio = 2.0, .restitution = 0.5, .gradient = -0.01}};
    for (const terms& of : cases) {
        for (int k = 1; k <= 2; ++k) {
            const auto hop = passive::persistent_hop(lane_for<real50>(of), k);
            ASSERT_TRUE(hop.found) << k;
            // at the hop itself rounding decides whether its triple zero is met; a start 1e-30 to
            // the right loses C (1e-30)^(4/3), C of the order of 1 to 10 (page, section 4)
            const real50 start = hop.alpha + parse_real<real50>("1e-30");
            const orbit_answer back = in_50_digits({.columns = {print_real(start)}, .of = of});
            ASSERT_EQ(back.end, outcome::ok) << k;
            const double moved = to_double(parse_real<real50>(back.columns[0]) - start);
            EXPECT_LT(moved, 0.0) << k;
            EXPECT_GT(moved, -1e-38) << k;
            const double alpha = to_double(hop.alpha);
            for (const double beta : {-1e-3, -1e-5, 1e-5, 1e-3}) {
                const double next = hop_speed(alpha + beta, of);
                EXPECT_LT(next, alpha + beta) << k;
                if (beta > 0.0) EXPECT_GT(next, alpha) << k;
            }
        }
    }
}

/// The laws of section 4 rest on a triple zero of the gap alone: |f - alpha| ~ |beta|^(4/3), ten
/// times stronger from the left.
TEST(passive_persistent, attract_from_the_right_by_the_power_four_thirds) {
    const terms of{.mass_ratio = 1.0, .cubic = 0.01};
    const auto hop = passive::persistent_hop(lane_for<real50>(of), 1);
    const auto loss_at = [&](const char* beta) {
        const real50 alpha = hop.alpha + parse_real<real50>(beta);
        const orbit_answer next = in_50_digits({.columns = {print_real(alpha)}, .of = of});
        return to_double(alpha - parse_real<real50>(next.columns[0]));
    };
    EXPECT_NEAR(loss_at("1e-15") / loss_at("1e-18"), 1e4, 1e2);
    EXPECT_NEAR(loss_at("-1e-18") / loss_at("1e-18"), 10.0, 0.01);
}

TEST(passive_persistent, branches_begin_at_them_and_end_before_the_first_bounce) {
    const std::vector<double> parameters = terms{.cubic = 0.01}.parameters();
    double last_end = 0.0;
    for (int k = 1; k <= 4; ++k) {
        map_branch branch{};
        ASSERT_TRUE(passive_hopper::branch(k, parameters.data(), branch));
        EXPECT_GT(branch.base, last_end);
        EXPECT_GT(branch.end, branch.base);
        const terms of{.cubic = 0.01};
        EXPECT_EQ(number(hop(branch.end - 1e-6, of).extras[0]), 0.0) << k;
        EXPECT_NE(hop(branch.end + 1e-6, of).extras[0], "0") << k;
        last_end = branch.end;
    }
    const std::vector<double> linear = terms{}.parameters();
    map_branch branch{};
    ASSERT_TRUE(passive_hopper::branch(1, linear.data(), branch));
    EXPECT_NEAR(branch.base, 4.493409457909064, 1e-14);
    EXPECT_NEAR(branch.end, 6.283185307179586, 1e-14);
}

// ---- starts on the ground (the table of section 2); this spring lifts off at y1 = 1 exactly

constexpr terms at_one{.mass_ratio = 2.0, .quadratic = -0.03, .cubic = 0.03};

orbit_answer from_ground(const char* y1, const char* v1, const char* v2 = "0",
                         const terms& of = at_one) {
    return in_double({.section = 1, .columns = {y1, v1, "0", v2}, .of = of, .max_steps = 2000.0});
}

TEST(passive_nonlinear_starts, follow_the_table_of_degenerate_states) {
    EXPECT_EQ(number(from_ground("1", "-3.5").columns[0]), 3.5) << "the lossless landing";
    EXPECT_EQ(number(from_ground("1", "-3.5").extras[0]), 0.0);
    EXPECT_EQ(from_ground("1", "0").end, outcome::stuck);
    EXPECT_EQ(from_ground("0.2", "0").end, outcome::stuck);
    // 1 above lift-off: flight at once, and one with v1 > 0 at lift-off is that lift-off's flight
    EXPECT_EQ(from_ground("2.5", "2").end, outcome::ok);
    EXPECT_NEAR(number(from_ground("1", "3").columns[0]), hop_speed(3.0, at_one), 1e-15);
    // y2' < 0 is an impact first: the same as without, once its loss is taken
    const orbit_answer hit = from_ground("-4", "2", "-1");
    const orbit_answer still = from_ground("-4", "2");
    EXPECT_NEAR(number(hit.columns[0]), number(still.columns[0]), 1e-13);
    EXPECT_NEAR(number(hit.extras[1]), number(still.extras[1]) + 2.0, 1e-13);  // M v2^2
    EXPECT_EQ(in_double({.section = 1, .columns = {"0", "0", "-0.1", "0"}, .of = at_one}).end,
              outcome::invalid_start);
    EXPECT_EQ(hop(0.0, at_one).end, outcome::rest);
    EXPECT_EQ(hop(-1.0, at_one).end, outcome::invalid_start);
}

TEST(passive_nonlinear_starts, short_hops_keep_their_relative_accuracy) {
    // alpha - f -> (32/9) kappa alpha^5 of the linear hopper; F' = 1.03 here scales the flight
    const double alpha = 1e-3;
    const orbit_answer next = hop(alpha, at_one);
    EXPECT_EQ(number(next.extras[0]), 0.0);
    const orbit_answer wide = in_50_digits({.columns = {"1e-3"}, .of = at_one});
    EXPECT_NEAR(number(next.extras[1]) / number(wide.extras[1]), 1.0, 1e-9);
    EXPECT_EQ(hop(1e-6, at_one).end, outcome::ok);
}

TEST(passive_nonlinear_starts, chatter_comes_to_rest_and_full_rebounds_never_do) {
    terms of = at_one;
    of.mass_ratio = 1.0;
    of.restitution = 0.5;
    const orbit_answer chatters = in_double(
        {.section = 1, .columns = {"-4", "0", "0.4", "0"}, .of = of, .max_steps = 2000.0});
    EXPECT_EQ(chatters.end, outcome::ok);
    EXPECT_GT(chatters.events, 10u);
    of.restitution = 1.0;
    const orbit_answer bounces = in_double(
        {.section = 1, .columns = {"-4", "0", "0.4", "0"}, .of = of, .max_steps = 2000.0});
    EXPECT_EQ(bounces.end, outcome::budget);
}

TEST(passive_nonlinear_starts, springs_that_give_way_and_gravity_that_turns_escape) {
    // F = s + 2 s^2 pushes outward below s = -1/2
    EXPECT_EQ(from_ground("-5", "-1", "0", {.quadratic = 2.0}).end, outcome::escaped);
    // gravity 1 - y/2 turns at y = 2: thrown up past it as a whole, the hopper never comes back
    const terms light{.mass_ratio = 1.0, .gradient = -0.5};
    EXPECT_EQ(in_double({.section = 1, .columns = {"9", "3", "9", "3"}, .of = light}).end,
              outcome::escaped);
    EXPECT_NE(in_double({.section = 1, .columns = {"1", "0.1", "0.9", "0.1"}, .of = light}).end,
              outcome::escaped);
}

TEST(passive_nonlinear_refusals, say_what_is_not_defined) {
    const auto refused = [](const char* model, const terms& of) {
        return std::string(find_model(model)->refusal(of.parameters().data(), nullptr));
    };
    EXPECT_EQ(refused("passive_hopper", {.cubic = 0.01, .gradient = 0.1}), "");
    EXPECT_EQ(refused("passive_juggler", {.quadratic = -0.1, .cubic = 0.01}), "");
    EXPECT_NE(refused("passive_juggler", {.gradient = 0.1}).find("equivalence"), std::string::npos);
    EXPECT_NE(refused("passive_hopper", {.quadratic = -0.3}).find("no lift-off"),
              std::string::npos);
    EXPECT_EQ(refused("passive_hopper", {.quadratic = -0.24}), "");  // turns at 25/12, F = 1.0417
    EXPECT_NE(refused("passive_hopper", {.cubic = -0.2}).find("no lift-off"), std::string::npos);
    EXPECT_NE(refused("passive_hopper", {.quadratic = -0.24, .gradient = -0.9}).find("gravity"),
              std::string::npos);
}

}  // namespace
}  // namespace hopscotch
