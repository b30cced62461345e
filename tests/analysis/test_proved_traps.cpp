// Traps proved from enclosures: the known stable orbits of the models' pages have them, wrong ones
// are refused for the right reason, and no orbit leaves one.
#include "analysis/traps/proved_trap.hpp"
#include "analysis/labels/interval_trap.hpp"
#include "analysis/labels/plan.hpp"
#include "analysis/traps/proved_interval.hpp"
#include "analysis/truth/decimal.hpp"
#include "analysis/truth/interval_matrix.hpp"
#include "kernels/ensemble/traps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace hopscotch {
namespace {

using settings = std::vector<std::pair<std::string_view, double>>;

/// A map by the names of its model, section, parameters and options (by index of the choice).
map_point map_of(std::string_view model, std::string_view section, const settings& set = {}) {
    map_point map;
    map.model = find_model(model);
    const model_info& info = *map.model->info;
    for (std::size_t i = 0; i < info.sections.size(); ++i) {
        if (info.sections[i].name == section) map.section = static_cast<int>(i);
    }
    for (const parameter_info& parameter : info.parameters)
        map.parameters.push_back(parameter.standard);
    map.options.assign(most_options, 0);
    for (const auto& [name, value] : set) {
        for (std::size_t i = 0; i < info.parameters.size(); ++i) {
            if (info.parameters[i].name == name) map.parameters[i] = value;
        }
        for (std::size_t i = 0; i < info.options.size(); ++i) {
            if (info.options[i].name == name) map.options[i] = static_cast<int>(value);
        }
    }
    map.variant = map.model->variant(
        {map.parameters.data(), map.parameters.data(), map.options.data(), false});
    return map;
}

/// The point an orbit has come to after many returns.
std::vector<double> settled(const map_point& map, std::vector<double> x, int returns = 4000) {
    const return_jet jet = map.jet(x.data(), static_cast<std::uint32_t>(returns));
    EXPECT_EQ(jet.end, outcome::ok);
    return {jet.state, jet.state + x.size()};
}

std::optional<proved_trap> trap_at(const map_point& map, const std::vector<double>& x,
                                   contraction_verdict* why = nullptr, int period = 1) {
    return largest_trap({.map = &map, .period = period, .point = x}, why);
}

/// Half the extent of a trap along one column.
double extent_of(const trap_ellipsoid& trap, int column) {
    small_matrix shape{.n = trap.n_columns};
    std::copy_n(trap.shape, trap.n_columns * trap.n_columns, shape.entry.begin());
    const small_matrix axes = approximate_inverse(shape);
    double square = 0.0;
    for (int j = 0; j < axes.n; ++j) square += axes(column, j) * axes(column, j);
    return std::sqrt(square);
}

contraction_bound bound_of(const map_point& map, const trap_ellipsoid& trap, int period = 1) {
    return prove_contraction(map.model->orbits(), {.section = map.section,
                                                   .options = map.options.data(),
                                                   .variant = map.variant,
                                                   .parameters = map.parameters,
                                                   .returns = period,
                                                   .trap = trap});
}

trap_ellipsoid box_trap(const std::vector<double>& centre, const std::vector<double>& half_axes) {
    trap_ellipsoid trap{};
    trap.n_columns = static_cast<std::int32_t>(centre.size());
    std::copy(centre.begin(), centre.end(), trap.centre);
    for (std::size_t i = 0; i < centre.size(); ++i)
        trap.shape[i * centre.size() + i] = 1.0 / half_axes[i];
    return trap;
}

// ---- the Ricker map E' = alpha E exp(-E): everything in closed form

TEST(proved_trap, its_contraction_is_the_largest_slope_of_the_map_on_it) {
    const map_point map = map_of("raibert_pneumatic_simple", "energy", {{"gain", 5.0}});
    const double fixed = std::log(5.0);
    for (const double half : {1e-6, 1e-2, 0.5, 0.9}) {
        const contraction_bound bound = bound_of(map, box_trap({fixed}, {half}));
        ASSERT_EQ(bound.verdict, contraction_verdict::proved) << half;
        // |f'| = alpha e^-E |1 - E| has its maxima at the ends or at E = 2
        double largest = 0.0;
        for (const double e : {fixed - half, fixed + half, std::min(2.0, fixed + half)})
            largest = std::max(largest, 5.0 * std::exp(-e) * std::abs(1.0 - e));
        EXPECT_GE(bound.contraction, largest * (1.0 - 1e-14)) << half;
        EXPECT_LE(bound.contraction, std::max(largest * (1.0 + half), largest + 1e-6)) << half;
    }
}

TEST(proved_trap, the_largest_one_ends_where_the_slope_reaches_one) {
    const map_point map = map_of("raibert_pneumatic_simple", "energy", {{"gain", 5.0}});
    const auto trap = trap_at(map, {std::log(5.0)});
    ASSERT_TRUE(trap);
    const double lowest = std::log(5.0) - extent_of(trap->trap, 0);
    // f' = 1 at E = 0.6384...: 5 e^-E (1 - E) = 1
    double edge = 0.6;
    for (int i = 0; i < 50; ++i) {
        const double value = 5.0 * std::exp(-edge) * (1.0 - edge) - 1.0;
        edge -= value / (5.0 * std::exp(-edge) * (edge - 2.0));
    }
    EXPECT_GT(lowest, edge);
    EXPECT_LT(lowest, edge + 0.15);
}

TEST(proved_trap, one_that_is_too_large_is_refused) {
    const map_point map = map_of("raibert_pneumatic_simple", "energy", {{"gain", 5.0}});
    const contraction_bound bound = bound_of(map, box_trap({std::log(5.0)}, {1.2}));
    EXPECT_EQ(bound.verdict, contraction_verdict::not_contracting);
}

TEST(proved_trap, one_around_an_unstable_point_is_refused_at_every_size) {
    const map_point map = map_of("raibert_pneumatic_simple", "energy", {{"gain", 9.0}});
    for (const double half : {1e-9, 1e-6, 1e-3, 1e-1}) {
        EXPECT_EQ(bound_of(map, box_trap({std::log(9.0)}, {half})).verdict,
                  contraction_verdict::not_contracting);
    }
    contraction_verdict why{};
    EXPECT_FALSE(trap_at(map, {std::log(9.0)}, &why));
    EXPECT_EQ(why, contraction_verdict::not_contracting);
}

TEST(proved_trap, one_whose_centre_is_no_fixed_point_is_refused) {
    const map_point map = map_of("raibert_pneumatic_simple", "energy", {{"gain", 5.0}});
    const contraction_bound bound = bound_of(map, box_trap({std::log(5.0) + 0.1}, {0.05}));
    EXPECT_EQ(bound.verdict, contraction_verdict::not_contracting);
    // P(c) - c in closed form: alpha c e^-c - c
    const double c = std::log(5.0) + 0.1;
    EXPECT_NEAR(bound.defect, std::abs(5.0 * c * std::exp(-c) - c) / 0.05, 1e-12);
}

TEST(proved_trap, a_cycle_has_one_around_each_of_its_points) {
    // alpha = 9: period 2 is stable (its multiplier falls from 1 at e^2 to -1 at 12.509)
    const map_point map = map_of("raibert_pneumatic_simple", "energy", {{"gain", 9.0}});
    std::vector<double> x = settled(map, {1.0});
    for (int k = 0; k < 2; ++k) {
        EXPECT_FALSE(trap_at(map, x));
        const auto trap = trap_at(map, x, nullptr, 2);
        ASSERT_TRUE(trap);
        EXPECT_GT(extent_of(trap->trap, 0), 1e-3);
        x = settled(map, x, 1);
    }
}

// ---- the known orbits of the pages

struct known_orbit {
    const char* title;
    map_point map;
    std::vector<double> start;
    double least_volume;  // a regression bound: two thirds of what was found when this was written
    std::vector<bool> is_fixed = {};
};

std::vector<known_orbit> known_orbits() {
    const auto hopper = map_of("openloop_hopper", "strobe");
    const settings runner{{"leg_length", 0.173},
                          {"stiffness", 0.01839},
                          {"touchdown_angle", 0.961},
                          {"spring", 1},
                          {"stance_gravity", 1}};
    return {
        {"open loop, tau 0.26 s, regular hop", hopper, {-2.448 / 900, -0.725 / 30}, 2.6e-7},
        {"open loop, tau 0.26 s, hop-settle-fire", hopper, {-0.677 / 900, 0.265 / 30}, 4e-7},
        {"paddle, Gamma 1.2, e 0.5, once per turn",
         map_of("paddle_juggler", "impact", {{"amplitude", 1.2}, {"restitution", 0.5}}),
         {0.5101636, 2.0943951},
         1.5e-2},
        {"planar juggler, law (12)", map_of("mirror_planar", "apex"), {0.5, 0.5, 0.0}, 1.8e-5},
        {"planar juggler, law (15)",
         map_of("mirror_planar", "apex", {{"law", 1}}),
         {0.5, 0.5, 0.0},
         3e-4},
        {"planar juggler, law (16)",
         map_of("mirror_planar", "apex", {{"law", 2}}),
         {0.5, 0.5, 0.0},
         1.8e-4},
        {"runner without gravity in stance, air spring, v 1.6",
         map_of("slip", "touchdown", runner),
         {1.6, 0.28},
         8e-2,
         {true, false}},
    };
}

std::optional<proved_trap> trap_of(const known_orbit& orbit) {
    const std::vector<double> x = settled(orbit.map, orbit.start);
    bool is_fixed[most_columns] = {};
    std::copy(orbit.is_fixed.begin(), orbit.is_fixed.end(), is_fixed);
    return largest_trap(
        {.map = &orbit.map, .point = x, .is_fixed = {is_fixed, orbit.is_fixed.size()}});
}

TEST(proved_trap, every_known_stable_orbit_has_one) {
    for (const known_orbit& orbit : known_orbits()) {
        const auto trap = trap_of(orbit);
        ASSERT_TRUE(trap) << orbit.title;
        EXPECT_LT(trap->bound.contraction, 1.0) << orbit.title;
        EXPECT_GT(trap->volume, orbit.least_volume) << orbit.title;
        const std::vector<double> x = settled(orbit.map, orbit.start);
        for (std::size_t i = 0; i < x.size(); ++i)
            EXPECT_NEAR(trap->trap.centre[i], orbit.start[i], 5e-3) << orbit.title;
    }
}

/// Points on the surface: A^-1 times a random direction, just inside.
template <class Generator>
std::vector<double> on_surface(const trap_ellipsoid& trap, Generator& random) {
    const int n = trap.n_columns;
    std::vector<int> free;
    for (int j = 0; j < n; ++j) {
        bool is_free = false;
        for (int i = 0; i < n; ++i) is_free = is_free || trap.shape[i * n + j] != 0.0;
        if (is_free) free.push_back(j);
    }
    small_matrix shape{.n = static_cast<int>(free.size())};
    for (int i = 0; i < shape.n; ++i) {
        for (int j = 0; j < shape.n; ++j)
            shape(i, j) = trap.shape[free[static_cast<std::size_t>(i)] * n +
                                     free[static_cast<std::size_t>(j)]];
    }
    const small_matrix axes = approximate_inverse(shape);
    std::normal_distribution<double> normal;
    double direction[most_columns];
    double length = 0.0;
    for (int j = 0; j < shape.n; ++j) {
        direction[j] = normal(random);
        length += direction[j] * direction[j];
    }
    length = std::sqrt(length) * (1.0 + 1e-12);
    std::vector<double> x(trap.centre, trap.centre + n);
    for (int i = 0; i < shape.n; ++i) {
        for (int j = 0; j < shape.n; ++j)
            x[static_cast<std::size_t>(free[static_cast<std::size_t>(i)])] +=
                axes(i, j) * direction[j] / length;
    }
    return x;
}

/// Follows starts on the surface in double-double; every return has to lie in the trap, and the
/// last one much deeper.
void expect_that_none_leaves(const known_orbit& orbit, int n_starts, int returns) {
    const auto proved = trap_of(orbit);
    ASSERT_TRUE(proved) << orbit.title;
    using wide = double_double<double>;
    std::mt19937_64 random(7);
    const orbit_functions& model = orbit.map.model->orbits();
    std::vector<std::string> parameters;
    for (const double value : orbit.map.parameters) parameters.push_back(print_real(value));
    for (int k = 0; k < n_starts; ++k) {
        std::vector<std::string> columns;
        for (const double value : on_surface(proved->trap, random))
            columns.push_back(print_real(value));
        for (int r = 0; r < returns; ++r) {
            orbit_row row{.section = orbit.map.section,
                          .options = orbit.map.options.data(),
                          .variant = orbit.map.variant,
                          .columns = columns,
                          .parameters = parameters};
            const orbit_answer answer = model.run_dd(row);
            ASSERT_EQ(answer.end, outcome::ok) << orbit.title;
            columns = answer.columns;
            std::vector<wide> x;
            for (const std::string& text : columns) x.push_back(parse_real<wide>(text));
            ASSERT_TRUE(holds(proved->trap, x.data())) << orbit.title << ", return " << r;
        }
    }
}

TEST(proved_trap, no_orbit_started_on_its_surface_leaves_it) {
    for (const known_orbit& orbit : known_orbits()) expect_that_none_leaves(orbit, 12, 10);
}

TEST(proved_trap, slow_no_orbit_leaves_it_in_a_hundred_thousand_returns) {
    for (const known_orbit& orbit : known_orbits()) expect_that_none_leaves(orbit, 2, 100000);
}

// ---- intervals

TEST(proved_interval, one_that_a_unimodal_map_sends_into_itself_is_proved_to_rounding) {
    // alpha = 5: f([0.5, 2.5]) lies between f(2.5) = 1.026 and the hump f(1) = 5/e = 1.839
    const map_point map = map_of("raibert_pneumatic_simple", "energy", {{"gain", 5.0}});
    const auto proved = prove_interval_trap(map, 0.5, 2.5);
    ASSERT_TRUE(proved);
    EXPECT_EQ(proved->lowest, 0.5);
    EXPECT_EQ(proved->highest, 2.5);
    EXPECT_EQ(proved->uncovered, 0.0);
    EXPECT_FALSE(proved->is_monotone);
    EXPECT_FALSE(proved->contracts);  // f'(0.5) = 1.516
    EXPECT_FALSE(proved->only_falls);
}

TEST(proved_interval, what_its_slopes_say_is_noted) {
    const map_point map = map_of("raibert_pneumatic_simple", "energy", {{"gain", 2.0}});
    // f rises up to E = 1, has its fixed point at ln 2 = 0.693 with slope 0.307; f'(0.4) = 0.804
    const auto proved = prove_interval_trap(map, 0.4, 0.95);
    ASSERT_TRUE(proved);
    EXPECT_TRUE(proved->is_monotone);
    EXPECT_TRUE(proved->contracts);
    EXPECT_FALSE(proved->only_falls);  // it rises below ln 2
    const auto above = prove_interval_trap(map, std::log(2.0) + 1e-3, 0.95);
    EXPECT_FALSE(above);  // f(ln 2 + d) = ln 2 + 0.307 d lies below it: orbits leave downward
}

TEST(proved_interval, one_from_which_orbits_escape_is_refused) {
    const map_point map = map_of("raibert_pneumatic_simple", "energy", {{"gain", 5.0}});
    // the hump 1.839 leaves [0.5, 1.8]
    contraction_verdict why{};
    EXPECT_FALSE(prove_interval_trap(map, 0.5, 1.8, &why));
    EXPECT_EQ(why, contraction_verdict::not_contracting);
}

TEST(proved_interval, traps_of_the_hopper_that_gains_speed_are_proved_up_to_the_lossless_point) {
    // CPRR Fig. 8: between the unstable fixed point left of alpha*_1 and its preimage; found by
    // sampling, the ends are those of `attractors configs/scenes/chatterjee2002_fig8.toml`
    const struct {
        double increment, lowest, highest;
    } traps[] = {{0.01, 4.491013359217753, 4.5298451917511819},
                 {0.07, 4.4815721927196863, 4.5877012273655371},
                 {0.13, 4.4730362921887119, 4.628550898286715}};
    for (const auto& trap : traps) {
        const map_point map =
            map_of("passive_hopper", "liftoff", {{"speed_increment", trap.increment}});
        const auto proved = prove_interval_trap(map, trap.lowest, trap.highest);
        ASSERT_TRUE(proved) << trap.increment;
        EXPECT_LT(proved->lowest - trap.lowest, 1e-11);
        EXPECT_LT(trap.highest - proved->highest, 1e-11);
        EXPECT_LT(proved->uncovered, 1e-11);  // at alpha*_1 = 4.4934, where bounces begin
        // a hundredth wider on the left it is none: orbits there sink to rest
        EXPECT_FALSE(prove_interval_trap(map, trap.lowest - 1e-2, trap.highest));
    }
}

TEST(proved_interval, labels_of_the_hopper_that_gains_speed_rest_on_proved_traps) {
    // one column of CPRR Fig. 8; a trap found by sampling is only replaced by what lies in it
    const std::vector<std::string> column{"grid.axis.0.cells=1", "grid.axis.0.min=0.06",
                                          "grid.axis.0.max=0.08", "grid.axis.1.cells=50"};
    const scene of = read_scene(
        std::string(HOPSCOTCH_SOURCE) + "/configs/scenes/chatterjee2002_fig8.toml", column);
    const label_plan plan = plan_labels(of);
    const auto row = std::ranges::find_if(
        plan.attractors, [](const attractor_row& one) { return one.name == "fixed point 1"; });
    ASSERT_NE(row, plan.attractors.end());
    EXPECT_NE(row->trap.find("proved by enclosures"), std::string::npos) << row->trap;
    const auto trap = std::ranges::find_if(
        plan.traps, [&](const trap_interval& one) { return one.label == row->label; });
    ASSERT_NE(trap, plan.traps.end());
    EXPECT_NEAR(trap->lowest, 4.4815721927196863, 1e-9);  // at increment 0.07, as above
    EXPECT_NEAR(trap->highest, 4.5877012273655371, 1e-9);
}

TEST(proved_interval, neutral_ends_keep_their_sampled_trap_and_say_so) {
    // without added energy alpha*_1 attracts from above only: no enclosure tells it from a repeller
    const map_point map = map_of("passive_hopper", "liftoff", {{"restitution", 0.1}});
    interval_trap trap{4.4934094579090642, 4.6};
    prove(map, trap);
    EXPECT_FALSE(trap.is_proved);
    EXPECT_EQ(trap.highest, 4.6);
    EXPECT_EQ(trap.evidence(), "sampled and bisected");
}

// ---- wrong traps

TEST(proved_trap, the_saddle_between_two_stable_orbits_has_none) {
    const map_point map = map_of("openloop_hopper", "strobe");
    // (-1.705, +0.931) in scaled units is known to three digits only: no trap of any size near it
    const std::vector<double> saddle{-1.705 / 900, 0.931 / 30};
    EXPECT_NE(bound_of(map, box_trap(saddle, {1e-5, 1e-3})).verdict, contraction_verdict::proved);
}

TEST(proved_trap, one_across_a_change_of_the_order_of_events_is_undecided) {
    const map_point map = map_of("openloop_hopper", "strobe");
    const std::vector<double> x = settled(map, {-2.448 / 900, -0.725 / 30});
    // velocities of -0.725 +- 2.4 in scaled units: some starts take off before the thrust ends
    contraction_query query{.section = map.section,
                            .options = map.options.data(),
                            .variant = map.variant,
                            .parameters = map.parameters,
                            .trap = box_trap(x, {2.4e-3, 8e-2}),
                            .most_pieces = 2};  // as a whole: the centre, then the ellipsoid
    EXPECT_EQ(prove_contraction(map.model->orbits(), query).verdict,
              contraction_verdict::undecided_comparison);
    query.most_pieces = 256;
    EXPECT_NE(prove_contraction(map.model->orbits(), query).verdict, contraction_verdict::proved);
}

TEST(proved_trap, integrated_flows_are_not_supported) {
    const map_point runner = map_of(
        "slip", "touchdown", {{"leg_length", 1.5}, {"stiffness", 100.0}, {"touchdown_angle", 1.0}});
    EXPECT_EQ(bound_of(runner, box_trap({8.0, 0.15}, {1e-6, 1e-6})).verdict,
              contraction_verdict::not_supported);
    const map_point valve = map_of("relief_valve", "maximum");
    EXPECT_EQ(bound_of(valve, box_trap({1.0, 10.0}, {1e-6, 1e-6})).verdict,
              contraction_verdict::not_supported);
}

TEST(proved_trap, a_shape_without_inverse_proves_nothing) {
    const map_point map = map_of("openloop_hopper", "strobe");
    trap_ellipsoid trap = box_trap({-2.448 / 900, -0.725 / 30}, {1e-5, 1e-3});
    trap.shape[2] = trap.shape[0];
    trap.shape[3] = trap.shape[1] = 1.0;
    EXPECT_EQ(bound_of(map, trap).verdict, contraction_verdict::not_supported);
}

}  // namespace
}  // namespace hopscotch
