// The passive hopper with nonlinear terms: the exact map as their limit, Runge-Kutta in the
// original coordinates, the equivalence with the juggler (models/passive_hopper.md, section 6).
#include "tests/models/nonlinear_hoppers.hpp"

#include "analysis/truth/decimal.hpp"
#include "analysis/truth/real50.hpp"
#include "tests/models/nonlinear_rows.hpp"
#include "tests/models/passive_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace hopscotch {
namespace {

using namespace nonlinear_rows;
using namespace testing_models::nonlinear_hoppers;

double distance(const std::string& a, const std::string& b) {
    return std::abs(to_double(parse_real<real50>(a) - parse_real<real50>(b)));
}

// ---- the exact map as limit

struct limit_case {
    terms of;
    int exact_variant;
    double alpha;
};

TEST(passive_nonlinear, without_its_terms_is_the_exact_map_to_35_digits) {
    const limit_case cases[] = {
        {{.mass_ratio = 1.0}, passive_rows::plastic, 4.6},
        {{.mass_ratio = 1.0}, passive_rows::plastic, 4.4},
        {{.mass_ratio = 20.0}, passive_rows::plastic, 6.6},
        {{.mass_ratio = 0.05}, passive_rows::plastic, 11.3},
        {{.mass_ratio = 100.0}, passive_rows::plastic, 3.4},
        {{.mass_ratio = 1e-3}, passive_rows::plastic, 7.3},
        {{.mass_ratio = 1.0, .increment = 0.03}, passive_rows::plastic, 4.5},
        {{.mass_ratio = 0.3, .damping = 0.02}, passive_rows::damped, 5.0},
        {{.mass_ratio = 2.0, .restitution = 0.3, .damping = 0.02}, passive_rows::damped, 6.7},
    };
    for (const limit_case& c : cases) {
        start from{.columns = {text(c.alpha)}, .of = c.of, .returns = 2};
        const orbit_answer integrated = in_50_digits(from);
        from.variant = c.exact_variant;
        const orbit_answer exact = in_50_digits(from);
        ASSERT_EQ(integrated.end, exact.end) << c.alpha;
        EXPECT_EQ(integrated.events, exact.events) << c.alpha;
        EXPECT_EQ(integrated.extras[0], exact.extras[0]) << c.alpha;
        EXPECT_LT(distance(integrated.columns[0], exact.columns[0]), 1e-35) << c.alpha;
        EXPECT_LT(distance(integrated.time, exact.time), 1e-33) << c.alpha;
        EXPECT_LT(distance(integrated.extras[1], exact.extras[1]), 1e-33) << c.alpha;
    }
}

/// With rebounds chatter ends where `chatter_speed` says, so that less is left to agree.
TEST(passive_nonlinear, without_its_terms_rebounds_like_the_exact_map) {
    start from{.columns = {"4.1"}, .of = {.mass_ratio = 0.5, .restitution = 0.4}};
    const orbit_answer integrated = in_50_digits(from);
    from.variant = passive_rows::elastic;
    const orbit_answer exact = in_50_digits(from);
    EXPECT_EQ(integrated.events, exact.events);
    EXPECT_EQ(integrated.extras[0], exact.extras[0]);
    EXPECT_LT(distance(integrated.columns[0], exact.columns[0]), 1e-30);
}

TEST(passive_nonlinear, flight_starts_without_its_terms_are_those_of_the_exact_map) {
    random_hoppers random(5);
    for (int i = 0; i < 40; ++i) {
        start from{.section = 1};
        from.of.mass_ratio = std::pow(10.0, random.between(-1.0, 1.0));
        const bool on_ground = i % 3 == 0;
        from.columns = {text(random.between(-3.0, 3.0)), text(random.between(-3.0, 3.0)),
                        on_ground ? "0" : text(random.between(0.0, 3.0)),
                        i % 6 == 0 ? "0" : text(random.between(-3.0, 3.0))};
        const orbit_answer integrated = in_double(from);
        from.variant = passive_rows::plastic;
        const orbit_answer exact = in_double(from);
        ASSERT_EQ(integrated.end, exact.end) << i;
        EXPECT_EQ(integrated.events, exact.events) << i;
        if (exact.end != outcome::ok) continue;
        EXPECT_NEAR(number(integrated.columns[0]), number(exact.columns[0]), 2e-10) << i;
        EXPECT_NEAR(number(integrated.extras[1]), number(exact.extras[1]), 2e-10) << i;
    }
}

TEST(passive_nonlinear, departs_from_the_exact_map_in_proportion_to_each_term) {
    const double exact = passive_rows::hop(4.7, 1.0).speed;
    for (double terms::*const term : {&terms::quadratic, &terms::cubic, &terms::gradient}) {
        terms small;
        small.*term = 1e-7;
        terms smaller;
        smaller.*term = 1e-8;
        const double ratio = (hop_speed(4.7, small) - exact) / (hop_speed(4.7, smaller) - exact);
        EXPECT_NEAR(ratio, 10.0, 0.01);
    }
}

struct state {
    double y1, v1, y2, v2;
};

/// The page's equations as they stand, by classical Runge-Kutta.
class original {
public:
    explicit original(const terms& of) : of_(of) {}

    double force(const state& x) const {
        const double s = x.y1 - x.y2;
        return s + of_.quadratic * s * s + of_.cubic * s * s * s +
               2.0 * of_.damping * (x.v1 - x.v2);
    }
    double gravity(double y) const { return 1.0 + of_.gradient * y; }

    state rate(const state& x, bool grounded) const {
        const double total = 1.0 + of_.mass_ratio;
        const double f = force(x);
        return {x.v1, (-of_.mass_ratio * f - gravity(x.y1)) / total, x.v2,
                grounded ? 0.0 : (f - gravity(x.y2)) / total};
    }
    state advanced(const state& x, double h, bool grounded) const {
        const auto at = [](const state& a, const state& k, double f) {
            return state{a.y1 + f * k.y1, a.v1 + f * k.v1, a.y2 + f * k.y2, a.v2 + f * k.v2};
        };
        const state a = rate(x, grounded);
        const state b = rate(at(x, a, h / 2), grounded);
        const state c = rate(at(x, b, h / 2), grounded);
        const state d = rate(at(x, c, h), grounded);
        return {x.y1 + h / 6 * (a.y1 + 2 * b.y1 + 2 * c.y1 + d.y1),
                x.v1 + h / 6 * (a.v1 + 2 * b.v1 + 2 * c.v1 + d.v1),
                x.y2 + h / 6 * (a.y2 + 2 * b.y2 + 2 * c.y2 + d.y2),
                x.v2 + h / 6 * (a.v2 + 2 * b.v2 + 2 * c.v2 + d.v2)};
    }

    /// From a state in the air to the next lift-off after sustained contact (plastic impacts);
    /// negative where there is none within the time.
    double next_lift_off(state x, double& time) const {
        constexpr double full = 1e-3;
        bool grounded = false;
        while (time < 300.0) {
            const state next = advanced(x, full, grounded);
            const auto happened = [&](const state& y) {
                return grounded ? force(y) > 1.0 : y.y2 < 0.0;
            };
            if (!happened(next)) {
                x = next;
                time += full;
                continue;
            }
            double low = 0.0, high = full;
            for (int i = 0; i < 60; ++i) {
                const double middle = 0.5 * (low + high);
                (happened(advanced(x, middle, grounded)) ? high : low) = middle;
            }
            x = advanced(x, high, grounded);
            time += high;
            if (grounded) return x.v1;
            x.y2 = x.v2 = 0.0;
            grounded = force(x) <= 1.0;
        }
        return -1.0;
    }

private:
    terms of_;
};

TEST(passive_nonlinear, agrees_with_runge_kutta_in_the_original_coordinates) {
    random_hoppers random(6);
    int compared = 0;
    for (int i = 0; i < 30; ++i) {
        terms of = random.mild();
        if (i % 2 == 1) of.damping = random.between(0.0, 0.05);
        const state from{random.between(0.0, 6.0), random.between(-3.0, 5.0),
                         random.between(0.2, 4.0), random.between(-2.0, 2.0)};
        const orbit_answer answer =
            in_double({.section = 1,
                       .columns = {text(from.y1), text(from.v1), text(from.y2), text(from.v2)},
                       .of = of});
        double time = 0.0;
        const double speed = original(of).next_lift_off(from, time);
        EXPECT_EQ(answer.end == outcome::ok, speed > 0.0) << i;
        if (answer.end != outcome::ok) continue;
        // Runge-Kutta: (1e-3)^4 per unit of time, and what bounces amplify
        EXPECT_NEAR(number(answer.columns[0]), speed, 1e-8) << i;
        EXPECT_NEAR(number(answer.time), time, 1e-8) << i;
        ++compared;
    }
    EXPECT_GT(compared, 15);
}

TEST(passive_nonlinear, keeps_the_equivalence_of_hopper_and_juggler_on_a_nonlinear_spring) {
    random_hoppers random(7);
    for (int i = 0; i < 20; ++i) {
        terms of = random.mild();
        of.gradient = 0.0;
        of.restitution = i % 2 == 0 ? 0.0 : 0.3;
        const double m = of.mass_ratio;
        const state h{random.between(-1.0, 6.0), random.between(-3.0, 5.0),
                      random.between(0.2, 4.0), random.between(-2.0, 2.0)};
        const orbit_answer hopper = in_double(
            {.section = 1, .columns = {text(h.y1), text(h.v1), text(h.y2), text(h.v2)}, .of = of});
        const orbit_answer juggler =
            in_double({.model = "passive_juggler",
                       .section = 1,
                       .columns = {text(h.y1 - 1.0 + m * h.y2), text(h.v1 + m * h.v2),
                                   text(h.y1 - 1.0 - h.y2), text(h.v1 - h.v2)},
                       .of = of});
        ASSERT_EQ(juggler.end, hopper.end) << i;
        EXPECT_EQ(juggler.events, hopper.events) << i;
        if (hopper.end != outcome::ok) continue;
        EXPECT_NEAR(number(juggler.columns[0]), number(hopper.columns[0]), 1e-10) << i;
        EXPECT_NEAR(number(juggler.time), number(hopper.time), 1e-9) << i;
    }
}

}  // namespace
}  // namespace hopscotch
