// The spatial mirror-law juggler: the planar map inside it, symmetry and stability
// (models/mirror_juggler.md, section 5).
#include "tests/models/spatial_juggler.hpp"

#include "kernels/models/mirror_planar.hpp"
#include "kernels/models/mirror_spatial.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace hopscotch {
namespace {

using namespace testing_models::spatial_juggler;

state end_of(const orbit_answer& a) {
    state x{};
    for (std::size_t c = 0; c < 5; ++c) x[c] = number(a.columns[c]);
    return x;
}

using matrix = std::array<std::array<double, 5>, 5>;

matrix jacobian(const juggler& j, const state& x) {
    const orbit_answer a = run(j, x, 1, true);
    matrix m{};
    for (std::size_t i = 0; i < 25; ++i) m[i / 5][i % 5] = number(a.derivative[i]);
    return m;
}

TEST(mirror_spatial, radial_motion_is_the_planar_map) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> u(0, 1);
    for (int i = 0; i < 120; ++i) {
        juggler j{.law = i % 3, .energy = (i / 3) % 2};
        j.kr0 = 0.3 * u(random);
        j.kr1 = 0.15 * u(random);
        j.azimuth = 3 * (2 * u(random) - 1);
        const double r = 0.3 + u(random), z = 0.3 + u(random), v = 1.5 * (2 * u(random) - 1);
        const double c = std::cos(j.azimuth), s = std::sin(j.azimuth);
        const orbit_answer got = run(j, {r * c, r * s, z, v * c, v * s});

        const std::vector<std::string> parameters =
            written(std::vector<double>{j.alpha, j.gravity, j.kappa0, j.kappa1, j.radius, j.height,
                                        j.kr0, j.kr1, j.shoulder, j.bar, j.floor});
        const std::vector<std::string> columns = written(std::vector<double>{r, z, v});
        const int options[] = {j.law, j.energy};
        orbit_row row;
        row.options = options;
        row.variant = j.law;
        row.columns = columns;
        row.parameters = parameters;
        const orbit_answer plane = testing_models::orbits_of<mirror_planar>().run_double(row);
        // the bar's law looks beyond the shoulder (theta_c > pi/2), the arm's r(tau) does not
        if (j.law == level && got.end == outcome::over_shoulder &&
            plane.end == outcome::apex_below) {
            continue;
        }
        ASSERT_EQ(got.end, plane.end) << i;
        if (got.end != outcome::ok) continue;
        const state x = end_of(got);
        // azimuth's cosine and sine are rounded: radial to 1e-16 only
        EXPECT_NEAR(x[0] * c + x[1] * s, number(plane.columns[0]), 2e-13) << i;
        EXPECT_NEAR(x[1] * c - x[0] * s, 0.0, 2e-13) << i;
        EXPECT_NEAR(x[2], number(plane.columns[1]), 2e-13) << i;
        EXPECT_NEAR(x[3] * c + x[4] * s, number(plane.columns[2]), 2e-13) << i;
    }
}

TEST(mirror_spatial, commutes_with_rotation_about_the_vertical) {
    const state x{0.52, 0.08, 0.55, -0.1, 0.2};
    for (int law : {original, solvable, level}) {
        const juggler j{.law = law};
        for (double turn : {0.7, 2.5, 3.5}) {  // the last one crosses the wrap at pi
            juggler turned = j;
            turned.azimuth = turn > 3.14159 ? turn - 2 * pi<double>() : turn;
            const double c = std::cos(turn), s = std::sin(turn);
            const state a = end_of(run(j, x));
            const state b = end_of(run(turned, {x[0] * c - x[1] * s, x[0] * s + x[1] * c, x[2],
                                                x[3] * c - x[4] * s, x[3] * s + x[4] * c}));
            EXPECT_NEAR(a[0] * c - a[1] * s, b[0], 1e-14);
            EXPECT_NEAR(a[0] * s + a[1] * c, b[1], 1e-14);
            EXPECT_NEAR(a[2], b[2], 1e-14);
            EXPECT_NEAR(a[3] * c - a[4] * s, b[3], 1e-14);
        }
    }
}

TEST(mirror_spatial, has_the_radial_and_lateral_blocks_of_the_table) {
    for (int law : {original, solvable, level}) {
        const juggler j{.law = law, .kr0 = 0.07, .kr1 = 0.06, .kl0 = 0.09, .kl1 = 0.05};
        const matrix m = jacobian(j, {0.5, 0.0, 0.5, 0.0, 0.0});
        const double T = j.flight(), V = j.speed();
        const double radial = law == solvable ? 2 * V / 0.5
                              : law == level  ? 1.75 * V / 0.5
                                              : 1.75 * V;
        const double lateral = 2 * V / 0.5;
        const double kr1 = law == original ? j.kr1 + T * j.kr0 : j.kr1;
        const double kl1 = law == original ? j.kl1 + T * j.kl0 : j.kl1;
        EXPECT_NEAR(m[2][2], 0.0, 3e-14);  // 1 - 2 B
        EXPECT_NEAR(m[0][0] + m[3][3], 2 - T * radial * j.kr0 - radial * kr1, 5e-14);
        EXPECT_NEAR(m[0][0] * m[3][3] - m[0][3] * m[3][0], 1 + T * radial * j.kr0 - radial * kr1,
                    5e-14);
        EXPECT_NEAR(m[1][1] + m[4][4], 2 - T * lateral * j.kl0 - lateral * kl1, 5e-14);
        EXPECT_NEAR(m[1][1] * m[4][4] - m[1][4] * m[4][1], 1 + T * lateral * j.kl0 - lateral * kl1,
                    5e-14);
        for (int r : {0, 2, 3}) {
            for (int c : {1, 4}) {
                EXPECT_NEAR(m[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)], 0.0,
                            1e-14);
                EXPECT_NEAR(m[static_cast<std::size_t>(c)][static_cast<std::size_t>(r)], 0.0,
                            1e-14);
            }
        }
    }
}

TEST(mirror_spatial, is_stable_inside_the_lateral_triangle_and_not_outside) {
    for (int law : {original, solvable, level}) {
        const auto settles = [&](double position, double rate) {  // T k10' and k11' in units of 2/G
            juggler j{.law = law};
            const double unit = 0.5 / j.speed();
            j.kl0 = position * unit / j.flight();
            j.kl1 = rate * unit - (law == original ? position * unit : 0.0);
            const orbit_answer a = run(j, {0.5, 0.003, 0.502, 0.0, 0.004}, 3000);
            if (a.end != outcome::ok) return false;
            const state x = end_of(a);
            return std::abs(x[0] - 0.5) + std::abs(x[1]) + std::abs(x[3]) + std::abs(x[4]) < 1e-6;
        };
        EXPECT_TRUE(settles(0.3, 0.6)) << law;
        EXPECT_TRUE(settles(0.05, 0.96)) << law;
        EXPECT_FALSE(settles(0.3, 1.05)) << law;
        EXPECT_FALSE(settles(0.5, 0.45)) << law;
        EXPECT_FALSE(settles(-0.05, 0.6)) << law;
    }
}

TEST(mirror_spatial, azimuth_wrap_flips_the_roll) {
    const juggler j{.azimuth = 0.0, .kr1 = 0.0, .kl0 = 0.1, .kl1 = 0.0};
    const state up = end_of(run(j, {-0.5, 1e-9, 0.5, 0.0, 0.0})),
                down = end_of(run(j, {-0.5, -1e-9, 0.5, 0.0, 0.0}));
    EXPECT_NEAR(up[4], -down[4], 1e-7);
    EXPECT_GT(std::abs(up[4]), 0.1);
}

TEST(mirror_spatial, one_return_is_exact_to_a_few_ulp_against_50_digits) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> u(-1, 1);
    int compared = 0;
    for (int i = 0; i < 120; ++i) {
        const juggler j{.law = i % 3, .energy = (i / 3) % 2};
        const state x{0.6 + 0.3 * u(random), 0.3 * u(random), 0.6 + 0.3 * u(random),
                      0.7 * u(random), 0.7 * u(random)};
        const orbit_answer got = run(j, x), truth = run(j, x, 1, false, table().run_mp50);
        ASSERT_EQ(got.end, truth.end) << i;
        if (got.end != outcome::ok) continue;
        ++compared;
        const matrix m = jacobian(j, x);
        for (std::size_t c = 0; c < 5; ++c) {
            double spread = 1;
            for (double d : m[c]) spread += std::abs(d);
            EXPECT_NEAR(number(got.columns[c]), number(truth.columns[c]), 4e-15 * spread) << i;
        }
    }
    EXPECT_GT(compared, 80);
}

TEST(mirror_spatial, derivatives_match_50_digit_central_differences) {
    std::mt19937_64 random(6);
    std::uniform_real_distribution<double> u(-1, 1);
    for (int i = 0; i < 9; ++i) {
        const juggler j{.law = i % 3, .energy = (i / 3) % 2};
        const state x{0.55 + 0.1 * u(random), 0.1 * u(random), 0.55 + 0.1 * u(random),
                      0.2 * u(random), 0.2 * u(random)};
        const orbit_answer got = run(j, x, 1, true, table().run_mp50);
        ASSERT_EQ(got.end, outcome::ok);
        const real50 step("1e-18");
        for (std::size_t c = 0; c < 5; ++c) {
            std::vector<std::string> up = written(x), down = up;
            const real50 centre = parse_real<real50>(up[c]);
            up[c] = print_real(centre + step);
            down[c] = print_real(centre - step);
            const orbit_answer a = run_texts(j, up, 1, false, table().run_mp50);
            const orbit_answer b = run_texts(j, down, 1, false, table().run_mp50);
            for (std::size_t r = 0; r < 5; ++r) {
                const double slope = to_double(
                    (parse_real<real50>(a.columns[r]) - parse_real<real50>(b.columns[r])) /
                    (step + step));
                EXPECT_NEAR(number(got.derivative[5 * r + c]), slope,
                            1e-14 * (1 + std::abs(slope)));
            }
        }
    }
}

}  // namespace
}  // namespace hopscotch
