// Families of starts that go to a limit where the arithmetic is hard: lossless points, grazing,
// gap edges, folds, elastic impacts, vanishing and infinite mass ratios, stiff springs, high
// speeds, short thrusts, chatter. Along each, double and double-double against 50 digits: the
// outcome is the same, and the error stays within a few times what one rounding of the start and of
// every parameter does to the exact map (its derivatives) and one of the result.
#include "analysis/truth/real50.hpp"
#include "tests/hard/hard_families.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

using namespace hopscotch;
using hard::family;
using testing_models::digits;
using testing_models::named_map;

namespace {

real50 in_fifty(const std::string& text) { return parse_real<real50>(text); }

/// What relative changes of the parameters do to a column: numbers that are added to the state
/// carry roundings of their own.
double parameter_effect(const named_map& map, std::uint32_t returns, std::size_t column) {
    double effect = 0.0;
    const auto& parameters = map.at.model->info->parameters;
    for (std::size_t p = 0; p < parameters.size(); ++p) {
        const double x = map.at.parameters[p];
        if (!(x != 0.0) || !std::isfinite(x)) continue;
        const Eigen::VectorXd slopes = map.image(returns, parameters[p].name).by_knob;
        const double slope = slopes[static_cast<Eigen::Index>(column)];
        if (std::isfinite(slope)) effect += std::abs(slope * x);
    }
    return effect;
}

/// Largest errors of a column over its conditioning bound, in roundings of each arithmetic.
struct conditioned_errors {
    double sixteen = 0.0;
    double thirty_two = 0.0;
};

/// Of answers some returns from the map's start.
conditioned_errors errors_of(const named_map& map, std::uint32_t returns, const orbit_answer& plain,
                             const orbit_answer& wide, const orbit_answer& truth) {
    constexpr double rounding_of_double = 0x1p-52;
    constexpr double rounding_of_double_double = lane_traits<double_double<double>>::rounding;
    const std::size_t n = truth.columns.size();
    conditioned_errors worst;
    for (std::size_t c = 0; c < n; ++c) {
        const real50 value = in_fifty(truth.columns[c]);
        double size = std::abs(to_double(value));
        for (std::size_t start = 0; start < map.start.size(); ++start) {
            const double slope =
                to_double(in_fifty(truth.derivative[c * map.start.size() + start]));
            size += std::abs(slope * map.start[start]);
        }
        size += parameter_effect(map, returns, c);
        double turn = 0.0;
        if (map.at.model->turn != nullptr) {
            turn =
                map.at.model->turn(map.at.section, static_cast<int>(c), map.at.parameters.data());
            if (turn > 0.0) size += turn;  // a phase is reduced from a time of that size
        }
        const auto error = [&](const orbit_answer& answer) {
            real50 off = abs(in_fifty(answer.columns[c]) - value);
            if (turn > 0.0 && off > real50(0.5 * turn)) off = abs(real50(turn) - off);
            return to_double(off);
        };
        worst.sixteen = std::max(worst.sixteen, error(plain) / (rounding_of_double * size));
        worst.thirty_two =
            std::max(worst.thirty_two, error(wide) / (rounding_of_double_double * size));
    }
    return worst;
}

class hard_family : public ::testing::TestWithParam<family> {};

}  // namespace

TEST_P(hard_family, keeps_outcome_and_conditioning_bound_up_to_the_limit) {
    const family& tested = GetParam();
    named_map map = tested.start();
    const double limit = std::isnan(tested.to.limit) ? map.value(tested.knob) : tested.to.limit;
    const std::uint32_t returns = tested.returns;
    int n_compared = 0;
    for (double distance = tested.over.farthest; distance >= tested.over.nearest;
         distance *= tested.over.ratio) {
        map.value(tested.knob) = limit + tested.to.side * distance;
        const orbit_answer plain = map.answer(returns);
        const orbit_answer wide = map.answer(returns, digits::thirty_two);
        const orbit_answer truth = map.answer(returns, digits::fifty, true);
        ASSERT_EQ(name_of(plain.end), name_of(truth.end)) << "at distance " << distance;
        ASSERT_EQ(name_of(wide.end), name_of(truth.end)) << "at distance " << distance;
        ++n_compared;
        if (truth.end != outcome::ok) continue;
        if (!tested.has_chatter) {
            EXPECT_EQ(plain.events, truth.events) << "at distance " << distance;
            EXPECT_EQ(wide.events, truth.events) << "at distance " << distance;
        }
        const conditioned_errors errors = errors_of(map, returns, plain, wide, truth);
        std::printf("family %s distance %.3e conditioned error %.3g double-double %.3g\n",
                    tested.name, distance, errors.sixteen, errors.thirty_two);
        EXPECT_LE(errors.sixteen, tested.allowed) << "at distance " << distance;
        EXPECT_LE(errors.thirty_two, tested.allowed_wide) << "at distance " << distance;
    }
    EXPECT_GT(n_compared, 3) << "the outcome at least";
}

INSTANTIATE_TEST_SUITE_P(of, hard_family, ::testing::ValuesIn(hard::families()),
                         [](const auto& tested) { return std::string(tested.param.name); });
