// Numeric jets of return maps: the fast road to what `eval --derivative` prints, and derivatives by
// parameters, which only jets have.
#include "analysis/orbit/orbit_functions.hpp"
#include "analysis/truth/decimal.hpp"
#include "host/run/truth_orbits.hpp"
#include "kernels/contract/entry.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hopscotch {
namespace {

struct jet_case {
    const char* model;
    std::vector<double> columns;
    const char* parameter;
};

const jet_case cases[] = {
    {"openloop_hopper", {-0.002, -0.02}, "stride_period"},
    {"raibert_pneumatic_simple", {0.3}, "thrust"},
    {"paddle_juggler", {0.4, 2.5}, "restitution"},
    {"relief_valve", {2.0, 12.0}, "flow_rate"},
};

int parameter_index(const model_info& info, std::string_view name) {
    int index = 0;
    while (info.parameters[static_cast<std::size_t>(index)].name != name) ++index;
    return index;
}

class return_jets : public testing::TestWithParam<jet_case> {};

TEST_P(return_jets, agree_with_the_printed_derivative_and_with_50_digit_differences) {
    const jet_case& with = GetParam();
    const model_entry& model = *find_model(with.model);
    std::vector<double> parameters;
    for (const parameter_info& parameter : model.info->parameters) {
        parameters.push_back(parameter.standard);
    }
    const std::vector<int> options(model.info->options.size(), 0);
    const int by = parameter_index(*model.info, with.parameter);
    const int variant = model.variant({parameters.data(), parameters.data(), options.data(), true});
    const return_jet jet = model.orbits().jet({.options = options.data(),
                                               .variant = variant,
                                               .columns = with.columns.data(),
                                               .parameters = parameters.data(),
                                               .returns = 2,
                                               .by_parameter = by});
    ASSERT_EQ(jet.end, outcome::ok);

    std::vector<std::string> columns;
    std::vector<std::string> texts;
    for (const double x : with.columns) columns.push_back(exact_decimal(x));
    for (const double x : parameters) texts.push_back(exact_decimal(x));
    orbit_row row{.options = options.data(),
                  .variant = variant,
                  .columns = columns,
                  .parameters = texts,
                  .returns = 2,
                  .derivative = true};
    const orbit_answer printed = model.orbits().run_double(row);
    const std::size_t n = columns.size();
    for (std::size_t i = 0; i < n; ++i) {
        EXPECT_EQ(jet.state[i], std::stod(printed.columns[i]));
        for (std::size_t j = 0; j < n; ++j) {
            EXPECT_EQ(jet.derivative[i][j], std::stod(printed.derivative[i * n + j]));
        }
    }

    row.derivative = false;
    const auto shifted = [&](int sign) {
        const double value = parameters[static_cast<std::size_t>(by)];
        texts[static_cast<std::size_t>(by)] =
            print_real(real50(value) + real50(sign) * parse_real<real50>("1e-18"));
        row.parameters = texts;
        return model.orbits().run_mp50(row);
    };
    const orbit_answer above = shifted(1);
    const orbit_answer below = shifted(-1);
    for (std::size_t i = 0; i < n; ++i) {
        const real50 rise =
            parse_real<real50>(above.columns[i]) - parse_real<real50>(below.columns[i]);
        const double truth = to_double(rise / parse_real<real50>("2e-18"));
        EXPECT_NEAR(jet.parameter_derivative[i], truth, 1e-10 * (1.0 + std::abs(truth)));
    }
}

INSTANTIATE_TEST_SUITE_P(models, return_jets, testing::ValuesIn(cases),
                         [](const auto& with) { return std::string(with.param.model); });

}  // namespace
}  // namespace hopscotch
