// Lyapunov exponents of single models against closed forms and their pages.
#include "analysis/labels/plan.hpp"
#include "host/run/requests.hpp"
#include "host/run/truth_orbits.hpp"
#include "host/scene/grid.hpp"
#include "tests/models/exponent_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hopscotch {
namespace {

using testing_models::exponent_cells;
using testing_models::spread;

/// The median over the cells whose motion is the one given; counts them.
double median_of(const exponent_cells& cells, const std::vector<double>& values, enum motion wanted,
                 std::size_t& n) {
    std::vector<double> chosen;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (cells.motion_of(i) == wanted) chosen.push_back(values[i]);
    }
    n = chosen.size();
    if (n == 0) return 0.0;
    std::nth_element(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(n / 2),
                     chosen.end());
    return chosen[n / 2];
}

TEST(exponents_of_pneumatic_map, are_the_logarithm_of_the_fixed_points_multiplier) {
    for (const double gain : {1.5, 2.5, 4.0, 5.5, 7.0}) {
        exponent_cells cells{"raibert_pneumatic_simple", "energy", {{1.0, 0.3}}, {{"gain", gain}}};
        cells.compute();
        for (std::size_t i = 0; i < 2; ++i) {
            EXPECT_NEAR(cells.exponents[0][i], std::log(std::abs(1.0 - std::log(gain))), 1e-12);
            EXPECT_EQ(cells.motion_of(i), motion::periodic);
        }
    }
}

/// Page, section 5: the exponent is the average of ln |1 - E_n|, the rest telescopes.
double average_over_energies(double gain, std::uint32_t transient, std::uint32_t returns) {
    double energy = 1.0;
    double sum = 0.0;
    for (std::uint32_t i = 0; i < transient + returns; ++i) {
        if (i >= transient) sum += std::log(std::abs(1.0 - energy));
        energy = gain * energy * std::exp(-energy);
    }
    return sum / returns;
}

TEST(exponents_of_pneumatic_map, in_chaos_are_the_average_of_ln_1_minus_E_in_every_coordinate) {
    for (const double gain : {15.0, 16.6, 18.0, 21.0}) {
        const double truth = average_over_energies(gain, 1000, 2000000);
        for (const auto& [section, start] :
             {std::pair{"energy", 1.0}, std::pair{"bottom", 0.2}, std::pair{"touchdown", 3.0}}) {
            exponent_cells cells{"raibert_pneumatic_simple", section, {{start}}, {{"gain", gain}}};
            cells.returns = 120000;
            cells.compute();
            EXPECT_NEAR(cells.exponents[0][0], truth, 5.0 * cells.error[0]) << gain << section;
            EXPECT_LT(cells.error[0], 3e-3);
            EXPECT_EQ(cells.motion_of(0), motion::chaotic);
        }
    }
}

TEST(exponents_of_line_juggler, are_ln_3_where_it_is_the_chebyshev_cubic) {
    // a = 1 + B = 3 with B = (1 + restitution) energy_gain gravity target_height
    exponent_cells cells{"mirror_line",
                         "apex",
                         {spread(0.05, 1.8, 20)},
                         {{"restitution", 0.5},
                          {"gravity", 1.0},
                          {"target_height", 1.0},
                          {"energy_gain", 2.0 / 1.5}}};
    cells.compute();
    for (std::size_t i = 0; i < cells.size(); ++i) {
        EXPECT_NEAR(cells.exponents[0][i], std::log(3.0), 3.0 * cells.error[i] + 1e-3);
        EXPECT_EQ(cells.motion_of(i), motion::chaotic);
    }
}

/// Page, section 4: the transverse exponents of vertical motion under the solvable law, with
/// kappa11 = b_x* / (2 V) and kappa10 T = 0.3 kappa11.
TEST(exponents_of_planar_juggler, tell_that_horizontal_regulation_survives_vertical_chaos) {
    const double speed = std::sqrt(2.0);  // V at height 1, gravity 1
    const double velocity_gain = 0.5 / speed;
    for (const auto& [b, transverse] :
         {std::pair{0.8, -0.602}, std::pair{1.38, -0.554}, std::pair{1.53, -0.486}}) {
        exponent_cells cells{"mirror_planar",
                             "apex",
                             {{1.0}, {0.8}, {0.0}},
                             {{"restitution", 0.5},
                              {"gravity", 1.0},
                              {"target_height", 1.0},
                              {"target_x", 1.0},
                              {"gain_offset", 1.0 / 3.0},  // tuned
                              {"energy_gain", b / 1.5},
                              {"velocity_gain", velocity_gain},
                              {"position_gain", 0.3 * velocity_gain / speed}},
                             {1}};
        cells.returns = 60000;
        cells.compute();
        double nearest = 1e9;
        for (const auto& exponent : cells.exponents) {
            nearest = std::min(nearest, std::abs(exponent[0] - transverse));
        }
        EXPECT_LT(nearest, 2e-3) << "B = " << b;  // three digits, and the mean of 6e4 cycles
        if (b != 1.38) EXPECT_EQ(cells.motion_of(0), b > 1.0 ? motion::chaotic : motion::periodic);
    }
}

exponent_cells clocked_hopper(double thrust, double on, double period, std::size_t n) {
    std::vector<double> heights;
    std::vector<double> velocities;
    for (const double y : spread(-0.004, 0.002, n)) {
        for (const double v : spread(-0.1, 0.1, n)) heights.push_back(y), velocities.push_back(v);
    }
    return {"openloop_hopper",
            "strobe",
            {heights, velocities},
            {{"thrust", thrust}, {"thrust_time", on}, {"stride_period", period}}};
}

TEST(exponents_of_clocked_hopper, without_hops_are_the_damping_of_the_leg) {
    exponent_cells cells{"openloop_hopper",
                         "strobe",
                         {{-0.001}, {0.0}},
                         {{"thrust", 2.5}, {"thrust_time", 0.02}, {"stride_period", 0.15}}};
    cells.compute();
    // -zeta w; a spiral's length varies along a turn, by less than a factor e over 1500 s
    EXPECT_NEAR(cells.rate[0], -6.0, 2e-3);
    // lambda1 + lambda2 = -2 zeta w times the share of stance, here all of it
    EXPECT_NEAR((cells.exponents[0][0] + cells.exponents[1][0]) / 0.15, -12.0, 1e-9);
    EXPECT_EQ(cells.motion_of(0), motion::periodic);
}

TEST(exponents_of_clocked_hopper, are_the_pages_beside_a_regular_motion) {
    for (const auto& [period, rate] : {std::pair{0.24, 3.6}, std::pair{0.245, 2.7}}) {
        exponent_cells cells = clocked_hopper(1.55, 0.2, period, 12);
        cells.compute();
        std::size_t n = 0;
        EXPECT_NEAR(median_of(cells, cells.rate, motion::chaotic, n), rate, 0.3) << period;
        EXPECT_GT(n, 5u);
        const double regular = median_of(cells, cells.rate, motion::periodic, n);
        EXPECT_LT(regular, 0.0);
        EXPECT_GT(n, 5u);
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const double sum = (cells.exponents[0][i] + cells.exponents[1][i]) / period;
            EXPECT_GT(sum, -12.0 - 1e-9);
            EXPECT_LT(sum, 0.0);
        }
    }
}

TEST(exponents_of_clocked_hopper, are_about_5_per_second_at_high_stride_rates) {
    for (const double period : {0.08, 0.09, 0.1}) {
        exponent_cells cells = clocked_hopper(6.5, 0.02, period, 5);
        cells.compute();
        std::size_t n = 0;
        EXPECT_NEAR(median_of(cells, cells.rate, motion::chaotic, n), 5.0, 1.5) << period;
        EXPECT_GT(n, 20u);
    }
}

TEST(exponents_of_paddle_juggler, add_up_to_2_ln_of_the_restitution) {
    exponent_cells cells{"paddle_juggler",
                         "impact",
                         {spread(0.0, 6.2, 40), spread(2.0, 9.0, 40)},
                         {{"amplitude", 1.6}, {"restitution", 0.5}}};
    cells.compute();
    std::size_t n_bouncing = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const double sum = cells.exponents[0][i] + cells.exponents[1][i];
        if (!std::isfinite(sum)) continue;
        ++n_bouncing;
        // ln of the ratio of two relative velocities, over 1e4 impacts
        EXPECT_NEAR(sum, 2.0 * std::log(0.5), 2e-3);
    }
    EXPECT_GT(n_bouncing, 8u);
}

TEST(exponents_of_a_runner, are_positive_below_the_gap_on_a_linear_spring) {
    // Page: a counterexample to "chaos not observed for the linear spring"
    for (const auto& [speed, truth] : {std::pair{3.955, 0.267}, std::pair{3.968, 0.464}}) {
        const std::vector<double> angles = spread(0.1, 0.7, 30);
        exponent_cells cells{
            "slip",
            "touchdown",
            {std::vector<double>(angles.size(), speed), angles},
            {{"leg_length", 1.5}, {"stiffness", 10.0}, {"touchdown_angle", 0.78539816339744828}},
            {0, 1}};
        cells.compute();
        std::size_t n = 0;
        EXPECT_NEAR(median_of(cells, cells.exponents[0], motion::chaotic, n), truth, 0.015)
            << speed;
        EXPECT_GT(n, 3u);
        // the speed is conserved in flight and stance: its direction is neutral
        EXPECT_NEAR(median_of(cells, cells.exponents[1], motion::chaotic, n), 0.0, 2e-3);
    }
}

/// Directions of a runner's touchdown: the angle's first, because its speed is conserved.
exponent_request at_fixed_speed() {
    exponent_request wanted;
    wanted.direction[0] = 1;
    wanted.direction[1] = 0;
    wanted.n_free = 1;
    return wanted;
}

TEST(exponents_of_a_runner, at_fixed_speed_are_the_multipliers_of_its_stable_gaits) {
    // page, section 11: lambda2 of Fig. 4's gaits, with 4 decimals; v 45, 35, 15, 8
    const double stiffness[] = {2000.0, 1000.0, 250.0, 100.0};
    const double betas[] = {0.95, 0.95, 1.0, 1.0};
    const double speeds[] = {45.0, 35.0, 15.0, 8.0};
    const double angles[] = {0.231712, 0.164726, 0.151585, 0.141161};
    const double multipliers[] = {0.2261, -0.0536, -0.1283, -0.2884};
    for (std::size_t i = 0; i < 4; ++i) {
        exponent_cells cells{
            "slip",
            "touchdown",
            {{speeds[i]}, {angles[i]}},
            {{"leg_length", 1.5}, {"stiffness", stiffness[i]}, {"touchdown_angle", betas[i]}},
            {0, 0},  // gravity in stance
            at_fixed_speed()};
        cells.compute();
        const double multiplier = std::abs(multipliers[i]);
        EXPECT_NEAR(cells.exponents[0][0], std::log(multiplier), 6e-5 / multiplier);
        // the map from speed to speed is the identity; 1e4 roundings of it
        EXPECT_NEAR(cells.exponents[1][0], 0.0, 1e-12);
        EXPECT_EQ(cells.motion_of(0), motion::periodic);
    }
}

TEST(exponents_of_a_runner, are_those_of_its_angle_in_a_scene_and_in_twice_the_digits) {
    const std::vector<std::string> small{"grid.axis.0.cells=40", "question.transient=1000",
                                         "question.returns=4000"};
    const scene scene =
        read_scene(HOPSCOTCH_SOURCE "/configs/scenes/ghigliazza2005_fig12_lyapunov.toml", small);
    const label_plan plan = plan_labels(scene);
    EXPECT_EQ(plan.conserved, std::vector<int>{0});
    // page, section 11: v_SN 1.512797, period doublings at 1.657765, 1.705457, 1.710989
    const std::uint64_t cell = 10;  // of fixed points
    cell_request request = request_of(scene, plan, std::vector<std::uint64_t>{cell});
    double exponents[2] = {};
    std::uint8_t found = 0;
    request.request.exponents.exponents[0] = &exponents[0];
    request.request.exponents.exponents[1] = &exponents[1];
    request.request.exponents.motion = &found;
    kernel_of(scene, "auto").run(request.request);
    EXPECT_EQ(static_cast<motion>(found), motion::periodic);

    const owned_row row = row_of(scene, plan, coordinates_of(scene, cell));
    const exponent_answer answer = run_exponents(scene, plan, row.row);
    EXPECT_EQ(answer.motion, motion::periodic);
    // rounding of one return in double
    EXPECT_NEAR(exponents[0], answer.exponents[0], 1e-12);
    EXPECT_NEAR(answer.exponents[1], 0.0, 1e-28);
    EXPECT_LT(answer.exponents[0], -0.1);
}

}  // namespace
}  // namespace hopscotch
