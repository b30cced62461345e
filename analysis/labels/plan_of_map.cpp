// Reads before it searches.
#include "analysis/labels/plan_of_map.hpp"

#include "analysis/labels/own_labels.hpp"
#include "analysis/labels/plan.hpp"
#include "host/run/open_cells.hpp"
#include "host/run/plan_digest.hpp"
#include "host/run/plan_tables.hpp"

#include <algorithm>

namespace hopscotch {
namespace {

/// A map lists no label of the model's own that none of its cells has; the plan has all of them.
void add_attractors(const scene& scene, const map_reader& map, label_plan& plan) {
    label_plan own;
    if (plan.decided_by == decision::ellipsoids) add_own_labels(scene, own);
    plan.attractors = map.attractors();
    for (const attractor_row& row : own.attractors) {
        const bool is_there =
            std::any_of(plan.attractors.begin(), plan.attractors.end(),
                        [&](const attractor_row& other) { return other.label == row.label; });
        if (!is_there) plan.attractors.push_back(row);
    }
    std::sort(plan.attractors.begin(), plan.attractors.end(),
              [](const auto& a, const auto& b) { return a.label < b.label; });
}

}  // namespace

std::optional<label_plan> stored_plan(const scene& scene, const map_reader& map) {
    const std::optional<table_group> group = map.group(traps_group);
    if (!group) return std::nullopt;
    label_plan plan = plan_from(scene, *group);
    add_attractors(scene, map, plan);
    plan.point_columns = map.point_columns();
    plan.searched = cells_of(map.attribute(searched_cells));
    const std::string* const written = group->attribute("plan_digest");
    if (written == nullptr || *written != plan_digest(plan)) return std::nullopt;
    return plan;
}

plan_with_note plan_of_map(const scene& scene, const map_reader& map) {
    std::string note;
    try {
        if (std::optional<label_plan> plan = stored_plan(scene, map)) return {std::move(*plan), {}};
        if (map.group(traps_group)) note = "the file's traps are not as written: searched anew";
    } catch (const store_error& error) {
        note = std::string(error.what()) + ": searched anew";
    }
    return {plan_labels(scene, cells_of(map.attribute(searched_cells))), note};
}

}  // namespace hopscotch
