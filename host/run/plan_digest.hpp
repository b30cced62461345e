// A short text that tells two plans of labels apart, bit for bit: ranks, shards and resumed runs
// compare it before they work on one map.
#pragma once

#include "host/run/label_plan.hpp"

#include <string>

namespace hopscotch {

/// 16 hexadecimal digits over every number that labels depend on. Plans made cell by cell
/// (label_plan::of_cell) have nothing to compare but their attractors.
std::string plan_digest(const label_plan& plan);

}  // namespace hopscotch
