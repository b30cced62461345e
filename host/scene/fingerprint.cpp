// One number for everything that decides a map's numbers: tiles of an interrupted run are taken up
// again only under the same fingerprint. File name, compression, tile shape, layers, titles and the
// audit leave every number as it is and do not enter (the store compares tiles and layers by
// itself), nor does the tolerance where no flow is integrated.
#include "host/map/text_hash.hpp"
#include "host/scene/grid.hpp"
#include "host/scene/readers.hpp"
#include "host/scene/sweep.hpp"

#include <fmt/format.h>

namespace hopscotch {
namespace {

/// Does the tolerance decide any number of this map?
bool integrates(const scene& scene) {
    if (scene.model->integrates == nullptr) return false;
    const parameter_extremes extremes = extremes_of(scene);
    return scene.model->integrates(scene.model->variant(
        {extremes.lowest.data(), extremes.highest.data(), scene.options.data()}));
}

std::string sweep_text(const scene_sweep& sweep) {
    std::string text = fmt::format("sweep {}\n", sweep.is_zip ? "zip" : "product");
    for (const sweep_axis& axis : sweep.axes) {
        text += fmt::format("sweep_axis {} {:a}\n", axis.name, fmt::join(axis.values, " "));
    }
    return text;
}

/// The scene in a form in which two scenes with the same numbers read the same.
std::string canonical(const scene& scene) {
    std::string text = fmt::format("model {}\n", scene.info().name);
    const auto parameters = scene.info().parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        text += fmt::format("parameter {} {:a}\n", parameters[i].name, scene.parameters[i]);
    }
    const auto options = scene.info().options;
    for (std::size_t i = 0; i < options.size(); ++i) {
        const auto choice = static_cast<std::size_t>(scene.options[i]);
        text += fmt::format("option {} {}\n", options[i].name, options[i].choices[choice]);
    }
    text += fmt::format("section {}\n", scene.start_section().name);
    for (const scene_axis& axis : scene.axes) {
        text += fmt::format("axis {} {:a} {:a} {} {} {}\n", axis.name, axis.lowest, axis.highest,
                            axis.cells, axis.scale == axis_scale::log ? "log" : "linear",
                            axis.edges ? "edges" : "centres");
    }
    const auto columns = scene.start_section().columns;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        text += fmt::format("start {} {:a}\n", columns[i].name, scene.start[i]);
    }
    text += fmt::format("question {} {}\n", scene.question.kind, scene.question.returns);
    for (const auto& [name, number] : scene.question.numbers) {
        text += fmt::format("number {} {:a}\n", name, number);
    }
    text +=
        fmt::format("accuracy {} {:a} {}\n", scene.accuracy.precision,
                    integrates(scene) ? scene.accuracy.tolerance : 0.0, scene.accuracy.max_events);
    if (scene.refine > 0) text += fmt::format("refine {}\n", scene.refine);
    if (is_sweep(scene)) text += sweep_text(scene.sweep);
    return text;
}

}  // namespace

std::string fingerprint_of(const scene& scene) { return text_hash(canonical(scene)); }

}  // namespace hopscotch
