// Where two branches cross: normal forms whose crossing branch is known in closed form.
#include "tests/analysis/branch_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hopscotch {
namespace {

using testing_maps::special_points;

/// Maps x -> x + f(x, r) as a model of one column and one parameter.
template <class Normal>
struct normal_form {
    static return_jet jet(const jet_query& query) {
        return_jet result;
        result.returns = query.returns;
        double x = query.columns[0];
        const double r = query.parameters[0];
        double slope = 1.0;
        double by_parameter = 0.0;
        for (std::uint32_t n = 0; n < query.returns; ++n) {
            by_parameter = (1.0 + Normal::slope(x, r)) * by_parameter + Normal::by_parameter(x, r);
            slope *= 1.0 + Normal::slope(x, r);
            x += Normal::value(x, r);
        }
        result.state[0] = x;
        result.derivative[0][0] = slope;
        result.parameter_derivative[0] = by_parameter;
        return result;
    }
    static orbit_answer trace(const orbit_row&, orbit_observer&) { return {}; }

    static constexpr column_info columns[] = {{"x", "1", any_finite, ""}};
    static constexpr section_info sections[] = {{"section", columns, 0, ""}};
    static constexpr parameter_info parameters[] = {{"r", "r", "1", 0.0, any_finite, ""}};
    static constexpr outcome outcomes[] = {outcome::ok};
    static constexpr model_info info{.name = "normal_form",
                                     .title = "",
                                     .reference = "",
                                     .time_unit = "1",
                                     .parameters = parameters,
                                     .sections = sections,
                                     .options = {},
                                     .extras = {},
                                     .outcomes = outcomes,
                                     .trace_columns = columns};
    static constexpr orbit_functions orbits{.trace = trace, .jet = jet};
    static constexpr const orbit_functions* table = &orbits;

    static std::vector<branch> branches(double lowest, double highest, double start, int stations) {
        static const model_entry entry = [] {
            model_entry made{};
            made.info = &info;
            made.n_variants = 1;
            made.orbits_table = &table;
            return made;
        }();
        map_point map;
        map.model = &entry;
        map.parameters = {0.0};
        branch_study study =
            testing_maps::study_over(map, "r", lowest, highest, {{start, 1.0, 12}});
        study.stations = stations;
        study.settling = 0;
        return find_branches(study);
    }
};

struct pitchfork {
    static double value(double x, double r) { return r * x - x * x * x; }
    static double slope(double x, double r) { return r - 3.0 * x * x; }
    static double by_parameter(double x, double) { return x; }
};
struct transcritical {
    static double value(double x, double r) { return r * x - x * x; }
    static double slope(double x, double r) { return r - 2.0 * x; }
    static double by_parameter(double x, double) { return x; }
};
/// Two straight lines x = r, x = -2 r: neither is perpendicular to the other.
struct oblique {
    static double value(double x, double r) { return -0.2 * (x - r) * (x + 2.0 * r); }
    static double slope(double x, double r) { return -0.2 * (2.0 * x + r); }
    static double by_parameter(double x, double r) { return -0.2 * (x - 4.0 * r); }
};

/// Whether a branch passes through (r, x).
bool has_orbit(const std::vector<branch>& branches, double r, double x) {
    for (const branch& each : branches) {
        for (std::size_t i = 0; i + 1 < each.orbits.size(); ++i) {
            const double a = each.orbits[i].variable - r;
            const double b = each.orbits[i + 1].variable - r;
            if (a * b > 0.0 || a == b) continue;
            const double share = a / (a - b);
            const double at = each.orbits[i].state[0] +
                              share * (each.orbits[i + 1].state[0] - each.orbits[i].state[0]);
            if (std::abs(at - x) < 1e-4) return true;  // chords of steps of 1 %
        }
    }
    return false;
}

TEST(branch_points, a_pitchfork_is_found_and_both_its_arms_are_followed) {
    // from one station at r = -0.1, where x = 0 is alone
    const auto branches = normal_form<pitchfork>::branches(-0.5, 0.3, -1.0, 1);
    const auto points = special_points(branches, special_kind::branch_point, 1);
    ASSERT_GE(points.size(), 1u);
    EXPECT_NEAR(points[0].orbit.variable, 0.0, 1e-10);
    EXPECT_NEAR(points[0].orbit.state[0], 0.0, 1e-10);
    EXPECT_TRUE(has_orbit(branches, 0.25, 0.0));
    EXPECT_TRUE(has_orbit(branches, 0.25, 0.5));
    EXPECT_TRUE(has_orbit(branches, 0.25, -0.5));
    EXPECT_EQ(branches.size(), 3u);
}

TEST(branch_points, branches_that_starts_have_found_are_not_followed_again) {
    const auto branches = normal_form<transcritical>::branches(-0.5, 0.3, -1.0, 1);
    const auto points = special_points(branches, special_kind::branch_point, 1);
    ASSERT_EQ(points.size(), 2u);  // one on each branch
    for (const special_point& point : points) EXPECT_NEAR(point.orbit.variable, 0.0, 1e-10);
    EXPECT_EQ(branches.size(), 2u);
    EXPECT_TRUE(has_orbit(branches, 0.2, 0.0));
    EXPECT_TRUE(has_orbit(branches, 0.2, 0.2));
}

TEST(branch_points, an_oblique_crossing_is_switched_to) {
    // starts at x > 0.04 only: Newton's method finds x = 0.1 at r = 0.1, not x = -0.2
    const auto branches = normal_form<oblique>::branches(-0.2, 0.4, 0.04, 1);
    EXPECT_TRUE(has_orbit(branches, 0.3, 0.3));
    EXPECT_TRUE(has_orbit(branches, 0.15, -0.3));
    EXPECT_TRUE(has_orbit(branches, -0.15, 0.3));
    EXPECT_FALSE(special_points(branches, special_kind::branch_point, 1).empty());
}

}  // namespace
}  // namespace hopscotch
