// Fold, flip and Neimark-Sacker curves over two variables as CSV, JSON and picture.
#pragma once

#include "analysis/continuation/bifurcation_curve.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace hopscotch {

std::string csv_of(const branch_family& family, const branch_variable& second,
                   const std::vector<bifurcation_curve>& curves);
std::string json_of(const branch_family& family, const branch_variable& second,
                    const std::vector<bifurcation_curve>& curves);
std::vector<std::vector<std::string>> rows_of(const branch_family& family,
                                              const branch_variable& second,
                                              const std::vector<bifurcation_curve>& curves);

/// The second variable over the first.
///
/// \error  store_error where the picture cannot be written
void draw_curves(const branch_family& family, const branch_variable& second,
                 const std::vector<bifurcation_curve>& curves, const std::string& title,
                 const std::filesystem::path& png);

}  // namespace hopscotch
