// From a scene that asks for branches to what is to be followed.
#pragma once

#include "analysis/continuation/find_branches.hpp"
#include "host/scene/scene.hpp"

#include <optional>

namespace hopscotch {

struct scene_study {
    branch_study study;
    std::optional<branch_variable> second;  // of fold and flip curves
    int shown_column = 0;                   // the one that pictures show
};

/// The first axis that names a parameter or a column which the map conserves is the variable, the
/// second such axis that of fold and flip curves (branches then stand at its middle); axes of other
/// columns say where starts are sampled.
///
/// \error  scene_error where the question is another one, the section is start-only, or no axis can
///         be the variable
scene_study study_of(const scene& scene);

}  // namespace hopscotch
