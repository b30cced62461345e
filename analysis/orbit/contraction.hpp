// Whether a return map contracts an ellipsoid into itself, proved from enclosures of its derivative
// over the whole ellipsoid. The mean-value theorem on a convex set turns a bound of the derivative
// into a contraction.
#pragma once

#include "analysis/orbit/orbit_functions.hpp"
#include "kernels/ensemble/request.hpp"

namespace hopscotch {

/// The question: does P^returns contract { |A (x - c)| <= 1 }, A and c those of `trap`? Columns j
/// with no entry in A are held at c_j, and have to come back to it exactly.
struct contraction_query {
    int section = 0;  // returns to itself
    const int* options = nullptr;
    int variant = 0;
    std::span<const double> parameters;
    int returns = 1;
    double max_steps = 1e4;  // per return
    trap_ellipsoid trap{};
    int most_pieces = 256;  // parts the ellipsoid may be cut into
};

enum class contraction_verdict : std::uint8_t {
    proved,
    undecided_comparison,  // starts in it take different ways: another order of events
    not_contracting,
    event_not_unique,  // an event's time could not be bounded over the set
    not_supported,     // integrated flows: the remainder of a step is not enclosed
};
std::string_view name_of(contraction_verdict verdict);

struct contraction_bound {
    contraction_verdict verdict = contraction_verdict::not_supported;
    double contraction = 0.0;  // >= |A DP(x) A^-1| for every x of the ellipsoid
    double defect = 0.0;       // >= |A (P(c) - c)|
    int pieces = 0;            // looked at
};

/// The proof. `proved` means contraction < 1 and contraction + defect <= 1, with room left for the
/// kernels' rounding (2^-40 of the columns' sizes): every orbit of the ellipsoid stays and tends to
/// the only fixed point in it.
///
/// \error  none; everything that is not proved is a verdict
/// What is enclosed are the model's formulas in exact arithmetic; quadratures count as formulas.
contraction_bound prove_contraction(const orbit_functions& model, const contraction_query& query);

}  // namespace hopscotch
