// From a model's description of its labels to rows of the attractor table.
#include "analysis/labels/own_labels.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hopscotch {
namespace {

bool ends_at_rest(const model_info& info) {
    return std::any_of(info.outcomes.begin(), info.outcomes.end(),
                       [](outcome end) { return end == outcome::stuck || end == outcome::rest; });
}

}  // namespace

void add_own_labels(const scene& scene, label_plan& plan) {
    constexpr int most_listed = 64;
    label_description text;
    if (scene.model->describe_label != nullptr) {
        for (int label = 1; label <= most_listed && scene.model->describe_label(label, text);
             ++label) {
            attractor_row row{.label = label,
                              .name = text.index < 0 ? std::string(text.kind)
                                                     : fmt::format("{} {}", text.kind, text.index),
                              .period = text.period};
            row.trap = text.trap;
            plan.attractors.push_back(std::move(row));
            text = {};
        }
    } else if (ends_at_rest(scene.info())) {
        plan.attractors.push_back(
            {.label = 1, .name = "rest", .period = 1, .trap = "ends stuck or at rest"});
    }
    if (!plan.attractors.empty()) plan.died_label = 1;
}

}  // namespace hopscotch
