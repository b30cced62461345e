// The passive hopper with energy added at every lift-off, beyond the onset of period two: curvature
// at the onset, period two and its end, the basin's width and the crisis (models/passive_hopper.md,
// section 5 and the rows of section 10 about Fig. 8).
#include "tests/models/named_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hopscotch {
namespace {

using namespace testing_models;

constexpr double lossless_1 = 4.493409457909064;
constexpr double critical_increment = 0.0715873841;
constexpr double critical_speed = 4.5417632729;

named_map hopper(double increment, double speed, double mass_ratio = 1.0) {
    return {"passive_hopper",
            "liftoff",
            {{"mass_ratio", mass_ratio}, {"speed_increment", increment}, {"liftoff_speed", speed}}};
}
double image_of(double increment, double speed) { return hopper(increment, speed).image().to[0]; }

/// Fixed points left and right of the lossless speed, the hump between, and the right edge of the
/// interval that the map sends into itself.
struct hump {
    double repelling, place, height, edge;
    double width() const { return edge - repelling; }
};
hump hump_at(double increment) {
    const auto bisect = [](double low, double high, const auto& is_low) {
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            (is_low(middle) ? low : high) = middle;
        }
        return 0.5 * (low + high);
    };
    hump h{};
    h.repelling = bisect(4.3, lossless_1, [&](double a) { return image_of(increment, a) < a; });
    h.place = bisect(lossless_1 + 1e-9, 4.6,
                     [&](double a) { return hopper(increment, a).image().jacobian(0, 0) > 0; });
    h.height = image_of(increment, h.place);
    h.edge = bisect(h.place, 4.9, [&](double a) { return image_of(increment, a) > h.repelling; });
    return h;
}

TEST(passive_injection, schwarzian_at_the_onset_is_minus_511) {
    // so that the doubling there is supercritical; h and the start are multiples of 2^-30, and the
    // truth is the model in 50 digits
    const double h = 0x1p-18;
    const double start = std::round(critical_speed * 0x1p30) * 0x1p-30;
    const auto f = [&](int k) {
        return real50(
            hopper(critical_increment, start + k * h).answer(1, digits::fifty).columns[0]);
    };
    const real50 slope = (f(1) - f(-1)) / (2 * h);
    const real50 bend = (f(1) - f(0) * 2.0 + f(-1)) / (h * h);
    const real50 third = (f(2) - f(1) * 2.0 + f(-1) * 2.0 - f(-2)) / (2 * h * h * h);
    const real50 ratio = bend / slope;
    EXPECT_NEAR(to_double(slope), -1.0, 1e-6);
    EXPECT_NEAR(to_double(third / slope - ratio * ratio * 1.5), -511.0, 0.6);
}

TEST(passive_injection, period_two_lives_to_about_0_11_and_gives_way_to_chaos) {
    for (const double increment : {0.08, 0.1, 0.107}) {
        const named_map pair = periodic_point(hopper(increment, 4.54).after(4000), 2);
        EXPECT_GT(std::abs(image_of(increment, pair.start[0]) - pair.start[0]), 1e-2) << increment;
        EXPECT_LT(largest_multiplier_modulus(pair, 2), 1.0) << increment;
    }
    // its own doubling, by bisection along the cycle; "to about 0.11"
    named_map calm = periodic_point(hopper(0.105, 4.4974), 2);
    double low = 0.105, high = 0.12;
    for (int i = 0; i < 20; ++i) {
        const double middle = i < 4 ? low + 2e-3 : 0.5 * (low + high);  // short steps first
        const named_map there = periodic_point(calm.with("speed_increment", middle), 2);
        if (largest_multiplier(there, 2) > -1.0) {
            calm = there;
            low = middle;
        } else {
            high = middle;
        }
    }
    EXPECT_NEAR(low, 0.11, 5e-3);
    EXPECT_NEAR(largest_multiplier(calm, 2), -1.0, 1e-2);
    // "then chaotic bands": the mean of ln|f'| over 5000 hops is positive
    named_map m = hopper(0.135, 4.54).after(200);
    double sum = 0.0;
    for (int i = 0; i < 5000; ++i) {
        const map_image f = m.image();
        sum += std::log(std::abs(f.jacobian(0, 0)));
        m.start = f.state;
    }
    EXPECT_GT(sum / 5000, 0.1);
}

TEST(passive_injection, crisis_is_where_the_humps_top_meets_the_basins_edge) {
    const auto room = [](double increment) {
        const hump h = hump_at(increment);
        return h.edge - h.height;
    };
    double before = 0.12, after = 0.16;
    ASSERT_GT(room(before), 0.0);
    ASSERT_LT(room(after), 0.0);
    for (int i = 0; i < 30; ++i) {
        const double middle = 0.5 * (before + after);
        (room(middle) > 0.0 ? before : after) = middle;
    }
    EXPECT_NEAR(before, 0.1388, 6e-5);
    // before it orbits stay for ever, after it they leave
    const hump h = hump_at(before);
    EXPECT_EQ(hopper(before - 1e-4, h.place).answer(20000).end, outcome::ok);
    EXPECT_GT(std::stod(hopper(before - 1e-4, h.place).answer(20000).columns[0]), h.repelling);
    const orbit_answer gone = hopper(before + 2e-3, h.place).answer(20000);
    EXPECT_TRUE(gone.end != outcome::ok || std::stod(gone.columns[0]) < h.repelling);
}

TEST(passive_injection, basin_of_the_interval_keeps_growing_beyond_the_onset) {
    // row "local basin largest at f' = -1": of the fixed point; the interval grows on, its
    // attractor doubles
    double last = 0.0;
    for (const double increment : {1e-3, 1e-2, 0.04, critical_increment, 0.1, 0.13}) {
        const double width = hump_at(increment).width();
        EXPECT_GT(width, last) << increment;
        last = width;
    }
    EXPECT_NEAR(hump_at(critical_increment).width(), 0.107558, 6e-7);
    // row "infinitesimal eps": the width tends to r_1(1) = 0.0159187 and not to 0
    const double tiny = hump_at(1e-8).width();
    EXPECT_GT(tiny, 0.0159187);
    EXPECT_LT(tiny, 0.0159187 + 1e-3);
}

TEST(passive_injection, branches_of_extreme_mass_ratios_never_double) {
    // M = 0.05 and 20, k = 1, 2: the slope of the branch [alpha*_k, (k + 1) pi] stays above -1
    const double lossless[] = {lossless_1, 7.725251836937707};
    for (const double mass_ratio : {0.05, 20.0}) {
        for (int k = 1; k <= 2; ++k) {
            const double low = lossless[k - 1];
            const double high = (k + 1) * M_PI;
            for (int i = 0; i < 400; ++i) {
                const double speed = low + (high - low) * (i + 0.5) / 400;
                EXPECT_GT(hopper(0.0, speed, mass_ratio).image().jacobian(0, 0), -1.0)
                    << mass_ratio << " " << speed;
            }
        }
    }
    EXPECT_LT(hopper(0.0, critical_speed + 1e-3).image().jacobian(0, 0), -1.0);  // M = 1 passes it
}

}  // namespace
}  // namespace hopscotch
