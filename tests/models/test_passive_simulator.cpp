// Random orbits of every variant against the tests' own 50-digit simulator: same outcome, lift-off
// speed, time, loss and bounces, as far as the start's rounding decides them.
#include "tests/models/passive_rows.hpp"
#include "tests/models/passive_truth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace hopscotch {
namespace {

using namespace passive_truth;
using passive_rows::single_return;

class dice {
public:
    explicit dice(std::uint64_t seed) : bits_(seed) {}
    double uniform(double low, double high) {
        return low + (high - low) * std::ldexp(static_cast<double>(bits_() >> 11), -53);
    }
    double logarithmic(double low, double high) {
        return std::exp(uniform(std::log(low), std::log(high)));
    }

private:
    std::mt19937_64 bits_;
};

struct sensitive_truth {
    history past;
    double speed_slope = 0.0;  // per relative change of the start
    double time_slope = 0.0;
    double loss_slope = 0.0;
};

/// The truth of an orbit and what a relative change of its start does to it.
template <class Orbit>
sensitive_truth with_slopes(const Orbit& orbit) {
    const double change = 1e-18;
    sensitive_truth result{orbit(0.0)};
    const history moved = orbit(change);
    const auto slope = [&](const real50& a, const real50& b) {
        return std::abs(to_double(a - b)) / change;
    };
    result.speed_slope = slope(moved.speed, result.past.speed);
    result.time_slope = slope(moved.time, result.past.time);
    result.loss_slope = slope(moved.loss, result.past.loss);
    return result;
}

/// \param rounding  relative backward error granted: a few dozen operations per impact
void expect_same(const single_return& got, const sensitive_truth& truth, double rounding,
                 bool compares_bounces, const std::string& where) {
    const history& want = truth.past;
    const double speed_room = rounding * (to_double(want.speed) + truth.speed_slope + 10.0);
    // a start on the edge of stuck or of another bounce is not decided by doubles
    if (speed_room > 1e-4) return;
    ASSERT_EQ(got.end, want.lifts ? outcome::ok : outcome::stuck) << where;
    EXPECT_NEAR(got.loss, to_double(want.loss),
                rounding * (to_double(want.loss) + truth.loss_slope + 10.0))
        << where;
    if (!want.lifts) return;
    EXPECT_NEAR(got.speed, to_double(want.speed), speed_room) << where;
    EXPECT_NEAR(got.time, to_double(want.time),
                rounding * (to_double(want.time) + truth.time_slope + 10.0))
        << where;
    if (compares_bounces) EXPECT_EQ(got.bounces, want.impacts - 1.0) << where;
}

void compare_lift_offs(int n, std::uint64_t seed, double most_restitution, double most_damping,
                       double rounding) {
    dice random(seed);
    for (int i = 0; i < n; ++i) {
        const double alpha = random.uniform(0.2, 13.0);
        const double mass_ratio = random.logarithmic(0.02, 30.0);
        const double restitution =
            most_restitution > 0.0 ? random.uniform(0.02, most_restitution) : 0.0;
        const double damping = most_damping > 0.0 ? random.logarithmic(1e-4, most_damping) : 0.0;
        if (damping > 0.0 && alpha < 2.5 * damping) continue;  // not a lift-off: F would fall
        const simulator hopper(
            {.mass_ratio = mass_ratio, .restitution = restitution, .damping = damping});
        const sensitive_truth truth = with_slopes([&](double change) {
            return hopper.from_lift_off(real50(alpha) * (real50(1.0) + change));
        });
        const single_return got = passive_rows::hop(alpha, mass_ratio, restitution, damping);
        expect_same(got, truth, rounding, restitution == 0.0,
                    "alpha " + std::to_string(alpha) + " M " + std::to_string(mass_ratio) + " e " +
                        std::to_string(restitution) + " zeta " + std::to_string(damping));
    }
}

void compare_flights(int n, std::uint64_t seed, double most_restitution, double most_damping,
                     double rounding) {
    dice random(seed);
    for (int i = 0; i < n; ++i) {
        const double mass_ratio = random.logarithmic(0.05, 20.0);
        const double restitution =
            most_restitution > 0.0 ? random.uniform(0.02, most_restitution) : 0.0;
        const double damping = most_damping > 0.0 ? random.logarithmic(1e-4, most_damping) : 0.0;
        const double y1 = random.uniform(-5.0, 8.0);
        const double v1 = random.uniform(-6.0, 6.0);
        const double y2 = random.logarithmic(1e-3, 6.0);
        const double v2 = random.uniform(-4.0, 4.0);
        const simulator hopper(
            {.mass_ratio = mass_ratio, .restitution = restitution, .damping = damping});
        const sensitive_truth truth = with_slopes([&](double change) {
            motion from = hopper.hopper_state(y1, v1, y2, v2);
            from.gap *= real50(1.0) + change;
            from.spring_rate += real50(change);
            return hopper.next_lift_off(from, passive_truth::launch::free);
        });
        const single_return got =
            passive_rows::start(y1, v1, y2, v2, mass_ratio, restitution, damping);
        expect_same(got, truth, rounding, restitution == 0.0,
                    "state " + std::to_string(y1) + " " + std::to_string(v1) + " " +
                        std::to_string(y2) + " " + std::to_string(v2) + " M " +
                        std::to_string(mass_ratio) + " e " + std::to_string(restitution) +
                        " zeta " + std::to_string(damping));
    }
}

// Rounding granted: 2e-15 for plastic hops (measured errors stay below 5e-16), more where a hundred
// impacts follow one another or exp() enters: all far below 1e-11.
TEST(passive_simulator, plastic_hops_agree) { compare_lift_offs(24, 101, 0.0, 0.0, 2e-15); }
TEST(passive_simulator, plastic_flights_agree) { compare_flights(18, 102, 0.0, 0.0, 4e-15); }
TEST(passive_simulator, elastic_hops_agree) { compare_lift_offs(8, 103, 0.6, 0.0, 2e-14); }
TEST(passive_simulator, elastic_flights_agree) { compare_flights(8, 104, 0.6, 0.0, 2e-14); }
TEST(passive_simulator, damped_hops_agree) { compare_lift_offs(14, 105, 0.0, 0.5, 2e-14); }
TEST(passive_simulator, damped_flights_agree) { compare_flights(10, 106, 0.0, 0.5, 2e-14); }
TEST(passive_simulator, damped_elastic_hops_agree) { compare_lift_offs(6, 107, 0.5, 0.3, 2e-14); }

TEST(passive_simulator, slow_plastic_hops_agree_on_many_starts) {
    compare_lift_offs(120, 201, 0.0, 0.0, 2e-15);
    compare_flights(80, 202, 0.0, 0.0, 4e-15);
}
TEST(passive_simulator, slow_elastic_and_damped_hops_agree_on_many_starts) {
    compare_lift_offs(30, 203, 0.7, 0.0, 2e-14);
    compare_lift_offs(50, 205, 0.0, 0.9, 2e-14);
    compare_flights(25, 206, 0.5, 0.5, 2e-14);
}

TEST(passive_simulator, unbounded_mass_ratio_agrees) {
    const simulator juggler({.is_unbounded = true});
    dice random(9);
    for (int i = 0; i < 12; ++i) {
        const double w1 = random.uniform(-1.0, 5.0);
        const double w1dot = random.uniform(-4.0, 5.0);
        const double w2 = w1 - random.uniform(0.01, 4.0);
        const double w2dot = random.uniform(-4.0, 4.0);
        // enough oscillation to throw, not the endless bouncing windows
        const double amplitude = std::sqrt((w2 + 1.0) * (w2 + 1.0) + w2dot * w2dot);
        const double alpha = std::sqrt(std::max(amplitude * amplitude - 1.0, 0.0));
        if (alpha > 3.1 && alpha < 3.8) continue;
        if (alpha > 6.2 && alpha < 6.7) continue;
        if (amplitude < 1.05) continue;
        const sensitive_truth truth = with_slopes([&](double change) {
            return juggler.next_lift_off(
                {real50(w2) + 1.0, real50(w2dot) + change, real50(w1) - w2, real50(w1dot) - w2dot},
                passive_truth::launch::free);
        });
        const auto one =
            passive_rows::run({.model = "passive_juggler",
                               .section = passive_rows::flight,
                               .columns = {{w1}, {w1dot}, {w2}, {w2dot}},
                               .mass_ratio = {std::numeric_limits<double>::infinity()}});
        expect_same({one.end[0], one.speed[0], one.bounces[0], one.loss[0], one.time[0]}, truth,
                    1e-14, true,
                    std::to_string(w1) + " " + std::to_string(w1dot) + " " + std::to_string(w2) +
                        " " + std::to_string(w2dot));
    }
}

}  // namespace
}  // namespace hopscotch
