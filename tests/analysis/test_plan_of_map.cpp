// The plan that a map stores is the one it was labelled by, bit for bit; a file without it, or with
// other numbers, is searched anew.
#include "analysis/labels/plan.hpp"
#include "analysis/labels/plan_of_map.hpp"
#include "host/run/plan_digest.hpp"
#include "host/run/plan_tables.hpp"
#include "tests/host/scratch_run.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include <hdf5.h>

using namespace hopscotch;

namespace {

class plan_of_a_map : public testing_runs::scratch_run {
protected:
    scene read(const std::string& name, std::vector<std::string> overrides) const {
        overrides.emplace_back("accuracy.audit_cells=0");
        return read_scene(std::string(HOPSCOTCH_SOURCE) + "/configs/scenes/" + name + ".toml",
                          overrides);
    }
    std::filesystem::path map_of(const scene& scene) const {
        run_hooks hooks;
        hooks.plan = plan_labels;
        const run_report report = run_map(scene, choices("map.h5"), hooks);
        EXPECT_TRUE(report.is_finished);
        return report.file;
    }
    /// The plan as it comes back from a map of that scene, and the one of a new search.
    std::pair<label_plan, label_plan> both(const scene& scene) const {
        const std::optional<label_plan> stored = stored_plan(scene, map_reader(map_of(scene)));
        EXPECT_TRUE(stored.has_value());
        return {stored.value_or(label_plan{}), plan_labels(scene)};
    }
};

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

void expect_same(const std::vector<trap_interval>& a, const std::vector<trap_interval>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_TRUE(same_bits(a[i].lowest, b[i].lowest) && same_bits(a[i].highest, b[i].highest));
        EXPECT_EQ(a[i].label, b[i].label);
    }
}

void expect_same(const std::vector<attractor_row>& a, const std::vector<attractor_row>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].label, b[i].label);
        EXPECT_EQ(a[i].name, b[i].name);
        EXPECT_EQ(a[i].period, b[i].period);
        EXPECT_EQ(a[i].points, b[i].points);
        EXPECT_EQ(a[i].multipliers_real, b[i].multipliers_real);
        EXPECT_EQ(a[i].multipliers_imaginary, b[i].multipliers_imaginary);
        EXPECT_EQ(a[i].trap, b[i].trap);
    }
}

}  // namespace

TEST_F(plan_of_a_map, has_the_ellipsoids_of_every_parameter_point) {
    // speeds from below the saddle-node on, so that points differ in how many attractors they have
    const scene scene =
        read("ghigliazza2005_basins", {"grid.axis.0.cells=12", "grid.axis.1.cells=12"});
    const auto [stored, searched] = both(scene);
    ASSERT_GT(searched.n_ellipsoids, 0);
    ASSERT_EQ(stored.ellipsoids.size(), searched.ellipsoids.size());
    for (std::size_t i = 0; i < stored.ellipsoids.size(); ++i) {
        const trap_ellipsoid& a = stored.ellipsoids[i];
        const trap_ellipsoid& b = searched.ellipsoids[i];
        ASSERT_EQ(a.n_columns, b.n_columns);
        EXPECT_EQ(a.label, b.label);
        for (int k = 0; k < a.n_columns; ++k) EXPECT_TRUE(same_bits(a.centre[k], b.centre[k]));
        for (int k = 0; k < a.n_columns * a.n_columns; ++k) {
            EXPECT_TRUE(same_bits(a.shape[k], b.shape[k]));
        }
    }
    EXPECT_EQ(stored.point_axes, searched.point_axes);
    EXPECT_EQ(stored.died_label, searched.died_label);
    EXPECT_EQ(stored.decided_by, searched.decided_by);
    expect_same(stored.attractors, searched.attractors);
    EXPECT_EQ(plan_digest(stored), plan_digest(searched));
}

TEST_F(plan_of_a_map, has_the_intervals_and_immediate_basins) {
    const scene scene = read("chatterjee2002_fig8", {"grid.axis.0.cells=3", "grid.axis.1.cells=20",
                                                     "question.kind=one_sided"});
    const auto [stored, searched] = both(scene);
    ASSERT_FALSE(searched.traps.empty());
    expect_same(stored.traps, searched.traps);
    expect_same(stored.immediate, searched.immediate);
    ASSERT_EQ(stored.placed.size(), searched.placed.size());
    for (std::size_t i = 0; i < stored.placed.size(); ++i) {
        EXPECT_EQ(stored.placed[i].point, searched.placed[i].point);
        EXPECT_EQ(stored.placed[i].label, searched.placed[i].label);
        EXPECT_EQ(stored.placed[i].points, searched.placed[i].points);
    }
    EXPECT_EQ(stored.n_traps, searched.n_traps);
    EXPECT_EQ(stored.n_immediate, searched.n_immediate);
    EXPECT_EQ(plan_digest(stored), plan_digest(searched));
}

TEST_F(plan_of_a_map, has_the_boxes_of_chaotic_sets) {
    // chaos beside period 1 (models/openloop_hopper.md)
    const scene scene =
        read("cham2007_fig8_basins",
             {"model.parameters.thrust_time=0.2", "model.parameters.stride_period=0.24",
              "grid.axis.0.cells=6", "grid.axis.1.cells=6", "question.samples=32"});
    const auto [stored, searched] = both(scene);
    ASSERT_EQ(searched.chaotic.size(), 1u);
    ASSERT_EQ(stored.chaotic.size(), 1u);
    const state_cover& a = stored.chaotic[0].cover;
    const state_cover& b = searched.chaotic[0].cover;
    EXPECT_EQ(a.box_places(), b.box_places());
    constexpr int n = 100;  // states in and around the hull
    std::size_t n_inside = 0;
    for (int i = 0; i < n * n; ++i) {
        std::array<double, 2> x{};
        for (std::size_t c = 0; c < 2; ++c) {
            const double share = 1.4 * (c == 0 ? i / n : i % n) / n - 0.2;
            x[c] = b.lowest()[c] + share * (b.highest()[c] - b.lowest()[c]);
        }
        EXPECT_EQ(a.holds(x), b.holds(x)) << x[0] << " " << x[1];
        n_inside += b.holds(x) ? 1 : 0;
    }
    EXPECT_GT(n_inside, 0u);
    EXPECT_LT(n_inside, std::size_t{n * n});
    EXPECT_EQ(plan_digest(stored), plan_digest(searched));
}

TEST_F(plan_of_a_map, is_searched_anew_where_the_file_has_none_or_another) {
    const scene scene =
        read("ghigliazza2005_basins", {"grid.axis.0.cells=4", "grid.axis.1.cells=4"});
    const std::filesystem::path file = map_of(scene);
    const std::string digest = plan_digest(plan_labels(scene));
    const auto edit = [&](auto&& change) {
        const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
        ASSERT_GE(opened, 0);
        change(opened);
        H5Fclose(opened);
    };
    edit([](hid_t opened) {
        const hid_t centre = H5Dopen2(opened, "/traps/centre", H5P_DEFAULT);
        std::vector<double> values(
            static_cast<std::size_t>(H5Sget_simple_extent_npoints(H5Dget_space(centre))));
        H5Dread(centre, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
        const auto found =
            std::find_if(values.begin(), values.end(), [](double x) { return x > 0; });
        ASSERT_NE(found, values.end());
        *found = std::nextafter(*found, 0.0);
        H5Dwrite(centre, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
        H5Dclose(centre);
    });
    EXPECT_FALSE(stored_plan(scene, map_reader(file)).has_value());
    EXPECT_NE(plan_of_map(scene, map_reader(file)).note.find("not as written"), std::string::npos);
    EXPECT_EQ(plan_digest(plan_of_map(scene, map_reader(file)).plan), digest);
    edit([](hid_t opened) { H5Ldelete(opened, "/traps", H5P_DEFAULT); });
    EXPECT_FALSE(stored_plan(scene, map_reader(file)).has_value());
    EXPECT_EQ(plan_digest(plan_of_map(scene, map_reader(file)).plan), digest);
}
