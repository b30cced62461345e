// Reads a map's label layer (or outcomes, or another layer of few values) as classes, tile by tile.
#pragma once

#include "analysis/metrics/class_grid.hpp"
#include "host/store/map_reader.hpp"
#include "kernels/contract/outcome.hpp"

#include <string>

namespace hopscotch::metrics {

/// An orbit that ended by a failure: not at rest, not by its budget, not outside the domain.
bool is_failure(outcome end);

/// What cells without a label become where the map says how they ended.
enum class fall_rule : std::uint8_t {
    separate,  // a class for every kind of failure
    together,  // one class "failure"
    left_out   // undecided: no part of any metric
};

struct class_choice {
    std::string layer;  // empty: `label`, or `outcome` where the map has no labels
    fall_rule falls = fall_rule::separate;
};

/// Cells of a labelled map: label > 0 is a class; label 0 with an outcome that decides is one too
/// (failures as `falls` says); `invalid_start` lies outside the domain; everything else (`budget`,
/// `unresolved_event`, `not_finite`, no label) is undecided. Of the layer `outcome` every value
/// that decides is a class; of other layers every value is.
///
/// \error  store_error for a layer that is absent or holds no integers, for more than three axes
///         (of more than one cell), and for a layer of more than 254 values
class_grid read_classes(const map_reader& map, const class_choice& choice = {});

/// The name of the layer that `choice` means.
std::string layer_of(const map_reader& map, const class_choice& choice);

}  // namespace hopscotch::metrics
