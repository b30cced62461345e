// The spring-mass runner's folds, flips, gaps and chaos: the rows of its page's table beyond single
// strides, and its invariants (models/slip.md, sections 4, 5, 11, 13).
#include "tests/models/named_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hopscotch {
namespace {

using namespace testing_models;
using choices = named_map::choices;

const choices linear_off{{"stance_gravity", "off"}};
const choices air_off{{"spring", "air"}, {"stance_gravity", "off"}};
const choices linear_on{};
const choices air_on{{"spring", "air"}};

named_map runner(double leg, double stiffness, double beta, double speed, double angle,
                 const choices& options) {
    return named_map("slip", "touchdown",
                     {{"leg_length", leg},
                      {"stiffness", stiffness},
                      {"touchdown_angle", beta},
                      {"speed", speed},
                      {"angle", angle}},
                     options)
        .in({"angle"});
}
/// In the three numbers of the map: leg, mass and speed are 1.
named_map by_numbers(double beta, double stiffness, double gravity, double angle,
                     const choices& options) {
    return runner(1.0, stiffness, beta, 1.0, angle, options).with("gravity", gravity);
}
double angle_of(const named_map& m) { return m.start[1]; }
named_map figure_12(double speed, double angle = 0.3) {
    return runner(0.173, 0.01839, 0.961, speed, angle, air_off);
}
named_map figure_9(double speed, double angle = 0.3) {
    return runner(1.5, 10.0, M_PI / 4, speed, angle, linear_off);
}

void expect_fold(const named_map& near, std::string_view knob, double expected, double digit) {
    const named_map fold = point_with_multiplier(near, knob, 1.0);
    EXPECT_NEAR(fold.value(knob), expected, digit) << angle_of(fold);
    EXPECT_NEAR(largest_multiplier(fold), 1.0, 1e-6);
    EXPECT_GT(angle_of(fold), 0.0);
}

// ------------------------------------------------------------- saddle-nodes (page, section 11)

TEST(slip_folds, saddle_nodes_without_gravity_in_stance_are_folds) {
    expect_fold(runner(1.5, 100.0, 1.25, 4.2325, 0.4, linear_off), "speed", 4.2325, 6e-5);
    expect_fold(runner(1.5, 50.0, 0.8, 8.139, 0.3, linear_off), "speed", 8.13883, 6e-6);
    expect_fold(figure_12(1.512797, 0.4), "speed", 1.512797, 6e-7);
    expect_fold(runner(1.5, 100.0, 1.0, 8.2687, 0.35, linear_off), "speed", 8.2687, 6e-5);
}

TEST(slip_folds, saddle_nodes_with_gravity_in_stance_are_folds) {
    expect_fold(runner(1.5, 100.0, 1.0, 7.1153, 0.3, linear_on), "speed", 7.1153, 6e-5);
    expect_fold(runner(0.17, 0.03839, 0.961, 1.60381, 0.35, air_on), "speed", 1.60381, 6e-6);
}

TEST(slip_folds, fold_of_figure_14_moves_to_harder_springs_and_ends_at_the_border) {
    named_map near = by_numbers(1.25, 12.653, 0.01, 0.45, linear_on);
    const std::pair<double, double> rows[] = {
        {0.01, 12.653}, {0.1, 13.499}, {0.25, 14.960}, {0.5, 17.568}};
    for (const auto& [gravity, stiffness] : rows) {
        near = point_with_multiplier(near.with("gravity", gravity), "stiffness", 1.0);
        EXPECT_NEAR(near.value("stiffness"), stiffness, 6e-4) << gravity;
    }
    double last = angle_of(near);
    for (const double gravity : {0.6, 0.7, 0.8, 0.85, 0.9, 0.92, 0.94, 0.95}) {
        near = point_with_multiplier(near.with("gravity", gravity), "stiffness", 1.0);
        EXPECT_LT(angle_of(near), last) << gravity;
        last = angle_of(near);
    }
    // the fold reaches angle 0 just above 0.95
    EXPECT_GT(last, 0.0);
    EXPECT_LT(last, 0.05);
}

TEST(slip_folds, upper_branch_ends_where_kinetic_energy_reaches_zero_length) {
    // v = eta0 sqrt(k / m), kt = 1: 10.6066 for k = 50, 4.743 for 10, 15 for 100
    const std::pair<double, double> rows[] = {{50.0, 10.6066}, {10.0, 4.743}, {100.0, 15.0}};
    for (const auto& [stiffness, speed] : rows) {
        EXPECT_NEAR(1.5 * std::sqrt(stiffness), speed, 6e-4);
        const double beta = 0.8;
        const auto least_sweep = [&](double at) {
            double least = 10.0;
            for (double alpha = 1e-6; alpha < 0.1; alpha *= 1.5) {
                const orbit_answer a =
                    runner(1.5, stiffness, beta, at, beta - alpha, linear_off).answer();
                least = std::min(least, std::stod(a.extras[0]));
            }
            return least;
        };
        const double end = 1.5 * std::sqrt(stiffness);
        EXPECT_LT(least_sweep(end * 0.999), M_PI - 2 * beta) << stiffness;
        EXPECT_GT(least_sweep(end * 1.001), M_PI - 2 * beta) << stiffness;
    }
}

TEST(slip_folds, sweep_at_the_change_of_type_is_largest_at_2_1141) {
    const auto sweep = [](double stiffness, double alpha) {
        return std::stod(
            by_numbers(0.6, stiffness, 0.1, 0.6 - alpha, linear_off).answer().extras[0]);
    };
    double largest = 0.0;
    double place = 0.0;
    for (double alpha = 1e-3; alpha < 1.0; alpha += 1e-3) {
        const double here = sweep(1.0, alpha);
        if (here > largest) largest = here, place = alpha;
    }
    EXPECT_NEAR(largest, 2.1141, 6e-5);
    EXPECT_GT(place, 1e-3);
    EXPECT_NEAR(sweep(1.0, 1e-9), 2 * M_PI / 3, 1e-4);
    EXPECT_NEAR(0.5 * (M_PI - largest), 0.5137, 6e-5);  // least beta with a saddle-node at kt > 1
    // just below kt = 1 a minimum and a maximum, well below it none
    const auto turns = [&](double stiffness) {
        int n = 0;
        double before = sweep(stiffness, 1e-5);
        int direction = -1;
        for (double alpha = 1.1e-5; alpha < 1.0; alpha *= 1.1) {
            const double here = sweep(stiffness, alpha);
            if ((here > before) == (direction < 0)) ++n, direction = -direction;
            before = here;
        }
        return n;
    };
    EXPECT_EQ(turns(0.9995), 2);
    EXPECT_EQ(turns(0.99), 0);
}

// ------------------------------------------------------------- period doublings and chaos

TEST(slip_folds, air_spring_doubles_its_period_at_the_reproduced_speeds) {
    named_map near = periodic_point(figure_12(1.65, 0.25));
    named_map flip = point_with_multiplier(near, "speed", -1.0);
    EXPECT_NEAR(flip.value("speed"), 1.657765, 6e-7);
    near = periodic_point(figure_12(1.70, 0.25).after(2000), 2);
    flip = point_with_multiplier(near, "speed", -1.0, 2);
    EXPECT_NEAR(flip.value("speed"), 1.705457, 6e-7);
    near = periodic_point(figure_12(1.7100, 0.25).after(4000), 4);
    flip = point_with_multiplier(near, "speed", -1.0, 4);
    EXPECT_NEAR(flip.value("speed"), 1.710989, 6e-7);
}

/// Mean of ln|P'| along the settled orbit, per stride.
double exponent(named_map m, int strides) {
    m = m.after(500);
    double sum = 0.0;
    for (int i = 0; i < strides; ++i) {
        const map_image f = m.image();
        if (f.end != outcome::ok) return std::nan("");
        sum += std::log(std::abs(f.jacobian(0, 0)));
        m.start = f.state;
    }
    return sum / strides;
}

TEST(slip_folds, air_spring_turns_chaotic_at_1_7124) {
    EXPECT_LT(exponent(figure_12(1.7122), 4000), 0.0);  // v_chaos = 1.7124(1), paper 1.713
    EXPECT_GT(exponent(figure_12(1.7127), 4000), 0.005);
    EXPECT_GT(exponent(figure_12(1.7150), 4000), 0.05);
    EXPECT_LT(exponent(figure_12(1.71475), 4000), 0.0);  // a window (page, case 10)
}

TEST(slip_folds, air_spring_with_gravity_turns_chaotic_at_1_6919) {
    const auto at = [](double speed) {
        return exponent(runner(0.17, 0.03839, 0.961, speed, 0.25, air_on), 1500);
    };
    EXPECT_LT(at(1.6917), 0.0);  // v_chaos = 1.6919(1), paper 1.6932
    EXPECT_GT(at(1.6923), 0.0);
}

TEST(slip_folds, two_cycle_of_figure_9_is_stable_from_3_86864_to_3_93150) {
    const named_map fixed = periodic_point(figure_9(3.86, 0.3));
    EXPECT_NEAR(point_with_multiplier(fixed, "speed", -1.0).value("speed"), 3.86864, 6e-6);
    const named_map pair = periodic_point(figure_9(3.93, 0.16).after(2000), 2);
    EXPECT_NEAR(point_with_multiplier(pair, "speed", -1.0, 2).value("speed"), 3.93150, 6e-6);
    // at the paper's 3.95 the attractor is another one, of longer period
    EXPECT_NEAR(exponent(figure_9(3.95), 4000), -0.05, 0.01);
}

TEST(slip_folds, hooke_spring_is_chaotic_against_the_papers_claim) {
    EXPECT_NEAR(exponent(figure_9(3.955), 20000), 0.267, 0.01);
    EXPECT_NEAR(exponent(figure_9(3.968), 20000), 0.464, 0.01);
}

TEST(slip_folds, hooke_spring_with_gravity_has_the_multiplier_of_the_counterexample) {
    const named_map fixed = periodic_point(by_numbers(1.0, 5.513, 0.6, 0.06, linear_on));
    EXPECT_NEAR(largest_multiplier(fixed), -1.0487, 6e-5);
    const named_map pair = periodic_point(by_numbers(1.0, 5.513, 0.6, 0.015797, linear_on), 2);
    EXPECT_NEAR(angle_of(pair), 0.015797, 6e-7);
    EXPECT_LT(largest_multiplier_modulus(pair, 2), 1.0);
}

// ------------------------------------------------------------- gaps

/// Does some angle in (0, beta) make the runner stumble? The stumbling angles closest to birth lie
/// around the least D = (angle')^2, so the search narrows on the least next angle.
bool has_gap(named_map m, double beta) {
    double low = 0.0;
    double high = beta;
    for (int level = 0; level < 6; ++level) {
        double place = low;
        double least = 10.0;
        const double step = (high - low) / 60;
        for (int i = 1; i < 60; ++i) {
            m.start[1] = low + i * step;
            const map_image f = m.image();
            if (f.end == outcome::stumble) return true;
            if (f.end != outcome::ok) break;
            if (f.to[0] < least) least = f.to[0], place = m.start[1];
        }
        low = std::max(place - step, 0.0);
        high = place + step;
    }
    return false;
}

TEST(slip_folds, gaps_open_at_the_reproduced_speeds) {
    struct row {
        named_map m;
        double beta, speed, digit;
    };
    const row rows[] = {
        {runner(1.5, 50.0, 0.8, 0.0, 0.0, linear_off), 0.8, 9.58613, 1e-5},
        {runner(1.5, 100.0, 1.0, 0.0, 0.0, linear_off), 1.0, 10.593, 1e-3},
        {figure_9(0.0), M_PI / 4, 3.97090, 1e-5},
        {figure_12(0.0), 0.961, 1.715498, 1e-6},
    };
    for (const row& r : rows) {
        EXPECT_FALSE(has_gap(r.m.with("speed", r.speed - r.digit), r.beta)) << r.speed;
        EXPECT_TRUE(has_gap(r.m.with("speed", r.speed + r.digit), r.beta)) << r.speed;
    }
}

TEST(slip_folds, period_doubles_before_the_gap_only_under_much_gravity) {
    // Fig. 15, air spring, beta = 1.25: gt = 1 flips at ct = 1.33, the gap opens at 1.31; at
    // gt = 0.5 the gap comes first as the spring softens
    const named_map strong =
        point_with_multiplier(by_numbers(1.25, 1.33, 1.0, 0.05, air_on), "stiffness", -1.0);
    EXPECT_NEAR(strong.value("stiffness"), 1.33, 6e-3);
    const auto gap_opens = [](double gravity, double soft, double hard) {
        for (int i = 0; i < 24; ++i) {
            const double middle = 0.5 * (soft + hard);
            (has_gap(by_numbers(1.25, middle, gravity, 0.0, air_on), 1.25) ? soft : hard) = middle;
        }
        return soft;
    };
    const double gap = gap_opens(1.0, 1.25, 1.4);
    EXPECT_NEAR(gap, 1.31, 0.02);               // "~1.31"
    EXPECT_LT(gap, strong.value("stiffness"));  // as the spring softens the flip comes first
    const double weak_gap = gap_opens(0.5, 0.5, 1.2);
    const named_map at_gap = periodic_point(by_numbers(1.25, weak_gap * 1.0001, 0.5, 0.08, air_on));
    EXPECT_GT(largest_multiplier(at_gap), -1.0);
}

TEST(slip_folds, map_falls_to_zero_like_a_root_at_the_gaps_edge) {
    const named_map m = figure_12(1.7163);
    double inside = 0.36359;
    double outside = 0.30;
    ASSERT_EQ(m.with("angle", inside).image().end, outcome::stumble);
    ASSERT_EQ(m.with("angle", outside).image().end, outcome::ok);
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (inside + outside);
        (m.with("angle", middle).image().end == outcome::ok ? outside : inside) = middle;
    }
    const map_image near = m.with("angle", outside - 1e-8).image();
    const map_image far = m.with("angle", outside - 4e-8).image();
    EXPECT_NEAR(far.to[0] / near.to[0], 2.0, 1e-3);
    EXPECT_NEAR(far.jacobian(0, 0) / near.jacobian(0, 0), 0.5, 1e-3);
}

// ------------------------------------------------------------- hard cases (page, section 13)

TEST(slip_folds, fixed_points_part_like_the_root_of_the_distance_from_their_fold) {
    const named_map fold =
        point_with_multiplier(runner(1.5, 100.0, 1.25, 4.2325, 0.4, linear_off), "speed", 1.0);
    const auto gap = [&](double distance) {
        named_map upper = fold.with("speed", fold.value("speed") * (1.0 + distance));
        named_map lower = upper;
        upper.start[1] += 2.0 * std::sqrt(distance);
        lower.start[1] -= 2.0 * std::sqrt(distance);
        return angle_of(periodic_point(upper)) - angle_of(periodic_point(lower));
    };
    EXPECT_NEAR(gap(1e-4) / gap(1e-6), 10.0, 0.1);
    EXPECT_NEAR(gap(1e-6) / gap(1e-8), 10.0, 0.01);
    // below the fold a ghost holds the runner up, longer the closer
    const auto strides = [&](double distance) {
        named_map m = fold.with("speed", fold.value("speed") * (1.0 - distance));
        return m.answer(1000000).returns;
    };
    EXPECT_NEAR(strides(1e-8) / static_cast<double>(strides(4e-8)), 2.0, 0.1);
    EXPECT_GT(strides(1e-8), 1000u);
}

TEST(slip_folds, high_speeds_keep_their_digits) {
    // v^2 angle -> J; page, case 6: v = 1000, angle 2.8e-6 for k = 10, beta = pi/4
    const double beta = M_PI / 4;
    const double limit =
        10.0 * 1.5 * 1.5 * std::sin(beta) * (std::asinh(1.0 / std::tan(beta)) - std::cos(beta));
    const named_map fixed = periodic_point(figure_9(1000.0, limit * 1e-6));
    EXPECT_NEAR(angle_of(fixed), 2.8e-6, 6e-8);
    EXPECT_NEAR(angle_of(fixed) * 1e6 / limit, 1.0, 1e-4);  // the correction falls like 1 / v^2
    const double multiplier = -1 - 2 * 9.81 * 1.5 * std::cos(beta) / limit;
    EXPECT_NEAR(multiplier, -8.506, 6e-4);
    EXPECT_NEAR(largest_multiplier(fixed), multiplier, 1e-3);
    const orbit_answer plain = fixed.answer();
    const orbit_answer truth = fixed.answer(1, digits::fifty);
    EXPECT_NEAR(std::stod(plain.columns[1]) / std::stod(truth.columns[1]), 1.0, 1e-9);
    // the air spring's limit
    const double b = 1.5 * std::sin(1.25);
    const double air_limit =
        23.0 * b * (std::cos(1.25) / (2 * b * b * 1.5) + (M_PI / 2 - 1.25) / (2 * b * b * b));
    const named_map air =
        periodic_point(runner(1.5, 23.0, 1.25, 1000.0, air_limit * 1e-6, air_off));
    EXPECT_NEAR(angle_of(air) * 1e6 / air_limit, 1.0, 1e-4);
}

TEST(slip_folds, starts_beyond_the_leg_sweep_backward_and_reverse_next) {
    for (const choices& options : {linear_off, air_off}) {
        const bool is_air = options.size() == 2;
        const auto stride = [&](double angle) {
            return by_numbers(1.2, is_air ? 0.5 : 5.0, 0.1, angle, options).answer();
        };
        EXPECT_NEAR(std::stod(stride(1.3).extras[0]), -std::stod(stride(1.1).extras[0]), 1e-14);
        named_map m = by_numbers(1.2, is_air ? 0.5 : 5.0, 0.1, 1.3, options);
        const orbit_answer two = m.answer(2);
        EXPECT_EQ(two.end, outcome::reverse);
    }
}

TEST(slip_folds, heavy_gravity_is_resolved) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int ok = 0;
    for (int i = 0; i < 320; ++i) {  // the page: no stance without lift-off in 320 random cases
        const double beta = 0.7 + 0.8 * unit(random);
        const named_map m = by_numbers(beta, 2.0 + 40.0 * unit(random), 1.0 + 2.0 * unit(random),
                                       beta * unit(random), i % 2 == 0 ? linear_on : air_on);
        const orbit_answer plain = m.answer();
        EXPECT_NE(plain.end, outcome::no_liftoff);
        EXPECT_NE(plain.end, outcome::unresolved_event);
        ok += plain.end == outcome::ok ? 1 : 0;
        if (i % 40 != 0) continue;
        const orbit_answer truth = m.answer(1, digits::fifty);
        EXPECT_EQ(plain.end, truth.end) << i;
        EXPECT_NEAR(std::stod(plain.extras[0]), std::stod(truth.extras[0]), 1e-12) << i;
    }
    EXPECT_GT(ok, 20);
}

/// Lift-off and stance states of one stride, in leg lengths and touchdown speeds.
struct stance_watch final : orbit_observer {
    double spring_energy = 0.0;  // least and largest energy over the stance's samples
    double least = 1e300, most = -1e300;
    std::array<double, 4> first{}, last{};  // of the whole stance, whatever its steps
    bool has_first = false;
    std::array<double, 3> numbers{};  // stiffness, gravity, is air
    void phase(const char* mode, double, double duration, const sampler& at) override {
        if (std::string_view(mode) != "stance") return;
        for (int i = 0; i <= 40; ++i) {
            double s[most_columns];
            at.state_at(duration * i / 40.0, s);
            const double length = std::hypot(s[0], s[1]);
            const double spring = numbers[2] > 0 ? 0.5 * numbers[0] * (1 / (length * length) - 1)
                                                 : 0.5 * numbers[0] * (length - 1) * (length - 1);
            const double energy = 0.5 * (s[2] * s[2] + s[3] * s[3]) + numbers[1] * s[1] + spring;
            least = std::min(least, energy);
            most = std::max(most, energy);
            if (!has_first) std::copy(s, s + 4, first.begin());
            has_first = true;
            std::copy(s, s + 4, last.begin());
        }
    }
    void event(const char*, double, const char*, const char*, const double*, const double*,
               double) override {}
};

TEST(slip_folds, map_is_a_rounded_v_just_below_its_gap) {
    // page, case 4: P ~ sqrt(Dmin + a (delta - delta*)^2), so second differences of P^2 about its
    // least are those of a parabola: four times as large for twice the distance
    const double edge = 1.715498;
    for (const double below : {1e-4, 1e-5}) {
        const named_map m = figure_12(edge * (1.0 - below));
        const auto squared = [&](double angle) {
            const double next = m.with("angle", angle).image().to[0];
            return next * next;
        };
        double low = 0.35, high = 0.38;
        for (int i = 0; i < 100; ++i) {  // golden section on the least of P^2
            const double span = 0.381966 * (high - low);
            (squared(low + span) < squared(high - span) ? high : low) +=
                squared(low + span) < squared(high - span) ? -span : span;
        }
        const double least = 0.5 * (low + high);
        EXPECT_NEAR(least, 0.363590, 2e-4);  // delta_GP of case 3
        const auto rise = [&](double h) {
            return squared(least + h) + squared(least - h) - 2 * squared(least);
        };
        EXPECT_GT(rise(1e-3), 0.0);
        EXPECT_NEAR(rise(2e-3) / rise(1e-3), 4.0, 0.02) << below;
        // the nearer the gap, the sharper the V: P there is the root of what is left of D
        EXPECT_NEAR(squared(least) / below, 8.95e-7 / 1e-6, 0.01) << below;
    }
}

TEST(slip_folds, leaving_the_ground_downward_above_touchdown_height_is_legal) {
    // page, case 11: heavy gravity, lift-off with w < 0 and y above sin(beta); inputs from a scan
    struct start {
        double beta, stiffness, gravity, angle;
    };
    for (const start& from : {start{1.01, 15.7, 4.06, -0.103},
                              {0.71, 9.95, 1.736, -0.441},
                              {1.18, 40.9, 3.31, -0.075}}) {
        const named_map m =
            by_numbers(from.beta, from.stiffness, from.gravity, from.angle, linear_on);
        stance_watch seen;
        m.trace(seen);
        EXPECT_LT(seen.last[3], 0.0) << from.beta;
        EXPECT_GT(seen.last[1], std::sin(from.beta)) << from.beta;
        const orbit_answer answer = m.answer();
        ASSERT_EQ(answer.end, outcome::ok) << from.beta;
        // D = w^2 + 2 gt (y - sin beta): the fall to the next touchdown
        const double fall =
            seen.last[3] * seen.last[3] + 2 * from.gravity * (seen.last[1] - std::sin(from.beta));
        EXPECT_NEAR(std::sin(std::stod(answer.columns[1])), std::sqrt(fall), 1e-12) << from.beta;
    }
}

TEST(slip_folds, chaos_of_figure_12_parts_orbits_e_fold_every_4_to_11_strides) {
    // page, case 10; at the band's lower end and next to the gap, block errors are some 2 %
    EXPECT_NEAR(1.0 / exponent(figure_12(1.7127), 20000), 11.0, 2.0);
    EXPECT_NEAR(1.0 / exponent(figure_12(1.7154), 20000), 4.0, 1.0);
}

// ------------------------------------------------------------- invariants

TEST(slip_folds, stances_conserve_energy_and_the_next_touchdowns_speed) {
    for (const choices& options : {linear_off, air_off, linear_on, air_on}) {
        const bool is_air = !options.empty() && options[0].second == "air";
        const bool has_gravity = options.empty() || options.back().second == "air";
        const double stiffness = is_air ? 0.8 : 8.0;
        for (const double angle : {0.05, 0.2, 0.35}) {
            const named_map m = by_numbers(1.0, stiffness, 0.1, angle, options);
            stance_watch seen;
            seen.numbers = {stiffness, has_gravity ? 0.1 : 0.0, is_air ? 1.0 : 0.0};
            m.trace(seen);
            EXPECT_LT(seen.most - seen.least, 4e-14) << is_air << has_gravity << angle;
            if (!has_gravity) continue;
            // u^2 + D = 1, D = w^2 + 2 gt (y - sin beta) at lift-off
            const auto& s = seen.last;
            EXPECT_NEAR(s[2] * s[2] + s[3] * s[3] + 0.2 * (s[1] - std::sin(1.0)), 1.0, 2e-14);
        }
    }
}

TEST(slip_folds, gaits_are_mirror_images_about_midstance) {
    const named_map gait = periodic_point(runner(1.0, 100.0, 1.0, 8.0, 0.16, linear_on)
                                              .with({{"leg_length", 1.5}, {"angle", 0.1412}}));
    stance_watch seen;
    gait.trace(seen);
    EXPECT_NEAR(seen.last[0], -seen.first[0], 1e-12);
    EXPECT_NEAR(seen.last[1], seen.first[1], 1e-12);
    EXPECT_NEAR(seen.last[2], seen.first[2], 1e-12);
    EXPECT_NEAR(seen.last[3], -seen.first[3], 1e-12);
    const auto momentum = [](const std::array<double, 4>& s) { return s[1] * s[2] - s[0] * s[3]; };
    EXPECT_NEAR(momentum(seen.last), momentum(seen.first), 1e-12);
}

TEST(slip_folds, neglecting_gravity_in_stance_is_the_limit_of_little_gravity) {
    for (const bool is_air : {false, true}) {
        const auto difference = [&](double gravity) {
            const double stiffness = is_air ? 0.8 : 8.0;
            const named_map with =
                by_numbers(1.0, stiffness, gravity, 0.25, is_air ? air_on : linear_on);
            const named_map without =
                by_numbers(1.0, stiffness, gravity, 0.25, is_air ? air_off : linear_off);
            return with.image().to[0] - without.image().to[0];
        };
        EXPECT_LT(std::abs(difference(1e-6)), 1e-5);
        EXPECT_NEAR(difference(2e-5) / difference(1e-5), 2.0, 1e-3);  // first order in gravity
    }
}

TEST(slip_folds, only_three_numbers_matter) {
    // gamma = k eta0 / (m g) = kt / gt of Figs. 2 and 4, to the digits printed; the same stride by
    // k, g and the speed, and by the groups
    const std::pair<double, double> rows[] = {{654.0, 100.0},  {163.5, 25.0},   {65.4, 10.0},
                                              {2000.0, 305.8}, {1000.0, 152.9}, {250.0, 38.2},
                                              {100.0, 15.3}};
    for (const auto& [stiffness, gamma] : rows) {
        EXPECT_NEAR(stiffness * 1.5 / 9.81, gamma, 0.051) << stiffness;
        const double gravity = 0.02;
        const double speed = std::sqrt(9.81 * 1.5 / gravity);
        const named_map by_hand = runner(1.5, stiffness, 1.0, speed, 0.1, linear_on);
        const named_map groups =
            by_numbers(1.0, stiffness * 1.5 / 9.81 * gravity, gravity, 0.1, linear_on);
        ASSERT_EQ(by_hand.image().end, groups.image().end) << stiffness;
        EXPECT_NEAR(std::stod(by_hand.answer().extras[0]), std::stod(groups.answer().extras[0]),
                    2e-14)
            << stiffness;
    }
    for (const choices& options : {linear_off, air_off, linear_on, air_on}) {
        const bool is_air = !options.empty() && options[0].second == "air";
        const double stiffness = is_air ? 0.8 : 8.0;
        const named_map one = by_numbers(1.0, stiffness, 0.1, 0.25, options);
        const double leg = 0.7, mass = 3.0, speed = 2.5;
        const double scale =
            is_air ? mass * speed * speed * leg * leg : mass * speed * speed / (leg * leg);
        const named_map other = one.with({{"leg_length", leg},
                                          {"mass", mass},
                                          {"speed", speed},
                                          {"stiffness", stiffness * scale},
                                          {"gravity", 0.1 * speed * speed / leg}});
        EXPECT_NEAR(other.image().to[0], one.image().to[0], 2e-14);
    }
}

TEST(slip_folds, orbits_go_on_from_any_of_their_touchdowns) {
    for (const named_map& m : {runner(1.5, 100.0, 1.25, 4.6, 0.25, linear_off),
                               figure_12(1.65, 0.25), runner(1.5, 100.0, 1.0, 8.0, 0.15, linear_on),
                               runner(0.17, 0.03839, 0.961, 1.65, 0.25, air_on)}) {
        const orbit_answer whole = m.answer(7);
        ASSERT_EQ(whole.end, outcome::ok);
        EXPECT_EQ(m.after(3).answer(4).columns, whole.columns);
    }
}

}  // namespace
}  // namespace hopscotch
