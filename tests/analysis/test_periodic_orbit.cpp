// Newton's method on periodic points: published orbits, closed forms, minimal periods, phases.
#include "analysis/periodic/periodic_orbit.hpp"
#include "analysis/periodic/return_equation.hpp"
#include "tests/analysis/map_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace hopscotch {
namespace {

using testing_maps::map_of;

TEST(periodic_orbit, finds_the_published_fixed_points_of_the_clocked_hopper) {
    const map_point map = map_of("openloop_hopper", "strobe");
    struct row {
        double height, velocity, multiplier;  // scaled; models/openloop_hopper.md, section 7
    };
    // the page's digits: height and velocity to 1e-3, multipliers to 1e-3, |mu| to 1e-2
    for (const row& known :
         {row{-2.448, -0.725, 0.53}, row{-1.705, 0.931, 1.536}, row{-0.677, 0.265, 0.31}}) {
        const double w = 30.0;
        const double guess[] = {known.height / (w * w), known.velocity / w};
        const auto orbit = refine_periodic_orbit(map, guess, 1);
        ASSERT_TRUE(orbit);
        EXPECT_NEAR(orbit->points[0] * w * w, known.height, 6e-4);
        EXPECT_NEAR(orbit->points[1] * w, known.velocity, 6e-4);
        EXPECT_NEAR(std::abs(orbit->multipliers[0]), known.multiplier, 6e-3);
        EXPECT_LT(orbit->residual, 1e-13);  // rounding of one return in the orbit's own size
    }
}

TEST(periodic_orbit, gives_the_paddle_jugglers_closed_form_and_multipliers) {
    const map_point map =
        map_of("paddle_juggler", "impact", {{"amplitude", 1.2}, {"restitution", 0.5}});
    const double guess[] = {0.5, 2.1};
    const auto orbit = refine_periodic_orbit(map, guess, 1);
    ASSERT_TRUE(orbit);
    // models/paddle_juggler.md, section 7, all printed digits
    EXPECT_NEAR(orbit->points[0], 0.510163608543305, 1e-14);
    EXPECT_NEAR(orbit->points[1], 2.09439510239320, 1e-14);
    EXPECT_NEAR(orbit->multipliers[0].real(), -0.0342320388882877, 1e-14);
    EXPECT_NEAR(std::abs(orbit->multipliers[0].imag()), 0.498826791094414, 1e-14);
}

TEST(periodic_orbit, crosses_the_cut_of_a_phase) {
    // cos(phase) = w / Gamma has a root on each side of phase 0, where the column wraps
    const double w = std::numbers::pi / 3.0;  // pi m (1 - e) / (1 + e)
    const double amplitude = w * (1.0 + 1e-4);
    const map_point map =
        map_of("paddle_juggler", "impact", {{"amplitude", amplitude}, {"restitution", 0.5}});
    const double phase = std::acos(w / amplitude);
    const double speed = std::numbers::pi - w;
    const double turn = 2.0 * std::numbers::pi;
    for (const double guess_phase : {-1.3 * phase, turn - 0.8 * phase}) {
        const double guess[] = {guess_phase, speed};
        const auto orbit = refine_periodic_orbit(map, guess, 1);
        ASSERT_TRUE(orbit);
        EXPECT_NEAR(orbit->points[0], turn - phase, 1e-11);  // rounding over sin(phase) = 0.014
        EXPECT_GT(orbit->multipliers[0].real(), 1.0);        // below the fold: the saddle
    }
}

TEST(periodic_orbit, has_the_same_multipliers_on_a_section_whose_phase_wraps) {
    const map_point strobe = map_of("openloop_hopper", "strobe");
    std::vector<double> known;
    for (const auto& [height, velocity] :
         {std::pair{-2.448, -0.725}, {-1.705, 0.931}, {-0.677, 0.265}}) {
        const double guess[] = {height / 900.0, velocity / 30.0};
        known.push_back(std::abs(refine_periodic_orbit(strobe, guess, 1)->multipliers[0]));
    }
    const map_point landing = map_of("openloop_hopper", "landing");
    int n_found = 0;
    for (int i = 0; i < 28; ++i) {
        const double guess[] = {0.01 * i - 0.02, -0.06};  // the first ones before the turn
        const auto orbit = refine_periodic_orbit(landing, guess, 1);
        if (!orbit) continue;
        ++n_found;
        EXPECT_GE(orbit->points[0], 0.0);
        EXPECT_LT(orbit->points[0], 0.26);
        double nearest = 1.0;
        for (const double multiplier : known) {
            nearest = std::min(nearest, std::abs(multiplier - std::abs(orbit->multipliers[0])));
        }
        EXPECT_LT(nearest, 1e-10);  // rounding of the two products of saltations
    }
    EXPECT_GT(n_found, 0);
}

TEST(periodic_orbit, does_not_take_a_multiplier_near_minus_one_for_period_two) {
    // f(E) = alpha E exp(-E): fixed point ln alpha, multiplier 1 - ln alpha; no 2-cycle below e^2
    for (const double excess : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 0.0}) {
        const double gain = std::exp(2.0) * (1.0 - excess);
        const map_point map = map_of("raibert_pneumatic_simple", "energy", {{"gain", gain}});
        for (const double guess : {1.9, 1.99, 2.001, 2.2}) {
            EXPECT_FALSE(refine_periodic_orbit(map, std::span(&guess, 1), 2)) << excess;
            EXPECT_FALSE(refine_periodic_orbit(map, std::span(&guess, 1), 4)) << excess;
        }
    }
}

TEST(periodic_orbit, finds_a_two_cycle_just_beyond_its_birth) {
    // beyond e^2 the 2-cycle is E = ln alpha -+ d with d = sqrt(6 (ln alpha - 2)) to leading order
    for (const double excess : {1e-2, 1e-4, 1e-6, 1e-8}) {
        const double gain = std::exp(2.0 + excess);
        const map_point map = map_of("raibert_pneumatic_simple", "energy", {{"gain", gain}});
        const double apart = std::sqrt(6.0 * excess);
        const double guess = 2.0 + excess + apart;
        const auto orbit = refine_periodic_orbit(map, std::span(&guess, 1), 2);
        ASSERT_TRUE(orbit) << excess;
        const double half = 0.5 * std::abs(orbit->points[0] - orbit->points[1]);
        EXPECT_NEAR(half / apart, 1.0, 10.0 * apart + 1e-6);  // next order of the expansion
    }
}

TEST(periodic_orbit, leaves_a_conserved_column_alone) {
    const map_point map =
        map_of("slip", "touchdown", {{"leg_length", 1.0}, {"stiffness", 9.0}, {"gravity", 0.5886}},
               {{"stance_gravity", "off"}});
    const double guess[] = {1.0, 0.15};
    EXPECT_EQ(conserved_columns(map, guess), std::vector<int>{0});
    const auto orbit = refine_periodic_orbit(map, guess, 1);
    ASSERT_TRUE(orbit);
    EXPECT_EQ(orbit->points[0], 1.0);
    EXPECT_EQ(orbit->multipliers.size(), 1U);
    // the sweep of a period-1 gait is pi - 2 beta
    const double there[] = {orbit->points[0], orbit->points[1]};
    EXPECT_NEAR(map.jet(there).state[1], orbit->points[1], 1e-15);
}

TEST(periodic_orbit, finds_orbits_of_a_map_with_an_invariant_that_is_no_column) {
    const map_point map =
        map_of("slip", "apex", {{"leg_length", 1.0}, {"stiffness", 9.0}, {"gravity", 0.5886}},
               {{"stance_gravity", "off"}});
    const double guess[] = {0.98, 0.97};  // energy is conserved: a curve of fixed points
    const auto orbit = refine_periodic_orbit(map, guess, 1);
    ASSERT_TRUE(orbit);
    EXPECT_LT(orbit->residual, 1e-13);
    const bool has_one = std::abs(orbit->multipliers[0] - 1.0) < 1e-9 ||
                         std::abs(orbit->multipliers[1] - 1.0) < 1e-9;
    EXPECT_TRUE(has_one);
}

}  // namespace
}  // namespace hopscotch
