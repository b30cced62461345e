// The plan of a map's labels for commands that look at a finished map.
#pragma once

#include "host/run/label_plan.hpp"
#include "host/scene/scene.hpp"
#include "host/store/map_reader.hpp"

namespace hopscotch {

/// That of `plan_of_map`; where the file's own could not be used, standard error says so.
label_plan told_plan(const scene& scene, const map_reader& map);

}  // namespace hopscotch
