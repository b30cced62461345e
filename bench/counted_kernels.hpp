// Operations per return of the models: what a GPU's share of its rate and a kernel's floor are
// reckoned from.
#pragma once

#include "kernels/ensemble/request.hpp"

#include <array>
#include <string_view>

namespace hopscotch::bench {

/// Elementary functions that are told apart, in the order of `elementary_names`.
inline constexpr std::size_t n_counted_functions = 5;

/// What one request does with doubles.
struct counted_work {
    double fused = 0.0;
    double plain = 0.0;
    double divisions = 0.0;
    double square_roots = 0.0;
    double roundings = 0.0;

    // elementary functions as calls, and what is done outside of them
    std::array<double, n_counted_functions> functions{};
    double outside_fused = 0.0;
    double outside_sums = 0.0;  // and products
    double outside_comparisons = 0.0;
    double outside_selections = 0.0;
    double outside_divisions = 0.0;
    double outside_square_roots = 0.0;
    double outside_roundings = 0.0;

    /// Instructions of a GPU's double-precision units. A division and a square root, correctly
    /// rounded, are a reciprocal (root) estimate and eight Newton and fix-up steps each.
    double slots() const { return fused + plain + roundings + 8.0 * (divisions + square_roots); }
    double flops() const { return 2.0 * fused + plain + divisions + square_roots; }

    /// The share of one of `units`, returns for example.
    counted_work per(double units) const;
};

/// Computes the request, one trajectory after the other, and counts.
/// \error std::runtime_error for a model that is not counted
counted_work count_work(std::string_view model, int variant, const ensemble_request& request);

}  // namespace hopscotch::bench
