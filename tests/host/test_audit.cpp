// The audit: which cells it looks at, when 50 digits decide, and how sure it is.
#include "host/run/audit.hpp"
#include "host/run/run_map.hpp"
#include "host/run/truth_orbits.hpp"
#include "host/scene/grid.hpp"
#include "host/store/map_reader.hpp"
#include "tests/host/fake_model.hpp"

#include <gtest/gtest.h>

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

TEST(confidence, has_the_published_width_at_the_ends_and_in_the_middle) {
    // Wilson's interval for 0 of 10 and 5 of 10 at 95 %: (0, 0.2775), (0.2366, 0.7634)
    EXPECT_EQ(confidence_of(0, 10).first, 0.0);
    EXPECT_NEAR(confidence_of(0, 10).second, 0.2775, 5e-5);
    EXPECT_NEAR(confidence_of(5, 10).first, 0.2366, 5e-5);
    EXPECT_NEAR(confidence_of(5, 10).second, 0.7634, 5e-5);
    EXPECT_EQ(confidence_of(10, 10).second, 1.0);
    EXPECT_EQ(confidence_of(0, 0), (std::pair{0.0, 1.0}));
}

TEST(exact_decimals, give_back_the_very_double) {
    EXPECT_EQ(exact_decimal(0.1), "1.000000000000000055511151231257827021181583404541015625e-01");
    EXPECT_EQ(exact_decimal(-2.0), "-2e+00");
    EXPECT_EQ(exact_decimal(0.0), "0e+00");
    EXPECT_EQ(exact_decimal(unbounded), "inf");
    EXPECT_EQ(std::stod(exact_decimal(5e-324)), 5e-324);
}
