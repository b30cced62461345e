// Which events an orbit meets, in which order: where this changes along a branch, the return map
// has a kink or a jump (a border collision).
#pragma once

#include "analysis/periodic/map_point.hpp"

#include <span>
#include <string>

namespace hopscotch {

/// The events of so many returns as a word: the model's letters where one of its extras is spelt by
/// events, else the events' names; repetitions are counted. Equal words are equal sequences.
std::string event_signature(const map_point& map, std::span<const double> x, int returns);

}  // namespace hopscotch
