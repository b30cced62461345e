// Branches as CSV, one row per point of every orbit, and as JSON with special points and ends.
#pragma once

#include "analysis/continuation/branch.hpp"
#include "analysis/continuation/branch_equation.hpp"

#include <string>
#include <vector>

namespace hopscotch {

std::string csv_of(const branch_family& family, const std::vector<branch>& branches);
std::string json_of(const branch_family& family, const std::vector<branch>& branches);

/// Rows for a table on the terminal: special points and ends of every branch.
std::vector<std::vector<std::string>> rows_of(const branch_family& family,
                                              const std::vector<branch>& branches);

}  // namespace hopscotch
