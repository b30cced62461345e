// The layers that a scene's map can have.
#include "host/scene/layers.hpp"

#include "host/map/certainty.hpp"
#include "analysis/orbit/orbit_functions.hpp"
#include "kernels/contract/motion.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace hopscotch {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

template <std::size_t N>
std::vector<std::pair<int, std::string>> flags_of(const std::array<std::string_view, N>& names) {
    std::vector<std::pair<int, std::string>> flags;
    for (std::size_t code = 0; code < N; ++code) {
        flags.emplace_back(static_cast<int>(code), std::string(names[code]));
    }
    return flags;
}

layer_plan plan(layer_role role, std::string name, number_type type, std::string unit,
                std::string meaning, double fill, int index = 0) {
    return {{std::move(name), type, std::move(unit), std::move(meaning), fill, {}, false},
            role,
            index,
            ""};
}

layer_plan state_plan(const scene& scene, int index) {
    const column_info& column = scene.end_section().columns[static_cast<std::size_t>(index)];
    const std::string name(column.name);
    layer_plan result = plan(
        layer_role::state, name, number_type::float64, std::string(column.unit),
        std::string(column.meaning) +
            (scene.question.kind == "orbit_diagram" ? ", recorded" : ", after the last return"),
        nan, index);
    // an orbit diagram's axes after the first are starts, not axes of its file
    const auto last =
        scene.question.kind == "orbit_diagram" ? scene.axes.begin() + 1 : scene.axes.end();
    const auto has_name = [&](const auto& axis) { return axis.name == name; };
    const bool is_axis = std::any_of(scene.axes.begin(), last, has_name) ||
                         std::any_of(scene.sweep.axes.begin(), scene.sweep.axes.end(), has_name);
    if (is_axis) {
        result.alias = name;  // a dimension scale of that name is already in the file
        result.description.name = "last_" + name;
    }
    return result;
}

/// The layers of a chaos map: one exponent per column of the section.
void add_exponents(const scene& scene, std::vector<layer_plan>& layers) {
    const auto number = number_type::float64;
    layers.push_back(plan(layer_role::motion, "motion", number_type::int8, "1",
                          "what the largest Lyapunov exponent says", -1.0));
    layers.back().description.flags = flags_of(motion_names);
    layers.push_back(plan(layer_role::exponent, "lyapunov", number, "1",
                          "largest Lyapunov exponent (at fixed conserved columns), per return",
                          nan));
    const int n_columns = static_cast<int>(scene.end_section().columns.size());
    for (int k = 1; k < n_columns; ++k) {
        const std::string place = std::to_string(k + 1);
        layers.push_back(plan(layer_role::exponent, "lyapunov_" + place, number, "1",
                              "Lyapunov exponent " + place + ", per return", nan, k));
    }
    layers.push_back(plan(layer_role::exponent_error, "lyapunov_error", number, "1",
                          "standard error of the largest exponent, from block means", nan));
    const std::string unit(scene.info().time_unit);
    layers.push_back(plan(layer_role::exponent_rate, "lyapunov_rate", number,
                          unit == "1" ? unit : unit + "-1",
                          "largest Lyapunov exponent, per unit of time", nan));
    layers.push_back(plan(layer_role::exponent_returns, "lyapunov_returns", number_type::int32, "1",
                          "returns that the exponents rest on", -1.0));
}

/// What orbits are watched for, one by one: at the model's contact, and in their tangent space.
void add_surveys(const scene& scene, std::vector<layer_plan>& layers) {
    if (scene.model->orbits_table == nullptr) return;
    const auto number = number_type::float64;
    const contact_info* contact = scene.model->contact;
    if (scene.model->has_gap) {
        const std::string gap = " of the gap (" + std::string(contact->meaning) +
                                ") between the orbit's contacts; NaN where there is none";
        layers.push_back(plan(layer_role::clearance, "min_clearance", number,
                              std::string(contact->gap_unit),
                              "smallest local minimum" + gap + ": 0 is a grazing contact", nan));
        layers.push_back(plan(layer_role::hop_height, "min_hop_height", number,
                              std::string(contact->gap_unit), "smallest local maximum" + gap, nan));
    }
    if (contact != nullptr) {
        layers.push_back(plan(layer_role::impact_speed, "impact_speed", number,
                              std::string(contact->speed_unit),
                              "largest speed of an " + std::string(contact->event) +
                                  " of the orbit; NaN where there is none",
                              nan));
    }
    if (scene.model->orbits().jet == nullptr) return;
    layers.push_back(plan(layer_role::finite_exponent, "exponent", number, "1",
                          "finite-time Lyapunov exponent log |DP^n| / n of the orbit's n completed "
                          "returns (Frobenius norm)",
                          nan));
}

}  // namespace

std::vector<layer_plan> available_layers(const scene& scene) {
    std::vector<layer_plan> layers;
    if (scene.question.has_labels) {
        layers.push_back(plan(layer_role::label, "label", number_type::int16, "1",
                              "attractor that the orbit tends to (0 = none found)", -1.0));
        layers.push_back(plan(layer_role::period, "period", number_type::int16, "1",
                              "period of that attractor in returns (0 = aperiodic or none)", -1.0));
    }
    if (scene.question.kind == "one_sided" && scene.model->branch) {  // intervals of one column
        layers.push_back(
            plan(layer_role::immediate, "immediate", number_type::int16, "1",
                 "attractor in whose immediate one-sided basin the start lies (0 = none)", -1.0));
        layers.back().description.holds_labels = true;
    }
    if (scene.question.kind == "lyapunov") add_exponents(scene, layers);
    layers.push_back(plan(layer_role::outcome, "outcome", number_type::int8, "1",
                          "why the orbit's computation ended", -1.0));
    layers.back().description.flags = flags_of(outcome_names);
    if (scene.refine > 0) {
        layers.push_back(plan(layer_role::level, "level", number_type::int8, "1",
                              "round of refinement in which the cell was computed, 0 = coarse grid "
                              "(-2 = not computed itself: it has the label and outcome of the cell "
                              "whose block it lies in)",
                              -1.0));
    }
    const int n_columns = static_cast<int>(scene.end_section().columns.size());
    if (scene.question.kind == "orbit_diagram") {
        for (int index = 0; index < n_columns; ++index) layers.push_back(state_plan(scene, index));
        return layers;
    }
    layers.push_back(plan(layer_role::uncertain, "uncertain", number_type::int8, "1",
                          "whether the answer changes when the start moves by a few roundings",
                          -1.0));
    layers.back().description.flags = flags_of(certainty_names);
    layers.push_back(
        plan(layer_role::returns, "returns", number_type::int32, "1", "completed returns", -1.0));
    layers.push_back(plan(layer_role::events, "events", number_type::int32, "1",
                          "resets and mode changes", -1.0));
    layers.push_back(plan(layer_role::time, "time", number_type::float64,
                          std::string(scene.info().time_unit), "time from the start to the end",
                          nan));
    for (int index = 0; index < n_columns; ++index) layers.push_back(state_plan(scene, index));
    int index = 0;
    for (const extra_info& extra : scene.info().extras) {
        if (extra.is_word()) {  // only `eval` can spell it
            ++index;
            continue;
        }
        layers.push_back(plan(layer_role::extra, std::string(extra.name), number_type::float64,
                              std::string(extra.unit), std::string(extra.meaning), nan, index++));
    }
    if (scene.question.kind != "lyapunov") add_surveys(scene, layers);
    const auto n_long = std::count_if(scene.axes.begin(), scene.axes.end(),
                                      [](const scene_axis& axis) { return axis.cells > 1; });
    const bool can_fall = scene.question.has_labels || scene.question.kind == "steps_to_fall";
    if (can_fall && n_long <= 3) {  // distances are transformed over up to three axes
        layers.push_back(
            plan(layer_role::failing_distance, "failing_distance", number_type::float64, "1",
                 "distance to the nearest cell whose orbit fails, in cells of the grid "
                 "(0 at such a cell; infinite where none fails)",
                 nan));
    }
    return layers;
}

std::vector<layer_plan> chosen_layers(const scene& scene) {
    const std::vector<layer_plan> available = available_layers(scene);
    std::vector<layer_plan> chosen;
    for (const std::string& name : scene.output.layers) {
        for (const layer_plan& layer : available) {
            if (layer.description.name == name) chosen.push_back(layer);
        }
    }
    return chosen;
}

}  // namespace hopscotch
