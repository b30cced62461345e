// The spring-mass runner's folds, flips and chaos: the rows of its page's table beyond single
// strides (models/slip.md, section 11).
#include "tests/models/slip_map.hpp"

#include "tests/models/named_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace hopscotch {
namespace {

using namespace testing_models;
using namespace testing_models::slip_map;

void expect_fold(const named_map& near, std::string_view knob, double expected, double digit) {
    const named_map fold = point_with_multiplier(near, knob, 1.0);
    EXPECT_NEAR(fold.value(knob), expected, digit) << angle_of(fold);
    EXPECT_NEAR(largest_multiplier(fold), 1.0, 1e-6);
    EXPECT_GT(angle_of(fold), 0.0);
}

TEST(slip_folds, saddle_nodes_without_gravity_in_stance_are_folds) {
    expect_fold(runner(1.5, 100.0, 1.25, 4.2325, 0.4, linear_off), "speed", 4.2325, 6e-5);
    expect_fold(runner(1.5, 50.0, 0.8, 8.139, 0.3, linear_off), "speed", 8.13883, 6e-6);
    expect_fold(figure_12(1.512797, 0.4), "speed", 1.512797, 6e-7);
    expect_fold(runner(1.5, 100.0, 1.0, 8.2687, 0.35, linear_off), "speed", 8.2687, 6e-5);
}

TEST(slip_folds, saddle_nodes_with_gravity_in_stance_are_folds) {
    expect_fold(runner(1.5, 100.0, 1.0, 7.1153, 0.3, linear_on), "speed", 7.1153, 6e-5);
    expect_fold(runner(0.17, 0.03839, 0.961, 1.60381, 0.35, air_on), "speed", 1.60381, 6e-6);
}

TEST(slip_folds, fold_of_figure_14_moves_to_harder_springs_and_ends_at_the_border) {
    named_map near = by_numbers(1.25, 12.653, 0.01, 0.45, linear_on);
    const std::pair<double, double> rows[] = {
        {0.01, 12.653}, {0.1, 13.499}, {0.25, 14.960}, {0.5, 17.568}};
    for (const auto& [gravity, stiffness] : rows) {
        near = point_with_multiplier(near.with("gravity", gravity), "stiffness", 1.0);
        EXPECT_NEAR(near.value("stiffness"), stiffness, 6e-4) << gravity;
    }
    double last = angle_of(near);
    for (const double gravity : {0.6, 0.7, 0.8, 0.85, 0.9, 0.92, 0.94, 0.95}) {
        near = point_with_multiplier(near.with("gravity", gravity), "stiffness", 1.0);
        EXPECT_LT(angle_of(near), last) << gravity;
        last = angle_of(near);
    }
    // the fold reaches angle 0 just above 0.95
    EXPECT_GT(last, 0.0);
    EXPECT_LT(last, 0.05);
}

TEST(slip_folds, upper_branch_ends_where_kinetic_energy_reaches_zero_length) {
    // v = eta0 sqrt(k / m), kt = 1: 10.6066 for k = 50, 4.743 for 10, 15 for 100
    const std::pair<double, double> rows[] = {{50.0, 10.6066}, {10.0, 4.743}, {100.0, 15.0}};
    for (const auto& [stiffness, speed] : rows) {
        EXPECT_NEAR(1.5 * std::sqrt(stiffness), speed, 6e-4);
        const double beta = 0.8;
        const auto least_sweep = [&](double at) {
            double least = 10.0;
            for (double alpha = 1e-6; alpha < 0.1; alpha *= 1.5) {
                const orbit_answer a =
                    runner(1.5, stiffness, beta, at, beta - alpha, linear_off).answer();
                least = std::min(least, std::stod(a.extras[0]));
            }
            return least;
        };
        const double end = 1.5 * std::sqrt(stiffness);
        EXPECT_LT(least_sweep(end * 0.999), M_PI - 2 * beta) << stiffness;
        EXPECT_GT(least_sweep(end * 1.001), M_PI - 2 * beta) << stiffness;
    }
}

TEST(slip_folds, sweep_at_the_change_of_type_is_largest_at_2_1141) {
    const auto sweep = [](double stiffness, double alpha) {
        return std::stod(
            by_numbers(0.6, stiffness, 0.1, 0.6 - alpha, linear_off).answer().extras[0]);
    };
    double largest = 0.0;
    double place = 0.0;
    for (double alpha = 1e-3; alpha < 1.0; alpha += 1e-3) {
        const double here = sweep(1.0, alpha);
        if (here > largest) largest = here, place = alpha;
    }
    EXPECT_NEAR(largest, 2.1141, 6e-5);
    EXPECT_GT(place, 1e-3);
    EXPECT_NEAR(sweep(1.0, 1e-9), 2 * M_PI / 3, 1e-4);
    EXPECT_NEAR(0.5 * (M_PI - largest), 0.5137, 6e-5);  // least beta with a saddle-node at kt > 1
    // just below kt = 1 a minimum and a maximum, well below it none
    const auto turns = [&](double stiffness) {
        int n = 0;
        double before = sweep(stiffness, 1e-5);
        int direction = -1;
        for (double alpha = 1.1e-5; alpha < 1.0; alpha *= 1.1) {
            const double here = sweep(stiffness, alpha);
            if ((here > before) == (direction < 0)) ++n, direction = -direction;
            before = here;
        }
        return n;
    };
    EXPECT_EQ(turns(0.9995), 2);
    EXPECT_EQ(turns(0.99), 0);
}

TEST(slip_folds, air_spring_doubles_its_period_at_the_reproduced_speeds) {
    named_map near = periodic_point(figure_12(1.65, 0.25));
    named_map flip = point_with_multiplier(near, "speed", -1.0);
    EXPECT_NEAR(flip.value("speed"), 1.657765, 6e-7);
    near = periodic_point(figure_12(1.70, 0.25).after(2000), 2);
    flip = point_with_multiplier(near, "speed", -1.0, 2);
    EXPECT_NEAR(flip.value("speed"), 1.705457, 6e-7);
    near = periodic_point(figure_12(1.7100, 0.25).after(4000), 4);
    flip = point_with_multiplier(near, "speed", -1.0, 4);
    EXPECT_NEAR(flip.value("speed"), 1.710989, 6e-7);
}

/// Mean of ln|P'| along the settled orbit, per stride.
double exponent(named_map m, int strides) {
    m = m.after(500);
    double sum = 0.0;
    for (int i = 0; i < strides; ++i) {
        const map_image f = m.image();
        if (f.end != outcome::ok) return std::nan("");
        sum += std::log(std::abs(f.jacobian(0, 0)));
        m.start = f.state;
    }
    return sum / strides;
}

TEST(slip_folds, air_spring_turns_chaotic_at_1_7124) {
    EXPECT_LT(exponent(figure_12(1.7122), 4000), 0.0);  // v_chaos = 1.7124(1), paper 1.713
    EXPECT_GT(exponent(figure_12(1.7127), 4000), 0.005);
    EXPECT_GT(exponent(figure_12(1.7150), 4000), 0.05);
    EXPECT_LT(exponent(figure_12(1.71475), 4000), 0.0);  // a window (page, case 10)
}

TEST(slip_folds, air_spring_with_gravity_turns_chaotic_at_1_6919) {
    const auto at = [](double speed) {
        return exponent(runner(0.17, 0.03839, 0.961, speed, 0.25, air_on), 1500);
    };
    EXPECT_LT(at(1.6917), 0.0);  // v_chaos = 1.6919(1), paper 1.6932
    EXPECT_GT(at(1.6923), 0.0);
}

TEST(slip_folds, two_cycle_of_figure_9_is_stable_from_3_86864_to_3_93150) {
    const named_map fixed = periodic_point(figure_9(3.86, 0.3));
    EXPECT_NEAR(point_with_multiplier(fixed, "speed", -1.0).value("speed"), 3.86864, 6e-6);
    const named_map pair = periodic_point(figure_9(3.93, 0.16).after(2000), 2);
    EXPECT_NEAR(point_with_multiplier(pair, "speed", -1.0, 2).value("speed"), 3.93150, 6e-6);
    // at the paper's 3.95 the attractor is another one, of longer period
    EXPECT_NEAR(exponent(figure_9(3.95), 4000), -0.05, 0.01);
}

TEST(slip_folds, hooke_spring_is_chaotic_against_the_papers_claim) {
    EXPECT_NEAR(exponent(figure_9(3.955), 20000), 0.267, 0.01);
    EXPECT_NEAR(exponent(figure_9(3.968), 20000), 0.464, 0.01);
}

TEST(slip_folds, hooke_spring_with_gravity_has_the_multiplier_of_the_counterexample) {
    const named_map fixed = periodic_point(by_numbers(1.0, 5.513, 0.6, 0.06, linear_on));
    EXPECT_NEAR(largest_multiplier(fixed), -1.0487, 6e-5);
    const named_map pair = periodic_point(by_numbers(1.0, 5.513, 0.6, 0.015797, linear_on), 2);
    EXPECT_NEAR(angle_of(pair), 0.015797, 6e-7);
    EXPECT_LT(largest_multiplier_modulus(pair, 2), 1.0);
}

TEST(slip_folds, chaos_of_figure_12_parts_orbits_e_fold_every_4_to_11_strides) {
    // page, case 10; at the band's lower end and next to the gap, block errors are some 2 %
    EXPECT_NEAR(1.0 / exponent(figure_12(1.7127), 20000), 11.0, 2.0);
    EXPECT_NEAR(1.0 / exponent(figure_12(1.7154), 20000), 4.0, 1.0);
}

}  // namespace
}  // namespace hopscotch
