// Errors of a map's numeric layers (returns, events, time, state, extras, exponents) at cells that
// were computed again in higher precision: the audit's second half, beside the labels.
#pragma once

#include "analysis/orbit/orbit_functions.hpp"
#include "host/scene/layers.hpp"
#include "host/scene/scene.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hopscotch {

/// Absolute errors of one layer, in its unit. Infinite where either computation has no number.
struct layer_error {
    std::string layer;
    std::string unit;
    double median = 0.0;
    double largest = 0.0;
    std::uint64_t worst = 0;  // the cell of the largest error
    double relative = 0.0;    // the largest error over the layer's median size, 0 where that is 0
};

/// The layers of the scene's map whose errors mean something, in the map's order.
std::vector<layer_plan> numeric_layers(const scene& scene);

/// |stored - computed| of each of `layers` for one cell; a phase is compared to the nearest turn.
std::vector<double> errors_of(const scene& scene, std::span<const layer_plan> layers,
                              std::span<const double> stored, const orbit_answer& computed,
                              std::span<const double> parameters);
std::vector<double> errors_of(std::span<const layer_plan> layers, std::span<const double> stored,
                              const exponent_answer& computed);

/// One cell's share in the statistics.
struct cell_errors {
    std::uint64_t cell = 0;
    std::vector<double> stored;  // one per layer
    std::vector<double> errors;  // one per layer
};

/// Median and largest error of every layer.
std::vector<layer_error> summary_of(std::span<const layer_plan> layers,
                                    std::span<const cell_errors> cells);

}  // namespace hopscotch
