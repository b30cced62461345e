// The event word of an orbit: one letter per event, spelt while the orbit is traced. Used by `eval`
// for models whose extras hold such a word.
#pragma once

#include "analysis/orbit/orbit_functions.hpp"
#include "kernels/contract/entry.hpp"

#include <string>

namespace hopscotch {

/// Letters of all events of the orbit, in order. Events without a letter leave none.
std::string event_word(const model_entry& model, const extra_info& word, const orbit_row& row);

}  // namespace hopscotch
