// Parameters outside the ranges of the models' pages are refused before any work, those at the ends
// that a page admits are not; combinations that no single range can tell are refused with a reason.
// (How the refusal reads: tests/host/test_scene_errors.cpp and test_eval.cpp.)
#include "kernels/contract/entry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace hopscotch {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double tiny = std::numeric_limits<double>::denorm_min();

const parameter_info& parameter_of(std::string_view model, std::string_view name) {
    const model_entry* entry = find_model(model);
    EXPECT_NE(entry, nullptr) << model;
    for (const parameter_info& p : entry->info->parameters) {
        if (p.name == name) return p;
    }
    throw std::invalid_argument(std::string(model) + " has no " + std::string(name));
}

struct limit {
    std::string_view model, parameter;
    std::vector<double> legal, illegal;
};

/// The parameter tables of models/*.md, end by end.
const limit limits[] = {
    {"passive_hopper", "mass_ratio", {tiny, 1.0, infinite}, {0.0, -1.0}},
    {"passive_hopper", "restitution", {0.0, 1.0}, {-tiny, 1.0 + 0x1p-52}},
    {"passive_hopper", "damping_ratio", {0.0, 1.0 - 0x1p-53}, {-tiny, 1.0}},
    {"passive_juggler", "mass_ratio", {tiny, infinite}, {0.0}},
    {"raibert_pneumatic", "liftoff_height", {tiny}, {0.0, infinite}},
    {"raibert_pneumatic", "stiffness", {tiny}, {0.0, -1.0}},
    {"raibert_pneumatic", "thrust", {tiny}, {0.0}},
    {"raibert_pneumatic", "thrust_time", {0.0}, {-tiny}},
    {"raibert_pneumatic", "friction", {0.0}, {-tiny}},
    {"raibert_pneumatic", "stance_gravity", {0.0}, {-tiny}},
    {"raibert_pneumatic", "flight_gravity", {tiny}, {0.0}},
    {"raibert_linear", "stiffness", {tiny}, {0.0}},
    {"raibert_linear", "friction", {0.0}, {-tiny}},
    {"raibert_linear_simple", "frequency", {tiny}, {0.0}},
    {"raibert_linear_simple", "damping", {tiny}, {0.0}},
    {"openloop_hopper", "natural_frequency", {tiny}, {0.0, infinite}},
    {"openloop_hopper", "damping_ratio", {0.0, 1.5}, {-tiny}},
    {"openloop_hopper", "thrust", {0.0}, {-tiny}},
    {"slip", "touchdown_angle", {tiny, 1.5}, {0.0, M_PI_2, -0.1}},
    {"slip", "stiffness", {tiny}, {0.0}},
    {"slip", "gravity", {tiny}, {0.0}},
    {"slip_pitching", "inertia", {tiny}, {0.0}},
    {"mirror_line", "restitution", {0.0, 1.0 - 0x1p-53}, {1.0, -tiny}},
    {"mirror_planar", "restitution", {0.0}, {1.0, -tiny}},
    {"mirror_planar", "gravity", {tiny}, {0.0}},
    {"mirror_planar", "target_height", {tiny}, {0.0}},
    {"mirror_planar", "floor_height", {-tiny}, {0.0}},
    {"mirror_planar", "shoulder_radius", {0.0}, {-tiny}},
    {"mirror_spatial", "shoulder_radius", {tiny}, {0.0}},
    {"paddle_juggler", "amplitude", {tiny}, {0.0}},
    {"paddle_juggler", "restitution", {0.0, 1.0 - 0x1p-53}, {1.0, -tiny}},
    {"relief_valve", "damping", {0.0}, {-tiny}},
    {"relief_valve", "restitution", {0.0, 1.0}, {-tiny, 1.5}},
};

TEST(every_model_inputs, ranges_end_where_the_pages_say) {
    for (const limit& one : limits) {
        const range& valid = parameter_of(one.model, one.parameter).valid;
        for (const double x : one.legal)
            EXPECT_TRUE(valid.holds(x)) << one.model << " " << one.parameter << " = " << x;
        for (const double x : one.illegal)
            EXPECT_FALSE(valid.holds(x)) << one.model << " " << one.parameter << " = " << x;
    }
}

TEST(every_model_inputs, no_parameter_and_no_column_may_be_nan_and_defaults_are_legal) {
    for (const model_entry* entry : all_models()) {
        std::vector<double> standard;
        for (const parameter_info& p : entry->info->parameters) {
            EXPECT_FALSE(p.valid.holds(std::nan(""))) << entry->info->name << " " << p.name;
            standard.push_back(p.standard);
        }
        for (const section_info& section : entry->info->sections) {
            for (const column_info& column : section.columns)
                EXPECT_FALSE(column.valid.holds(std::nan(""))) << column.name;
        }
        const int options[most_options] = {};
        EXPECT_EQ(entry->refusal(standard.data(), options), "") << entry->info->name;
    }
}

/// Why a model refuses its defaults with one number changed.
std::string_view refusal_of(std::string_view model, std::string_view parameter, double value) {
    const model_entry* entry = find_model(model);
    std::vector<double> numbers;
    for (const parameter_info& p : entry->info->parameters)
        numbers.push_back(p.name == parameter ? value : p.standard);
    const int options[most_options] = {};
    return entry->refusal(numbers.data(), options);
}

TEST(every_model_inputs, combinations_that_mean_nothing_are_refused_with_a_reason) {
    EXPECT_EQ(refusal_of("openloop_hopper", "thrust_time", 0.5),
              "thrust_time must be below stride_period");
    EXPECT_EQ(refusal_of("mirror_planar", "bar_length", 0.0),
              "bar_length must be above shoulder_radius");
    EXPECT_NE(refusal_of("passive_juggler", "gravity_gradient", 0.1), "");
    EXPECT_NE(refusal_of("passive_hopper", "quadratic_stiffness", -100.0), "");  // gives way
}

}  // namespace
}  // namespace hopscotch
