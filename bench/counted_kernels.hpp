// Operations per return of the models that the device benchmark times.
#pragma once

#include "kernels/ensemble/request.hpp"

#include <string_view>

namespace hopscotch::bench {

/// What one request does with doubles.
struct counted_work {
    double fused = 0.0;
    double plain = 0.0;
    double divisions = 0.0;
    double square_roots = 0.0;
    double roundings = 0.0;

    /// Instructions of a GPU's double-precision units. A division and a square root, correctly
    /// rounded, are a reciprocal (root) estimate and eight Newton and fix-up steps each.
    double slots() const { return fused + plain + roundings + 8.0 * (divisions + square_roots); }
    double flops() const { return 2.0 * fused + plain + divisions + square_roots; }
};

/// Computes the request, one trajectory after the other, and counts.
/// \error std::runtime_error for a model that is not counted
counted_work count_work(std::string_view model, int variant, const ensemble_request& request);

}  // namespace hopscotch::bench
