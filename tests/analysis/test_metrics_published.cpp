// Figures others have published: Newton's method for z^3 = 1, and the map on which the uncertainty
// exponent was introduced.
#include "analysis/metrics/box_dimension.hpp"
#include "analysis/metrics/entropy.hpp"
#include "analysis/metrics/wada.hpp"
#include "tests/analysis/metric_maps.hpp"

#include <gtest/gtest.h>

namespace hopscotch::test {
namespace {

using metrics::class_grid;
using metrics::power_law;
using complex = std::complex<double>;

/// The three solutions of N(z) = (2 z^3 + 1) / (3 z^2) = w, by Weierstrass' iteration.
std::array<complex, 3> newton_preimages(complex w) {
    std::array<complex, 3> z{complex(1.0, 0.3), complex(-0.4, 0.9), complex(-0.65, -0.72)};
    for (int sweep = 0; sweep < 100; ++sweep) {
        for (std::size_t i = 0; i < 3; ++i) {
            const complex square = z[i] * z[i];
            z[i] -= (square * z[i] - 1.5 * w * square + 0.5) /
                    ((z[i] - z[(i + 1) % 3]) * (z[i] - z[(i + 2) % 3]));
        }
    }
    return z;
}

/// Bowen's formula for the dimension of the Julia set of N: the sum of |(N^n)'(y)|^-d (in the
/// spherical metric) over all y with N^n(y) = w neither grows nor shrinks with n.
double julia_dimension(complex w, int n) {
    struct branch {
        complex at;
        double log_derivative;
    };
    std::vector<branch> level{{w, 0.0}};
    std::vector<branch> before;
    for (int i = 0; i < n; ++i) {
        before = level;
        level.clear();
        for (const branch& from : before) {
            for (const complex y : newton_preimages(from.at)) {
                const complex derivative = 2.0 * (y * y * y - 1.0) / (3.0 * y * y * y);
                level.push_back({y, from.log_derivative + std::log(std::abs(derivative)) +
                                        std::log1p(std::norm(y)) - std::log1p(std::norm(from.at))});
            }
        }
    }
    const auto sum = [](const std::vector<branch>& branches, double d) {
        double total = 0.0;
        for (const branch& each : branches) total += std::exp(-d * each.log_derivative);
        return total;
    };
    double low = 1.0;
    double high = 2.0;
    while (high - low > 1e-6) {
        const double middle = 0.5 * (low + high);
        (sum(level, middle) > sum(before, middle) ? low : high) = middle;
    }
    return low;
}

class newton_basins : public testing::Test {
protected:
    static const class_grid& map() {
        static const class_grid grid =
            metric_map({metric_axis("re", -1.5, 1.5, 1000), metric_axis("im", -1.5, 1.5, 1000)}, 3,
                       [](const std::vector<double>& x) { return newton_label(x[0], x[1]); });
        return grid;
    }
};

TEST_F(newton_basins, have_the_dimension_of_bowens_formula) {
    // two starting points approach the dimension from both sides: 1.4440 and 1.4446 at n = 13
    const double below = julia_dimension({0.3, 0.4}, 9);
    const double above = julia_dimension({-2.0, 0.7}, 9);
    ASSERT_LT(below, above);
    ASSERT_LT(above - below, 6e-3);
    const double truth = 0.5 * (below + above);
    const power_law law = uncertainty_of(map()).whole;
    EXPECT_NEAR(law.exponent, 2.0 - truth, 0.01);
    EXPECT_LE(std::abs(law.exponent - 2.0 + truth), 2.0 * law.error());
    EXPECT_LT(law.error(), 0.015);
    const power_law boxes = box_counts_of(map()).whole;
    EXPECT_LE(std::abs(dimension_of(map(), boxes) - truth), 2.0 * boxes.error());
}

TEST_F(newton_basins, have_the_box_dimension_others_counted) {
    // 1.42 by box counting: the value the tests of Attractors.jl quote as published
    EXPECT_NEAR(dimension_of(map(), box_counts_of(map()).whole), 1.42, 0.02);
}

TEST_F(newton_basins, are_fractal_by_the_ln_2_criterion) {
    const metrics::basin_entropy entropy = entropy_of(map(), 5);
    EXPECT_GT(entropy.boundary, std::numbers::ln2);
    EXPECT_LT(entropy.boundary, std::log(3.0)) << "the largest entropy of three basins";
    EXPECT_TRUE(entropy.is_above_ln2());
}

TEST_F(newton_basins, have_the_wada_property) {
    // every boundary point of one basin is one of all three (Julia): the merged boundaries agree
    // but for filaments thinner than a cell
    const metrics::wada_test wada = wada_of(map());
    EXPECT_TRUE(wada.is_wada(8.0));
    EXPECT_LT(wada.beyond(1), 0.02) << "share of boundary cells beyond 2 cells";
}

TEST_F(newton_basins, of_roots_that_mirror_each_other_have_mirrored_numbers) {
    const metrics::scaling_by_class laws = uncertainty_of(map());
    EXPECT_EQ(laws.classes[1].fractions, laws.classes[2].fractions);
    EXPECT_EQ(map().classes[1].n_cells, map().classes[2].n_cells);
    EXPECT_EQ(map().n_undecided, 0U);
}

TEST(grebogi_map, has_the_published_uncertainty_exponent_and_dimension) {
    // Grebogi, McDonald, Ott, Yorke (1983): alpha about 0.2, boundary dimension about 1.8, for
    // J_0 = 0.3, a = 1.32, b = 0.9
    const class_grid grid =
        metric_map({metric_axis("theta", 0.0, 2.0 * std::numbers::pi, 1000),
                    metric_axis("x", -0.5, 0.5, 1000)},
                   2, [](const std::vector<double>& x) { return grebogi_label(x[0], x[1]); });
    EXPECT_EQ(grid.n_undecided, 0U);
    const power_law law = uncertainty_of(grid).whole;
    EXPECT_NEAR(law.exponent, 0.2, 0.02);
    EXPECT_LE(std::abs(law.exponent - 0.2), 2.0 * law.error());
    const power_law boxes = box_counts_of(grid).whole;
    EXPECT_NEAR(dimension_of(grid, boxes), 1.8, 0.02);
    EXPECT_LE(std::abs(dimension_of(grid, boxes) - 1.8), 2.0 * boxes.error());
}

}  // namespace
}  // namespace hopscotch::test
