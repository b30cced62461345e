// Labels by period alone, for maps over parameters in which almost every cell is a parameter point
// of its own: what it settles on is searched cell by cell, and one label stands for one period.
#pragma once

#include "host/run/label_plan.hpp"
#include "host/scene/scene.hpp"

namespace hopscotch {

/// \error  the plan keeps a reference to the scene
label_plan plan_by_period(const scene& scene);

}  // namespace hopscotch
