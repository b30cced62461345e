#include "host/cli/map_plan.hpp"

#include "analysis/labels/plan_of_map.hpp"

#include <utility>

#include <fmt/format.h>

namespace hopscotch {

label_plan told_plan(const scene& scene, const map_reader& map) {
    plan_with_note found = plan_of_map(scene, map);
    if (!found.note.empty()) fmt::print(stderr, "hopscotch: {}\n", found.note);
    return std::move(found.plan);
}

}  // namespace hopscotch
