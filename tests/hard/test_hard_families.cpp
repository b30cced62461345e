// Families of starts that go to a limit where the arithmetic is hard: lossless points, grazing,
// vanishing and infinite mass ratios, stiff springs, high speeds, short thrusts, chatter. Along
// each, double against 50 digits: the outcome is the same, and the error stays within a few times
// what one rounding of the start and of every parameter does to the exact map (its derivatives) and
// one of the result.
#include "analysis/truth/real50.hpp"
#include "tests/models/named_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

using namespace hopscotch;
using testing_models::digits;
using testing_models::named_map;

namespace {

struct family {
    const char* name;
    const char* model;
    const char* section;
    named_map::values numbers;
    named_map::choices options;
    const char* knob;
    double limit;  // the knob stands at limit + direction * distance
    double direction;
    double nearest, farthest;  // distances
    double allowed;            // error over the conditioning bound; measured: 0.03 to 3
};

void PrintTo(const family& shown, std::ostream* to) { *to << shown.name; }

constexpr double lossless_1 = 4.493409457909064;  // tan(alpha) = alpha: the first lossless hop

std::vector<family> families() {
    const named_map::values raibert{{"liftoff_height", 0.5},  {"stiffness", 50.0},
                                    {"thrust", 5.0},          {"thrust_time", 0.02},
                                    {"friction", 0.0},        {"touchdown_speed", 1.0},
                                    {"stance_gravity", 10.0}, {"flight_gravity", 10.0}};
    const named_map::values runner{{"leg_length", 1.5},
                                   {"stiffness", 100.0},
                                   {"touchdown_angle", 1.25},
                                   {"speed", 4.5},
                                   {"angle", 0.2}};
    const named_map::values hopper{{"mass_ratio", 1.0}, {"liftoff_speed", 4.6}};
    const named_map::values clocked{
        {"natural_frequency", 30.0}, {"damping_ratio", 0.2},  {"thrust", 1.55},
        {"thrust_time", 0.08},       {"stride_period", 0.26}, {"height", 0.001},
        {"velocity", 0.02}};
    const named_map::values paddle{{"amplitude", 1.7}, {"restitution", 0.5}, {"phase", 0.5}};
    return {
        {"lossless_point_from_above",
         "passive_hopper",
         "liftoff",
         hopper,
         {},
         "liftoff_speed",
         lossless_1,
         1.0,
         1e-12,
         1e-1,
         16.0},
        {"lossless_point_from_below",
         "passive_hopper",
         "liftoff",
         hopper,
         {},
         "liftoff_speed",
         lossless_1,
         -1.0,
         1e-12,
         1e-1,
         16.0},
        {"multiple_of_pi_from_above",
         "passive_hopper",
         "liftoff",
         hopper,
         {},
         "liftoff_speed",
         2.0 * M_PI,
         1.0,
         1e-12,
         1e-1,
         16.0},
        {"multiple_of_pi_from_below",
         "passive_hopper",
         "liftoff",
         hopper,
         {},
         "liftoff_speed",
         2.0 * M_PI,
         -1.0,
         1e-12,
         1e-1,
         16.0},
        {"light_foot",
         "passive_hopper",
         "liftoff",
         hopper,
         {},
         "mass_ratio",
         0.0,
         1.0,
         1e-12,
         1.0,
         16.0},
        {"heavy_foot",
         "passive_hopper",
         "liftoff",
         hopper,
         {},
         "mass_ratio",
         0.0,
         1.0,
         1.0,
         1e12,
         16.0},
        {"short_hop",
         "passive_hopper",
         "liftoff",
         hopper,
         {},
         "liftoff_speed",
         0.0,
         1.0,
         1e-12,
         1.0,
         16.0},
        {"high_hop",
         "passive_hopper",
         "liftoff",
         hopper,
         {},
         "liftoff_speed",
         0.0,
         1.0,
         1.0,
         1e3,
         16.0},
        {"short_thrust",
         "raibert_linear",
         "touchdown",
         raibert,
         {},
         "thrust_time",
         0.0,
         1.0,
         1e-12,
         1e-2,
         16.0},
        {"crawling_touchdown",
         "raibert_linear",
         "touchdown",
         raibert,
         {},
         "touchdown_speed",
         0.0,
         1.0,
         1e-6,
         1.0,
         16.0},
        {"fast_touchdown",
         "raibert_linear",
         "touchdown",
         raibert,
         {},
         "touchdown_speed",
         0.0,
         1.0,
         1.0,
         1e3,
         16.0},
        {"stiff_spring",
         "slip",
         "touchdown",
         runner,
         {{"stance_gravity", "off"}},
         "stiffness",
         0.0,
         1.0,
         1e2,
         1e6,
         16.0},
        {"glancing_touchdown",
         "slip",
         "touchdown",
         runner,
         {{"stance_gravity", "off"}},
         "angle",
         1.25,
         -1.0,
         1e-12,
         0.9,
         16.0},
        {"fast_runner",
         "slip",
         "touchdown",
         runner,
         {{"stance_gravity", "off"}},
         "speed",
         0.0,
         1.0,
         0.5,
         1e3,
         16.0},
        {"short_clocked_thrust",
         "openloop_hopper",
         "strobe",
         clocked,
         {},
         "thrust_time",
         0.0,
         1.0,
         1e-12,
         1e-2,
         16.0},
        {"chatter_start",
         "paddle_juggler",
         "impact",
         paddle,
         {},
         "relative_velocity",
         0.0,
         1.0,
         1e-12,
         1e-1,
         16.0},
    };
}

real50 in_fifty(const std::string& text) { return parse_real<real50>(text); }

/// What relative changes of the parameters do to a column: numbers that are added to the state
/// carry roundings of their own.
double parameter_effect(const named_map& map, std::size_t column) {
    double effect = 0.0;
    const auto& parameters = map.at.model->info->parameters;
    for (std::size_t p = 0; p < parameters.size(); ++p) {
        const double x = map.at.parameters[p];
        if (!(x != 0.0) || !std::isfinite(x)) continue;
        const Eigen::VectorXd slopes = map.image(1, parameters[p].name).by_knob;
        const double slope = slopes[static_cast<Eigen::Index>(column)];
        if (std::isfinite(slope)) effect += std::abs(slope * x);
    }
    return effect;
}

/// Largest error of a column over its conditioning bound, one return from the map's start.
double conditioned_error(const named_map& map, const orbit_answer& plain,
                         const orbit_answer& truth) {
    const std::size_t n = truth.columns.size();
    double worst = 0.0;
    for (std::size_t c = 0; c < n; ++c) {
        const real50 value = in_fifty(truth.columns[c]);
        double size = std::abs(to_double(value));
        for (std::size_t start = 0; start < map.start.size(); ++start) {
            const double slope =
                to_double(in_fifty(truth.derivative[c * map.start.size() + start]));
            size += std::abs(slope * map.start[start]);
        }
        size += parameter_effect(map, c);
        double error = std::abs(to_double(in_fifty(plain.columns[c]) - value));
        if (map.at.model->turn != nullptr) {
            const double turn =
                map.at.model->turn(map.at.section, static_cast<int>(c), map.at.parameters.data());
            if (turn > 0.0) {
                error = std::min(error, std::abs(turn - error));
                size += turn;  // a phase is reduced from a time of that size
            }
        }
        worst = std::max(worst, error / (0x1p-52 * size));
    }
    return worst;
}

class hard_family : public ::testing::TestWithParam<family> {};

}  // namespace

TEST_P(hard_family, keeps_outcome_and_conditioning_bound_up_to_the_limit) {
    const family& tested = GetParam();
    named_map map(tested.model, tested.section, tested.numbers, tested.options);
    int n_compared = 0;
    for (double distance = tested.farthest; distance >= tested.nearest; distance *= 0.31) {
        map.value(tested.knob) = tested.limit + tested.direction * distance;
        const orbit_answer plain = map.answer(1);
        const orbit_answer truth = map.answer(1, digits::fifty, true);
        ASSERT_EQ(name_of(plain.end), name_of(truth.end)) << "at distance " << distance;
        ++n_compared;
        if (truth.end != outcome::ok) continue;
        EXPECT_EQ(plain.events, truth.events) << "at distance " << distance;
        const double error = conditioned_error(map, plain, truth);
        std::printf("family %s distance %.3e conditioned error %.3g\n", tested.name, distance,
                    error);
        EXPECT_LE(error, tested.allowed) << "at distance " << distance;
    }
    EXPECT_GT(n_compared, 3) << "the outcome at least";
}

INSTANTIATE_TEST_SUITE_P(of, hard_family, ::testing::ValuesIn(families()),
                         [](const auto& tested) { return std::string(tested.param.name); });
