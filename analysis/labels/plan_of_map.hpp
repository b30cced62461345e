// The plan by which a map was labelled, for whoever looks at its cells again: `verify`,
// `replay`, `analyse` and the table of sides.
#pragma once

#include "host/run/label_plan.hpp"
#include "host/scene/scene.hpp"
#include "host/store/map_reader.hpp"

#include <optional>
#include <string>

namespace hopscotch {

/// The plan as the map stores it in /attractors and /traps, bit for bit; none where it does not
/// (files of earlier versions, unfinished maps, plans that need no search or are too large), or
/// where the numbers are not those that the run has written.
std::optional<label_plan> stored_plan(const scene& scene, const map_reader& map);

struct plan_with_note {
    label_plan plan;
    std::string note;  // for the user, where the file's traps could not be used; else empty
};

/// The stored plan, or else that of the same search once more.
plan_with_note plan_of_map(const scene& scene, const map_reader& map);

}  // namespace hopscotch
