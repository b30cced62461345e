// Every event and some samples of one orbit as text: what `trace` and `replay` print.
#pragma once

#include "analysis/orbit/orbit_functions.hpp"
#include "kernels/contract/entry.hpp"

#include <string>

namespace hopscotch {

enum class trace_format : std::uint8_t { csv, jsonl };

/// Computes the orbit in double and writes it down.
///
/// CSV columns: record (sample, event or end), time, name, mode_left, mode_entered, the full state
/// (of a sample, or after an event), the state before an event, loss. JSON: one object per record.
/// \param samples  per phase, from its beginning to its end
/// \error std::invalid_argument where the model is built without traces
std::string trace_text(const model_entry& model, const orbit_row& row, int samples,
                       trace_format format);

}  // namespace hopscotch
