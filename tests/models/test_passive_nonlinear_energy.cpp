// The passive hopper with nonlinear terms: energy, orbits taken up in the air, derivatives,
// backends.
#include "tests/models/nonlinear_hoppers.hpp"

#include "analysis/truth/decimal.hpp"
#include "analysis/truth/real50.hpp"
#include "tests/models/nonlinear_rows.hpp"
#include "tests/models/passive_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace hopscotch {
namespace {

using namespace nonlinear_rows;
using namespace testing_models::nonlinear_hoppers;

// ---- energy, restarts, derivatives, backends

struct batch {
    std::vector<std::vector<double>> columns;
    std::vector<std::vector<double>> parameters;  // [parameter][row]
    int section = 0;

    void add(const std::vector<double>& start, const terms& of) {
        columns.resize(start.size());
        for (std::size_t c = 0; c < start.size(); ++c) columns[c].push_back(start[c]);
        const std::vector<double> all = of.parameters();
        parameters.resize(all.size());
        for (std::size_t p = 0; p < all.size(); ++p) parameters[p].push_back(all[p]);
    }

    struct result {
        std::vector<std::uint8_t> end;
        std::vector<double> speed, time, loss;
    };
    result run(std::string_view model, backend which, std::uint32_t returns, double tolerance,
               double max_steps = 1e4) const {
        const std::size_t n = columns[0].size();
        result out{std::vector<std::uint8_t>(n), std::vector<double>(n), std::vector<double>(n),
                   std::vector<double>(n)};
        ensemble_request request;
        request.n_cells = n;
        request.section = section;
        for (std::size_t c = 0; c < columns.size(); ++c)
            request.columns[c] = {columns[c].data(), 1, n};
        for (std::size_t p = 0; p < parameters.size(); ++p)
            request.parameters[p] = {parameters[p].data(), 1, n};
        request.max_returns = returns;
        request.max_steps = max_steps;
        request.tolerance = tolerance;
        request.outcome = out.end.data();
        request.state[0] = out.speed.data();
        request.time = out.time.data();
        request.extras[1] = out.loss.data();
        find_model(model)->kernel(which, nonlinear)(request);
        return out;
    }
};

TEST(passive_nonlinear, never_gains_energy_not_by_one_ulp) {
    random_hoppers random(8);
    batch starts;
    for (int i = 0; i < 20000; ++i) {
        starts.add(
            {i % 4 == 0 ? std::pow(10.0, random.between(-6.0, 0.0)) : random.between(0.0, 12.0)},
            random.mild());
    }
    for (const double tolerance : {1e-10, 1e-4}) {
        const auto got = starts.run("passive_hopper", passive_rows::fastest(), 1, tolerance);
        int hops = 0;
        for (std::size_t i = 0; i < got.end.size(); ++i) {
            if (got.end[i] != 0) continue;
            ++hops;
            const double alpha = starts.columns[0][i];
            ASSERT_LE(got.speed[i], alpha) << i;
            EXPECT_NEAR(alpha * alpha - got.speed[i] * got.speed[i], got.loss[i],
                        4e-15 * alpha * alpha);
        }
        EXPECT_GT(hops, 10000);
    }
}

/// Collects states of a traced orbit.
struct recorder final : orbit_observer {
    struct sample {
        double time;
        double column[4];
        bool in_air;
    };
    struct impact {
        double before[4], after[4], loss;
    };
    std::vector<sample> samples;
    std::vector<impact> impacts;

    void phase(const char* mode, double start, double duration, const sampler& at) override {
        for (int i = 0; i < 4; ++i) {
            sample s{start + duration * 0.25 * i, {}, std::string_view(mode) == "flight"};
            at.state_at(duration * 0.25 * i, s.column);
            samples.push_back(s);
        }
    }
    void event(const char* name, double, const char*, const char*, const double* before,
               const double* after, double loss) override {
        if (std::string_view(name) != "impact") return;
        impact i{};
        std::copy(before, before + 4, i.before);
        std::copy(after, after + 4, i.after);
        i.loss = loss;
        impacts.push_back(i);
    }
};

/// E of the page with both nonlinear terms.
double energy(const double* x, const terms& of) {
    const double m = of.mass_ratio;
    const double s = x[0] - x[2];
    const auto weight = [&](double y) { return y + 0.5 * of.gradient * y * y; };
    return 0.5 * (1.0 + m) * (x[1] * x[1] + m * x[3] * x[3]) +
           m * s * s * (0.5 + s * (of.quadratic / 3.0 + of.cubic * s / 4.0)) + weight(x[0]) +
           m * weight(x[2]);
}

TEST(passive_nonlinear, conserves_energy_between_impacts_and_books_what_each_takes) {
    const terms of{.mass_ratio = 2.0, .quadratic = 0.05, .cubic = 0.01, .gradient = 0.02};
    std::vector<std::string> parameters;
    const start from{.columns = {"6.9"}, .of = of, .returns = 3};
    recorder seen;
    find_model("passive_hopper")->orbits().trace(row_of(from, parameters), seen);
    ASSERT_GT(seen.impacts.size(), 2u);
    ASSERT_GT(seen.samples.size(), 40u);
    double highest = energy(seen.samples.front().column, of);
    for (const auto& s : seen.samples) {
        const double now = energy(s.column, of);
        EXPECT_LE(now, highest + 1e-11);
        highest = std::min(highest, now);
    }
    for (const auto& i : seen.impacts) {
        const double drop = energy(i.before, of) - energy(i.after, of);
        EXPECT_NEAR(drop, 0.5 * 3.0 * i.loss, 1e-11);  // (1 + M) / 2 per alpha^2
        EXPECT_NEAR(drop, 0.5 * 3.0 * 2.0 * i.before[3] * i.before[3], 1e-11);
    }
}

TEST(passive_nonlinear, an_orbit_restarted_from_any_state_in_the_air_goes_on_as_itself) {
    const terms of{.mass_ratio = 0.7, .quadratic = -0.05, .cubic = 0.02, .gradient = 0.01};
    std::vector<std::string> parameters;
    const start from{.columns = {"6.9"}, .of = of};
    recorder seen;
    const orbit_answer whole =
        find_model("passive_hopper")->orbits().trace(row_of(from, parameters), seen);
    ASSERT_EQ(whole.end, outcome::ok);
    int restarts = 0;
    for (const auto& s : seen.samples) {
        if (!s.in_air || !(s.column[2] > 1e-3)) continue;
        const orbit_answer rest = in_double({.section = 1,
                                             .columns = {text(s.column[0]), text(s.column[1]),
                                                         text(s.column[2]), text(s.column[3])},
                                             .of = of});
        EXPECT_NEAR(number(rest.columns[0]), number(whole.columns[0]), 1e-11);
        EXPECT_NEAR(number(rest.time) + s.time, number(whole.time), 1e-10);
        ++restarts;
    }
    EXPECT_GT(restarts, 8);
}

TEST(passive_nonlinear, derivatives_are_those_of_50_digit_differences) {
    const terms of{.mass_ratio = 1.5, .quadratic = 0.04, .cubic = 0.01, .gradient = 0.02};
    const terms damped{.mass_ratio = 0.6, .damping = 0.02, .cubic = 0.01};
    const std::vector<start> starts = {
        {.columns = {"4.6"}, .of = of},  // no bounce
        {.columns = {"4.2"}, .of = of},  // a bounce
        {.columns = {"4.8"}, .of = damped},
        {.section = 1, .columns = {"-3.2", "2.5", "0.7", "-0.3"}, .of = of},
    };
    const std::string step = "1e-18";
    for (start from : starts) {
        from.derivative = true;
        const orbit_answer wide = in_50_digits(from);
        const orbit_answer narrow = in_double(from);
        ASSERT_EQ(wide.end, outcome::ok);
        for (std::size_t c = 0; c < from.columns.size(); ++c) {
            const auto moved = [&](const real50& by) {
                start shifted = from;
                shifted.derivative = false;
                shifted.columns[c] = print_real(parse_real<real50>(from.columns[c]) + by);
                return parse_real<real50>(in_50_digits(shifted).columns[0]);
            };
            const real50 h = parse_real<real50>(step);
            const double slope = to_double((moved(h) - moved(-h)) / (h + h));
            EXPECT_NEAR(number(wide.derivative[c]) / slope, 1.0, 1e-15) << from.columns[0];
            EXPECT_NEAR(number(narrow.derivative[c]) / slope, 1.0, 1e-9) << from.columns[0];
        }
    }
}

TEST(passive_nonlinear, every_backend_gives_the_same_bits) {
    random_hoppers random(9);
    batch lift_offs;
    batch flights;
    flights.section = 1;
    for (int i = 0; i < 600; ++i) {
        terms of = random.mild();
        of.gradient = i % 3 == 0 ? 0.0 : of.gradient;
        if (i % 3 == 1) of.restitution = 0.4;
        if (i % 5 == 0) of.damping = 0.01;
        if (i % 7 == 0) of.increment = 0.02;
        lift_offs.add({random.between(0.0, 9.0)}, of);
        flights.add({random.between(-2.0, 4.0), random.between(-3.0, 3.0),
                     i % 4 == 0 ? 0.0 : random.between(0.0, 3.0), random.between(-3.0, 3.0)},
                    of);
    }
    for (const std::string_view model : {"passive_hopper", "passive_juggler"}) {
        for (const batch* starts : {&lift_offs, &flights}) {
            const auto scalar = starts->run(model, backend::scalar, 3, 1e-10, 400.0);
            for (const backend which : {backend::avx2, backend::avx512}) {
                if (!passive_rows::can_run(which)) continue;
                const auto wide = starts->run(model, which, 3, 1e-10, 400.0);
                EXPECT_EQ(wide.end, scalar.end);
                EXPECT_EQ(wide.speed, scalar.speed);
                EXPECT_EQ(wide.time, scalar.time);
                EXPECT_EQ(wide.loss, scalar.loss);
            }
        }
    }
}

TEST(passive_nonlinear, the_exact_variants_have_no_member_more) {
    // a scene without nonlinear terms never meets their variant
    const model_entry& model = *find_model("passive_hopper");
    std::vector<double> zero = terms{}.parameters();
    EXPECT_LT(model.variant({zero.data(), zero.data(), nullptr}), nonlinear);
    EXPECT_FALSE(model.integrates(model.variant({zero.data(), zero.data(), nullptr})));
    std::vector<double> stiff = terms{.cubic = 1e-3}.parameters();
    EXPECT_EQ(model.variant({zero.data(), stiff.data(), nullptr}), nonlinear);
    EXPECT_TRUE(model.integrates(nonlinear));
}

}  // namespace
}  // namespace hopscotch
