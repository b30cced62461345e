// Reads a branch study off a scene.
#include "analysis/continuation/scene_study.hpp"

#include "host/scene/grid.hpp"
#include "host/scene/layers.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace hopscotch {
namespace {

[[noreturn]] void refuse(const scene& scene, const std::string& key, const std::string& value,
                         const std::string& why, const std::string& suggestion) {
    throw scene_error({scene.question.place, key, value, why, suggestion});
}

map_point map_of(const scene& scene) {
    map_point map{.model = scene.model, .section = scene.section, .options = scene.options};
    const parameter_extremes extremes = extremes_of(scene);
    map.variant = scene.model->variant(
        {extremes.lowest.data(), extremes.highest.data(), scene.options.data(), true});
    map.parameters = scene.parameters;
    map.max_steps = static_cast<double>(scene.accuracy.max_events);
    for (const scene_axis& axis : scene.axes) {
        if (axis.kind != axis_kind::parameter) continue;
        map.parameters[static_cast<std::size_t>(axis.index)] = 0.5 * (axis.lowest + axis.highest);
    }
    return map;
}

std::vector<sampled_column> samples_of(const scene& scene) {
    std::vector<sampled_column> samples;
    for (const double start : scene.start) samples.push_back({start, start, 1});
    for (const scene_axis& axis : scene.axes) {
        if (axis.kind != axis_kind::column) continue;
        samples[static_cast<std::size_t>(axis.index)] = {axis.lowest, axis.highest,
                                                         static_cast<int>(axis.cells)};
    }
    return samples;
}

/// Axes that can be variables, in the scene's order.
std::vector<const scene_axis*> variable_axes(const scene& scene, const map_point& map,
                                             const std::vector<sampled_column>& samples) {
    const std::vector<int> conserved = conserved_columns_of(map, samples);
    std::vector<const scene_axis*> axes;
    for (const scene_axis& axis : scene.axes) {
        const bool is_conserved =
            std::find(conserved.begin(), conserved.end(), axis.index) != conserved.end();
        if (axis.kind == axis_kind::parameter || is_conserved) axes.push_back(&axis);
    }
    return axes;
}

branch_variable variable_of(const scene_axis& axis) {
    return {axis.kind == axis_kind::column, axis.index, axis.lowest, axis.highest};
}

/// The first state column that the scene's layers name and that is solved for.
int shown_column_of(const scene& scene, const branch_family& family) {
    for (const layer_plan& layer : chosen_layers(scene)) {
        const bool is_unknown = std::find(family.columns.begin(), family.columns.end(),
                                          layer.index) != family.columns.end();
        if (layer.role == layer_role::state && is_unknown) return layer.index;
    }
    return family.columns.front();
}

}  // namespace

scene_study study_of(const scene& scene) {
    if (scene.question.kind != "branch") {
        refuse(scene, "question.kind", "\"" + scene.question.kind + "\"",
               "branches are followed for the question branch", "\"branch\"");
    }
    if (&scene.start_section() != &scene.end_section()) {
        refuse(scene, "grid.section", fmt::format("\"{}\"", scene.start_section().name),
               "returns do not end on it", fmt::format("\"{}\"", scene.end_section().name));
    }
    const map_point map = map_of(scene);
    scene_study result;
    branch_study& study = result.study;
    study.samples = samples_of(scene);
    const auto axes = variable_axes(scene, map, study.samples);
    if (axes.empty()) {
        refuse(scene, "grid.axis", "",
               "no axis is a parameter or a column that the return map conserves",
               "an axis to follow branches over");
    }
    study.family = family_of(map, variable_of(*axes[0]), study.samples);
    if (study.family.columns.empty())
        refuse(scene, "grid.section", "", "the return map conserves every column", "");
    if (axes.size() > 1) result.second = variable_of(*axes[1]);
    const scene_question& question = scene.question;
    study.most_period = static_cast<int>(question.number("period", 1.0));
    study.doublings = static_cast<int>(question.number("doublings", 1.0));
    study.settling = static_cast<int>(question.number("settling", 200.0));
    study.stations = static_cast<int>(axes[0]->cells);
    study.limits.step = question.number("step", 0.01);
    result.shown_column = shown_column_of(scene, study.family);
    return result;
}

}  // namespace hopscotch
