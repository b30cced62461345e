// The audit: which cells it looks at, when 50 digits decide, how large errors are, and how sure it
// is.
#include "host/run/audit.hpp"
#include "host/run/confidence.hpp"
#include "host/run/run_map.hpp"
#include "host/run/truth_orbits.hpp"
#include "host/scene/grid.hpp"
#include "host/store/map_reader.hpp"
#include "tests/host/fake_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <unistd.h>

using namespace hopscotch;

namespace {

const char* const text = R"([model]
name = "fake_bouncer"
[[grid.axis]]
name = "height"
min = 0.0
max = 10.0
cells = 50
[[grid.axis]]
name = "gain"
min = 0.2
max = 1.4
cells = 20
[start]
speed = 3
[question]
kind = "basins"
returns = 20
[output]
tile = [16, 7]
)";

label_plan plan_of(const scene& scene, std::span<const std::uint64_t> = {}) {
    label_plan plan;
    plan.decided_by = decision::intervals;
    plan.point_axes = {1};
    plan.n_traps = 1;
    for (const double gain : values_of(scene.axes[1])) plan.traps.push_back({0.0, gain, 1});
    return plan;
}

class audit_of_a_map : public ::testing::Test {
protected:
    void SetUp() override {
        run_choices choices;
        choices.file = file_;
        choices.is_quiet = true;
        choices.existing = if_exists::replace;
        run_map(scene_, choices, {plan_of, {}});
        map_ = std::make_unique<map_reader>(file_);
    }
    void TearDown() override {
        fake::dd_disagrees_above = fake::mp50_disagrees_above = unbounded;
        std::filesystem::remove(file_);
    }
    audit_report report(std::uint64_t n) const {
        return audit(
            scene_, plan_of(scene_), [&](std::uint64_t tile) { return map_->tile(tile); }, n);
    }

    scene scene_ = parse_scene(text, "audit.toml", {}, fake::models());
    std::filesystem::path file_ = std::filesystem::temp_directory_path() /
                                  ("hopscotch_audit" + std::to_string(getpid()) + ".h5");
    std::unique_ptr<map_reader> map_;
};

}  // namespace

TEST_F(audit_of_a_map, finds_nothing_wrong_where_higher_precision_agrees) {
    const audit_report all = report(5000);
    EXPECT_EQ(all.n_cells, 1000u);  // every cell, traps and all
    EXPECT_EQ(all.n_wrong, 0u);
    EXPECT_EQ(report(100).n_cells, 100u);
}

TEST_F(audit_of_a_map, counts_a_cell_as_wrong_only_where_fifty_digits_disagree_too) {
    fake::dd_disagrees_above = 8.0;
    EXPECT_EQ(report(5000).n_wrong, 0u);
    fake::mp50_disagrees_above = 9.0;
    const audit_report both = report(5000);
    EXPECT_EQ(both.n_wrong, 100u);  // heights 9.1 ... 9.9 of 50 cells over 10, times 20 gains
    EXPECT_DOUBLE_EQ(both.share, 0.1);
    EXPECT_LT(both.lowest, 0.1);
    EXPECT_GT(both.highest, 0.1);
    const attribute_list attributes = attributes_of(scene_, both, "m.h5");
    EXPECT_EQ(attributes.back().second, "hopscotch replay m.h5 --cell 45,0");
}

TEST_F(audit_of_a_map, draws_the_cells_that_the_fingerprint_and_the_seed_decide) {
    const std::vector<std::uint64_t> cells = audited_cells(scene_, 100, 0);
    EXPECT_EQ(cells, audited_cells(scene_, 100, 0));
    EXPECT_NE(cells, audited_cells(scene_, 100, 1));
    const scene other =
        parse_scene(text, "audit.toml", std::vector<std::string>{"start.speed=4"}, fake::models());
    EXPECT_NE(cells, audited_cells(other, 100, 0));
    const scene tiled = parse_scene(
        text, "audit.toml", std::vector<std::string>{"output.tile=[5, 20]"}, fake::models());
    EXPECT_EQ(cells, audited_cells(tiled, 100, 0));  // tiles leave the numbers as they are
}

TEST_F(audit_of_a_map, covers_the_true_share_as_often_as_it_says) {
    fake::dd_disagrees_above = fake::mp50_disagrees_above = 9.0;  // a tenth of the cells
    int n_covering = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const audit_report report = audit(
            scene_, plan_of(scene_), [&](std::uint64_t tile) { return map_->tile(tile); }, 60,
            seed);
        n_covering += report.lowest <= 0.1 && 0.1 <= report.highest ? 1 : 0;
    }
    EXPECT_GE(n_covering, 190);  // 95 % of 200
    EXPECT_LT(n_covering, 200);  // and not by intervals that always cover
}

TEST_F(audit_of_a_map, gives_the_errors_of_numeric_layers_and_their_worst_cell) {
    // the kernel stores returns / 4 as time, the single orbits say 1/4: errors in closed form
    const scene timed = parse_scene(
        text, "audit.toml", std::vector<std::string>{"output.layers=[\"returns\", \"time\"]"},
        fake::models());
    run_choices choices;
    choices.file = file_;
    choices.is_quiet = true;
    choices.existing = if_exists::replace;
    run_map(timed, choices, {plan_of, {}});
    const map_reader map(file_);
    const audit_report report = audit(
        timed, plan_of(timed), [&](std::uint64_t tile) { return map.tile(tile); }, 1000);
    const std::vector<double> returns = map.read_all("returns");
    std::vector<double> errors;
    for (const double n : returns) errors.push_back(std::abs(0.25 * n - 0.25));
    const auto largest = std::max_element(errors.begin(), errors.end());
    ASSERT_EQ(report.errors.size(), 2u);
    EXPECT_EQ(report.errors[0].layer, "returns");
    EXPECT_EQ(report.errors[0].largest, 0.0);
    EXPECT_EQ(report.errors[1].layer, "time");
    EXPECT_EQ(report.errors[1].unit, "s");
    EXPECT_EQ(report.errors[1].largest, *largest);
    const auto worst = static_cast<std::uint64_t>(largest - errors.begin());
    EXPECT_EQ(report.errors[1].worst, worst);
    EXPECT_EQ(report.worst, worst);
    std::nth_element(errors.begin(), errors.begin() + 500, errors.end());
    EXPECT_EQ(report.errors[1].median, errors[500]);
    EXPECT_EQ(attributes_of(timed, report, "m.h5").back().second,
              "hopscotch replay m.h5 --cell " + cell_text(timed, worst));
}

TEST(confidence, has_the_published_exact_limits) {
    // Clopper and Pearson (1934), as tabulated for n = 10 in Hald's Statistical Tables (1952)
    EXPECT_EQ(confidence_of(0, 10).first, 0.0);
    EXPECT_NEAR(confidence_of(0, 10).second, 0.3085, 5e-5);
    EXPECT_NEAR(confidence_of(1, 10).first, 0.0025, 5e-5);
    EXPECT_NEAR(confidence_of(1, 10).second, 0.4450, 5e-5);
    EXPECT_NEAR(confidence_of(5, 10).first, 0.1871, 5e-5);
    EXPECT_NEAR(confidence_of(5, 10).second, 0.8129, 5e-5);
    EXPECT_EQ(confidence_of(10, 10).second, 1.0);
    EXPECT_EQ(confidence_of(0, 0), (std::pair{0.0, 1.0}));
}

TEST(confidence, has_the_closed_form_of_no_hits_at_any_size) {
    for (const double n : {1.0, 20.0, 1000.0, 1e6, 1e12}) {
        const double closed = -std::expm1(std::log(0.025) / n);  // 1 - 0.025^(1/n)
        const double found = confidence_of(0, static_cast<std::uint64_t>(n)).second;
        EXPECT_NEAR(found / closed, 1.0, 1e-10) << n;
    }
}

TEST(confidence, puts_a_fortieth_of_the_binomial_into_either_tail) {
    constexpr int n = 25;
    for (int hits = 1; hits < n; ++hits) {
        const auto [low, high] = confidence_of(static_cast<std::uint64_t>(hits), n);
        double at_least = 0.0;  // P(X >= hits) at the lowest share
        double at_most = 0.0;   // P(X <= hits) at the highest
        for (int k = 0; k <= n; ++k) {
            const double ways =
                std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0));
            if (k >= hits) at_least += ways * std::pow(low, k) * std::pow(1.0 - low, n - k);
            if (k <= hits) at_most += ways * std::pow(high, k) * std::pow(1.0 - high, n - k);
        }
        EXPECT_NEAR(at_least, 0.025, 1e-12) << hits;
        EXPECT_NEAR(at_most, 0.025, 1e-12) << hits;
    }
}

TEST(exact_decimals, give_back_the_very_double) {
    EXPECT_EQ(exact_decimal(0.1), "1.000000000000000055511151231257827021181583404541015625e-01");
    EXPECT_EQ(exact_decimal(-2.0), "-2e+00");
    EXPECT_EQ(exact_decimal(0.0), "0e+00");
    EXPECT_EQ(exact_decimal(unbounded), "inf");
    EXPECT_EQ(std::stod(exact_decimal(5e-324)), 5e-324);
}
