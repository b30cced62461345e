// The simplified maps of Raibert's hopper: the Ricker map's cascade and exponents, the linear
// spring's fixed points (models/raibert_hopper.md, sections 5, 6 and 9).
#include "tests/models/named_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace hopscotch {
namespace {

using namespace testing_models;

named_map ricker(double gain, double energy = 1.0) {
    return {"raibert_pneumatic_simple", "energy", {{"gain", gain}, {"energy", energy}}};
}

TEST(raibert_regimes, ricker_cascade_has_the_printed_parameters_and_first_ratios) {
    double bounds[4] = {std::exp(2.0), 0.0, 0.0, 0.0};
    const double printed[] = {7.38905609893, 12.50924193, 14.24424927};
    for (int k = 0; k < 3; ++k) {
        const auto period = static_cast<std::uint32_t>(1 << k);
        const named_map near = periodic_point(ricker(printed[k] - 1e-3).after(5000), period);
        const named_map flip = point_with_multiplier(near, "gain", -1.0, period);
        bounds[k] = flip.value("gain");
        EXPECT_NEAR(bounds[k], printed[k], 6e-9 * printed[k]);
    }
    const named_map near = periodic_point(ricker(14.651).after(9000), 8);
    bounds[3] = point_with_multiplier(near, "gain", -1.0, 8).value("gain");
    EXPECT_NEAR((bounds[1] - bounds[0]) / (bounds[2] - bounds[1]), 2.95, 6e-3);
    EXPECT_NEAR((bounds[2] - bounds[1]) / (bounds[3] - bounds[2]), 4.25, 6e-3);
}

TEST(raibert_regimes, ricker_exponent_is_the_mean_of_ln_of_1_minus_e) {
    for (const double gain : {20.0, 30.0}) {
        named_map m = ricker(gain).after(100);
        double by_slope = 0.0, by_formula = 0.0;
        const double first = m.start[0];
        const int n = 5000;
        for (int i = 0; i < n; ++i) {
            const map_image f = m.image();
            by_slope += std::log(std::abs(f.jacobian(0, 0)));
            by_formula += std::log(std::abs(1.0 - m.start[0]));
            m.start = f.state;
        }
        // ln|f'| = ln|1 - E| + ln(E' / E): the rest telescopes
        EXPECT_NEAR(by_slope, by_formula + std::log(m.start[0] / first), 1e-9);
    }
}

TEST(raibert_regimes,
     ricker_attractor_lies_between_the_second_and_first_image_of_the_critical_point) {
    for (const double gain : {9.0, 14.5, 16.0, 22.0}) {
        const double high = ricker(gain).image().to[0];
        const double low = ricker(gain).image(2).to[0];
        EXPECT_NEAR(high, gain / std::exp(1.0), 1e-14 * gain);
        named_map m = ricker(gain, 0.7).after(200);
        for (int i = 0; i < 500; ++i) {
            m = m.after(1);
            EXPECT_LE(m.start[0], high * (1 + 1e-14));
            EXPECT_GE(m.start[0], low * (1 - 1e-14));
        }
    }
}

TEST(raibert_regimes, large_gains_recover_from_tiny_energies_in_about_six_hops) {
    named_map m = ricker(100.0);
    double least = 1.0;
    for (int i = 0; i < 2; ++i) m = m.after(1), least = std::min(least, m.start[0]);
    EXPECT_NEAR(least, 3.9e-13, 6e-15);
    int hops = 0;
    while (m.start[0] < 0.1 && hops < 50) m = m.after(1), ++hops;
    EXPECT_EQ(hops, 6);
}

struct linear {  // lin0 in the page's numbers
    double w, b, tau, delta;
    double z() const { return 2 * w * b * delta; }
    double moved() const { return tau / (4 * w * w * b * b) * (z() + std::expm1(-z())); }
    double velocity() const { return -tau / (2 * w * b) * std::expm1(-z()); }
    double q() const { return std::sqrt(1 + b * b); }
    double psi() const { return w * q() * moved() + b * velocity() / q(); }
    double psi_rate() const { return velocity() / q(); }
};

TEST(raibert_regimes, thrust_vector_of_the_corrected_equation_24_obeys_lemma_6) {
    for (const double delta : {0.01, 0.05, 0.2}) {
        const linear h{20.0, 0.2, 1.0, delta};
        EXPECT_LT(h.moved() / h.velocity(), delta);  // for every delta > 0
        EXPECT_NEAR(h.moved() / h.velocity(), 0.5 * delta * (1 + h.z() / 6), 0.01 * delta * h.z());
    }
    // Corollary 8 at Fig. 2: the first condition holds, the second does not
    EXPECT_NEAR(2 * 0.2 * std::exp(0.2 * M_PI), 0.74978, 6e-6);
    EXPECT_NEAR(0.2 / (1.04 * 20.0), 0.0096154, 6e-8);
    EXPECT_LT(0.0096154, 0.01);
}

TEST(raibert_regimes, fixed_points_of_the_linear_map_never_double_their_period) {
    // page, section 5: a fixed point that is valid in the exact sense has a multiplier > -2/e
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int valid = 0;
    double least = 1.0;
    for (int i = 0; i < 300; ++i) {
        const linear h{5 + 30 * unit(random), 0.02 + 0.6 * unit(random), 1.0 + 20 * unit(random),
                       0.005 + 0.3 * unit(random) * unit(random)};
        named_map m(
            "raibert_linear_simple", "bottom",
            {{"frequency", h.w}, {"damping", h.b}, {"thrust", h.tau}, {"thrust_time", h.delta}});
        m.start[0] = 1.0;
        m = m.after(400);
        const map_image f = m.image();
        if (std::abs(f.to[0] - m.start[0]) > 1e-9 * m.start[0]) continue;
        const bool is_valid = std::sqrt(m.start[0]) > h.psi() - h.b * h.psi_rate();
        if (!is_valid) continue;
        ++valid;
        least = std::min(least, f.jacobian(0, 0));
    }
    EXPECT_GT(valid, 150);
    EXPECT_GT(least, -2 / std::exp(1.0));
}

}  // namespace
}  // namespace hopscotch
