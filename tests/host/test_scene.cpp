// What a scene holds after reading: defaults, overrides, layers, tiles, and a fingerprint that
// changes exactly with what decides the map's numbers.
#include "host/scene/grid.hpp"
#include "host/scene/layers.hpp"
#include "host/scene/suggest.hpp"
#include "tests/host/fake_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace hopscotch;

namespace {

const char* const plain = R"([scene]
name = "plain"
[model]
name = "fake_bouncer"
[[grid.axis]]
name = "height"
min = 0.0
max = 2.0
cells = 8
[[grid.axis]]
name = "offset"
min = -1
max = 1
cells = 4
[start]
speed = 3
[question]
kind = "return_map"
)";

scene read(const std::vector<std::string>& overrides = {}, const std::string& text = plain) {
    return parse_scene(text, "dir/plain.toml", overrides, fake::models());
}

}  // namespace

TEST(scene, fills_in_every_default) {
    const scene scene = read();
    EXPECT_EQ(scene.parameters, (std::vector<double>{0.5, 0.0, 1.0}));
    EXPECT_EQ(scene.options, std::vector<int>{0});
    EXPECT_EQ(scene.start_section().name, "apex");
    EXPECT_TRUE(std::isnan(scene.start[0]));
    EXPECT_EQ(scene.start[1], 3.0);
    EXPECT_EQ(scene.axes[1].kind, axis_kind::parameter);
    EXPECT_EQ(scene.question.returns, 1u);
    EXPECT_EQ(scene.accuracy.max_events, 100000u);
    EXPECT_EQ(scene.output.file, "plain.h5");
    EXPECT_EQ(scene.n_cells(), 32u);
}

TEST(scene, overrides_replace_values_before_anything_is_checked) {
    const scene scene =
        read({"grid.axis.0.cells=512", "grid.axis[1].max=5", "model.parameters.gain=2",
              "model.options.law=steep", "output.file=other.h5", "accuracy.max_events=1e6"});
    EXPECT_EQ(scene.axes[0].cells, 512u);
    EXPECT_EQ(scene.axes[1].highest, 5.0);
    EXPECT_EQ(scene.parameters[0], 2.0);
    EXPECT_EQ(scene.options[0], 1);
    EXPECT_EQ(scene.output.file, "other.h5");
    EXPECT_EQ(scene.accuracy.max_events, 1000000u);
}

TEST(scene, an_override_may_add_an_axis) {
    const scene scene = read({"grid.axis.2.name=mass_ratio", "grid.axis.2.min=1",
                              "grid.axis.2.max=2", "grid.axis.2.cells=3"});
    EXPECT_EQ(scene.axes.size(), 3u);
    EXPECT_EQ(scene.n_cells(), 96u);
}

TEST(scene, a_section_that_only_starts_orbits_stores_the_columns_it_returns_to) {
    const std::string text = R"([model]
name = "fake_bouncer"
[grid]
section = "launch"
[[grid.axis]]
name = "angle"
min = 0
max = 1
cells = 4
[question]
kind = "return_map"
)";
    EXPECT_EQ(read({}, text).output.layers,
              (std::vector<std::string>{"height", "speed", "outcome"}));
}

TEST(scene, a_state_layer_never_takes_the_name_of_an_axis) {
    const scene scene = read({"output.layers=[\"height\", \"speed\"]"});
    EXPECT_EQ(scene.output.layers, (std::vector<std::string>{"last_height", "speed", "outcome"}));
    EXPECT_EQ(layout_of(scene).layers[0].unit, "m");
}

TEST(scene, a_labelled_map_always_stores_label_and_outcome) {
    const scene scene = read({"question.kind=basins", "output.layers=[\"time\"]"});
    EXPECT_EQ(scene.output.layers, (std::vector<std::string>{"time", "label", "outcome"}));
}

TEST(scene, tiles_of_small_maps_shrink_so_that_threads_can_share_them) {
    EXPECT_EQ(read().output.tile, (std::vector<std::uint64_t>{8, 4}));
    EXPECT_EQ(read({"grid.axis.0.cells=4096", "grid.axis.1.cells=4096"}).output.tile,
              (std::vector<std::uint64_t>{256, 256}));
    EXPECT_EQ(read({"grid.axis.0.cells=256", "grid.axis.1.cells=256"}).output.tile,
              (std::vector<std::uint64_t>{32, 32}));
    EXPECT_EQ(read({"output.tile=[3, 100]"}).output.tile, (std::vector<std::uint64_t>{3, 4}));
}

TEST(scene_fingerprint, stays_when_only_places_titles_and_shapes_change) {
    const std::string reference = read().fingerprint;
    EXPECT_EQ(reference.size(), 32u);
    for (const char* same :
         {"output.file=x.h5", "output.compression=9", "output.tile=[2, 2]", "scene.title=other",
          "accuracy.audit_cells=7", "model.parameters.gain=0.5", "model.options.law=plain",
          "grid.section=apex", "grid.axis.0.max=2"}) {
        EXPECT_EQ(read({same}).fingerprint, reference) << same;
    }
}

TEST(scene_fingerprint, changes_with_everything_that_decides_numbers) {
    const std::string reference = read().fingerprint;
    for (const char* other :
         {"model.parameters.gain=0.50000000000000011", "model.options.law=steep",
          "grid.axis.0.max=3", "grid.axis.0.cells=9", "grid.axis.0.edges=true", "start.speed=2",
          "question.returns=2", "question.kind=basins", "accuracy.max_events=7",
          "accuracy.tolerance=1e-9"}) {
        EXPECT_NE(read({other}).fingerprint, reference) << other;
    }
}

TEST(scene_fingerprint, changes_with_the_tolerance_only_where_a_flow_is_integrated) {
    const std::string steep = "model.options.law=steep";  // not integrated
    EXPECT_NE(read({"accuracy.tolerance=1e-9"}).fingerprint, read().fingerprint);
    EXPECT_EQ(read({steep, "accuracy.tolerance=1e-9"}).fingerprint, read({steep}).fingerprint);
}

TEST(scene_fingerprint, knows_which_variants_of_the_models_integrate) {
    const auto depends = [](const std::string& scene, const std::vector<std::string>& overrides) {
        const std::string file = HOPSCOTCH_SOURCE "/configs/scenes/" + scene + ".toml";
        std::vector<std::string> looser = overrides;
        looser.push_back("accuracy.tolerance=1e-7");
        return read_scene(file, overrides, all_models()).fingerprint !=
               read_scene(file, looser, all_models()).fingerprint;
    };
    EXPECT_TRUE(depends("ghigliazza2005_gravity", {}));
    EXPECT_FALSE(depends("ghigliazza2005_gravity", {"model.options.stance_gravity=off"}));
    EXPECT_TRUE(depends("relief_valve", {}));
    EXPECT_FALSE(depends("quickstart", {}));
}

TEST(suggest, finds_the_closest_name_and_lists_all_where_none_is_close) {
    const std::vector<std::string_view> known{"restitution", "mass_ratio", "stiffness"};
    EXPECT_EQ(suggest("mas_ratio", known), "mass_ratio");
    EXPECT_EQ(suggest("restituiton", known), "restitution");
    EXPECT_EQ(suggest("ratio", known), "mass_ratio");
    EXPECT_EQ(suggest("xyz", known), "one of restitution, mass_ratio, stiffness");
    EXPECT_EQ(edit_distance("abcd", "abdc"), 1);
}
