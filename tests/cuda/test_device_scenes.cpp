// Scenes as a GPU gets them, tile by tile with the tables of their traps, on an emulated device:
// the layers of the scalar backend, bit for bit, whatever decides the orbits.
#include "analysis/labels/plan.hpp"
#include "host/map/rows.hpp"
#include "host/run/requests.hpp"
#include "host/scene/grid.hpp"
#include "tests/cuda/emulated_device.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <stdexcept>
#include <string>
#include <vector>

namespace hopscotch {
namespace {

struct scene_case {
    const char* name;
    const char* cells[2];
    const char* tile;  // smaller than the axis of the parameter points: a tile has few of them
    decision decided_by;
    const char* setting = "accuracy.audit_cells=0";
};

struct tile_layers {
    std::vector<std::int16_t> label;
    std::vector<std::uint8_t> outcome, motion;
    std::vector<std::uint32_t> returns;
    std::vector<double> exponent;

    bool operator==(const tile_layers& other) const {
        const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x == x ? x : 0.5); };
        for (std::size_t i = 0; i < exponent.size(); ++i) {
            if (bits(exponent[i]) != bits(other.exponent[i])) return false;
        }
        return label == other.label && outcome == other.outcome && motion == other.motion &&
               returns == other.returns;
    }
};

tile_layers computed(const scene& scene, const label_plan& plan, const tile_box& box,
                     const model_entry& model, backend which) {
    const map_layout layout = layout_of(scene);
    cell_request cells = request_of(scene, plan, layout, box);
    const std::size_t n = box.n_cells();
    const bool is_chaos = is_chaos_map(scene);
    tile_layers layers{std::vector<std::int16_t>(n), std::vector<std::uint8_t>(n),
                       std::vector<std::uint8_t>(n), std::vector<std::uint32_t>(n),
                       std::vector<double>(n)};
    cells.request.outcome = layers.outcome.data();
    cells.request.returns = layers.returns.data();
    if (is_chaos) {
        cells.request.exponents.motion = layers.motion.data();
        cells.request.exponents.exponents[0] = layers.exponent.data();
    } else {
        cells.request.label = layers.label.data();
    }
    const int variant = variant_of(scene);
    (is_chaos ? model.tangent(which, variant) : model.kernel(which, variant))(cells.request);
    return layers;
}

const model_entry& emulated(std::string_view name) {
    for (const model_entry* model : emulation::emulated_models()) {
        if (model->info->name == name) return *model;
    }
    throw std::runtime_error("no such model");
}

class device_scenes : public testing::TestWithParam<scene_case> {};

TEST_P(device_scenes, have_the_layers_of_the_scalar_backend_whatever_the_tiles) {
    const scene_case& of = GetParam();
    const std::string folder = HOPSCOTCH_SOURCE "/configs/scenes/";
    const std::vector<std::string> overrides{std::string("grid.axis.0.cells=") + of.cells[0],
                                             std::string("grid.axis.1.cells=") + of.cells[1],
                                             std::string("output.tile=") + of.tile, of.setting};
    const scene scene = read_scene(folder + of.name + ".toml", overrides);
    const label_plan plan = plan_labels(scene);
    ASSERT_EQ(plan.decided_by, of.decided_by);
    const model_entry& model = emulated(scene.info().name);
    const map_layout layout = layout_of(scene);
    const tile_box whole{0, {0, 0}, {layout.axes[0].size(), layout.axes[1].size()}};
    const tile_layers whole_map = computed(scene, plan, whole, model, backend::scalar);
    std::uint64_t labelled = 0;
    for (std::uint64_t tile = 0; tile < layout.n_tiles(); ++tile) {
        const tile_box box = box_of(layout, tile);
        const tile_layers want = computed(scene, plan, box, model, backend::scalar);
        for (const auto label : want.label) labelled += label != 0;
        for (const auto motion : want.motion) labelled += motion != 0;
        ASSERT_EQ(computed(scene, plan, box, model, backend::cuda), want) << "tile " << tile;
        for (std::uint64_t place = 0; place < box.n_cells(); ++place) {
            const std::uint64_t cell = offset_in(whole.extent, coordinates_in(box, place));
            ASSERT_EQ(want.label[place], whole_map.label[cell]) << "tile " << tile;
        }
    }
    EXPECT_GT(labelled, layout.n_cells() / 10);  // otherwise this test would show little
}

INSTANTIATE_TEST_SUITE_P(
    all, device_scenes,
    testing::Values(scene_case{"quickstart", {"36", "40"}, "[12, 20]", decision::certificate},
                    scene_case{"chatterjee2002_nonlinear",
                               {"30", "4"},
                               "[15, 2]",
                               decision::intervals,
                               "question.returns=60"},
                    scene_case{
                        "cham2007_fig8_basins", {"36", "40"}, "[12, 20]", decision::ellipsoids},
                    scene_case{"relief_valve_basins",
                               {"2", "24"},
                               "[1, 24]",
                               decision::ellipsoids,
                               "question.returns=60"},
                    scene_case{"chatterjee2002_lyapunov",
                               {"12", "20"},
                               "[12, 20]",
                               decision::returns,
                               "question.returns=400"}),
    [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace hopscotch
