// The answer to a scene that asks for branches, as the command `branch` puts it out.
#pragma once

#include "host/scene/scene.hpp"

#include <string>
#include <vector>

namespace hopscotch {

struct branch_answer {
    std::vector<std::vector<std::string>> table;  // special points and ends, with a heading
    std::string csv;                              // every point of every orbit
    std::string json;

    // of fold, flip and Neimark-Sacker curves; empty where the scene has no second variable
    std::vector<std::vector<std::string>> curve_table;
    std::string curve_csv;
};

/// Follows the scene's branches and curves and draws them.
///
/// \param stem  of the pictures: STEM.png and, with a second variable, STEM_curves.png
/// \error  scene_error where the scene asks for something else; store_error for the picture
branch_answer follow_branches(const scene& scene, const std::string& stem);

}  // namespace hopscotch
