// Fold and flip curves over two variables, cascades' limits and gaps against published numbers and
// closed forms.
#include "analysis/continuation/bifurcation_curve.hpp"
#include "analysis/continuation/cascade.hpp"
#include "analysis/continuation/gap_opening.hpp"
#include "tests/analysis/branch_runs.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace hopscotch {
namespace {

using testing_maps::map_of;
using testing_maps::special_points;
using testing_maps::study_over;

// Gamma^2 = w^2 + (2 (1 + e^2)/(1 + e)^2)^2 with w = pi (1 - e)/(1 + e), for every e
TEST(bifurcation_curve, follows_the_paddle_jugglers_flip_over_the_restitution) {
    map_point map = map_of("paddle_juggler", "impact", {{"restitution", 0.5}});
    branch_study study = study_over(map, "amplitude", 1.0, 2.2, {{0.0, 1.5, 6}, {1.9, 2.3, 3}});
    study.doublings = 0;
    study.limits.step = 0.02;
    const auto branches = find_branches(study);
    const branch_variable restitution{false, 1, 0.3, 0.8};
    const auto curves = curves_through(study.family, restitution, branches, study.limits);
    bool has_flip = false;
    for (const bifurcation_curve& curve : curves) {
        if (curve.kind != special_kind::flip) continue;
        has_flip = true;
        EXPECT_GT(curve.variable.size(), 30U);
        for (std::size_t i = 0; i < curve.variable.size(); ++i) {
            const double e = curve.second[i];
            const double w = std::numbers::pi * (1.0 - e) / (1.0 + e);
            const double steep = 2.0 * (1.0 + e * e) / ((1.0 + e) * (1.0 + e));
            EXPECT_NEAR(curve.variable[i], std::sqrt(w * w + steep * steep), 1e-10);
        }
        EXPECT_NEAR(curve.second.back(), 0.8, 1e-12);
    }
    EXPECT_TRUE(has_flip);
}

// det = 1 on k11 = T k10 and a flip at k11 = 2/G (models/mirror_juggler.md, section 4)
TEST(bifurcation_curve, follows_the_planar_jugglers_neimark_sacker_line) {
    const map_point map =
        map_of("mirror_planar", "apex", {{"position_gain", 0.05}}, {{"law", "solvable"}});
    const double fall = std::sqrt(2.0 * 9.81 * 0.5);
    const double flight = fall / 9.81;
    branch_study study = study_over(map, "velocity_gain", 0.005, 0.2,
                                    {{0.4, 0.6, 2}, {0.4, 0.6, 2}, {-0.1, 0.1, 2}});
    study.doublings = 0;
    const branch_variable position_gain{false, 6, 0.02, 0.15};
    const auto curves =
        curves_through(study.family, position_gain, find_branches(study), study.limits);
    ASSERT_EQ(curves.size(), 2U);
    for (const bifurcation_curve& curve : curves) {
        EXPECT_GT(curve.variable.size(), 50U);
        for (std::size_t i = 0; i < curve.variable.size(); ++i) {
            const double expected =
                curve.kind == special_kind::flip ? 0.5 / fall : flight * curve.second[i];
            EXPECT_NEAR(curve.variable[i], expected, 1e-10);
        }
    }
}

// kt_SN(gt) of models/slip.md, section 11 (Fig. 14), beta = 1.25, gravity in stance
TEST(bifurcation_curve, follows_the_runners_fold_over_gravity_and_stiffness) {
    const map_point map = map_of("slip", "touchdown", {{"leg_length", 1.0}, {"gravity", 0.25}},
                                 {{"spring", "linear"}, {"stance_gravity", "on"}});
    branch_study study = study_over(map, "stiffness", 12.0, 18.0, {{1.0, 1.0, 1}, {0.02, 0.6, 12}});
    study.family.state[0] = 1.0;
    study.doublings = 0;
    const auto folds = special_points(find_branches(study), special_kind::fold, 1);
    ASSERT_EQ(folds.size(), 1U);
    EXPECT_NEAR(folds[0].orbit.variable, 14.960, 5e-4);
    const branch_variable gravity{false, 3, 0.005, 0.55};
    const auto curve = follow_curve(study.family, gravity, 1, folds[0], study.limits);
    ASSERT_TRUE(curve);
    const bifurcation_equation equation(study.family, gravity, 1, special_kind::fold);
    for (const auto& [at, stiffness] : {std::pair{0.01, 12.653}, {0.1, 13.499}, {0.5, 17.568}}) {
        std::size_t nearest = 0;
        for (std::size_t i = 0; i < curve->second.size(); ++i) {
            if (std::abs(curve->second[i] - at) < std::abs(curve->second[nearest] - at))
                nearest = i;
        }
        // onto the line gravity = at, from the nearest orbit of the curve
        special_point there;
        branch_family family = study.family;
        family.map.parameters[3] = at;
        there.orbit.unknowns =
            branch_equation(family, 1).unknowns_of(curve->state[nearest], curve->variable[nearest]);
        const Eigen::VectorXd guess = equation.unknowns_of(there, at);
        const auto point =
            step_along(equation, guess, Eigen::VectorXd::Unit(guess.size(), guess.size() - 1), 0.0)
                .point;
        ASSERT_TRUE(point) << at;
        EXPECT_NEAR(equation.variable_of(point->unknowns), stiffness, 5e-4) << at;
    }
}

// models/raibert_hopper.md, section 6: alpha_inf = 14.76661448
TEST(cascade, extrapolates_the_accumulation_point_of_the_pneumatic_map) {
    const map_point map = map_of("raibert_pneumatic_simple", "energy");
    branch_study study = study_over(map, "gain", 5.0, 15.0, {{0.0, 6.0, 12}});
    study.doublings = 6;
    const auto cascades = cascades_of(find_branches(study));
    ASSERT_EQ(cascades.size(), 1U);
    const accumulation& cascade = cascades[0];
    EXPECT_EQ(cascade.flips.size(), 7U);
    EXPECT_LT(cascade.error, 1e-6);
    EXPECT_NEAR(cascade.limit, 14.76661448, cascade.error + 5e-9);
    EXPECT_NEAR(cascade.ratio, 4.669, 0.01);  // the first ratios are 2.95, 4.25, 4.57 (page)
}

TEST(cascade, needs_four_flips) {
    EXPECT_FALSE(accumulation_of({1.0, 2.0, 2.2}));
    // an exact geometric cascade is extrapolated exactly
    std::vector<double> flips{0.0, 1.0};
    for (int k = 0; k < 6; ++k)
        flips.push_back(flips.back() + (flips.back() - flips[flips.size() - 2]) / 4.669201609103);
    const auto limit = accumulation_of(flips);
    ASSERT_TRUE(limit);
    EXPECT_NEAR(limit->limit, 4.669201609103 / 3.669201609103, 1e-11);
}

// gap speeds of models/slip.md, section 11; "off": gravity neglected in stance
TEST(gap_opening, finds_the_gap_speeds_of_runners) {
    struct row {
        const char* spring;
        const char* gravity;
        double leg, stiffness, beta, from, gap, last_digit;
    };
    for (const row& known :
         {row{"air", "off", 0.173, 0.01839, 0.961, 1.70, 1.715498, 5e-7},
          row{"linear", "off", 1.5, 50.0, 0.8, 9.0, 9.58613, 5e-6},
          row{"linear", "off", 1.5, 100.0, 1.25, 5.0, 5.3562, 5e-5},
          row{"linear", "off", 1.5, 10.0, 0.78539816339744831, 3.9, 3.97090, 5e-6},
          row{"linear", "on", 1.5, 100.0, 1.0, 8.0, 8.4781, 5e-5}}) {
        const map_point map = map_of("slip", "touchdown",
                                     {{"leg_length", known.leg},
                                      {"stiffness", known.stiffness},
                                      {"touchdown_angle", known.beta}},
                                     {{"spring", known.spring}, {"stance_gravity", known.gravity}});
        const branch_study study = study_over(map, "speed", 0.9 * known.from, 1.1 * known.gap,
                                              {{known.from, known.from, 1}, {0.0, known.beta, 8}});
        const auto gap = find_gap_opening(study.family, known.from, 0.01, 0.9 * known.beta);
        ASSERT_TRUE(gap) << known.gap;
        EXPECT_NEAR(gap->variable, known.gap, known.last_digit);
        if (known.leg == 0.173) EXPECT_NEAR(gap->state, 0.36359030, 5e-9);  // section 13, case 3
    }
}

}  // namespace
}  // namespace hopscotch
