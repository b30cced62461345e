// Labels of one-dimensional maps with negative Schwarzian derivative and one critical orbit that
// can be attracted: the gain alone decides the attractor (Singer 1978), so its label needs no
// iteration.
#pragma once

#include "kernels/contract/info.hpp"
#include "kernels/lanes/lane.hpp"
#include "kernels/lanes/scalar.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// Gains at which the cycles of period 1, 2, 4 ... 128 of a cascade lose their stability.
inline constexpr int n_doublings = 8;
struct doubling_cascade {
    double lost_at[n_doublings];
};

/// Labels: 1 the resting state, 2 the fixed point, 3 period 2, 4 period 4, ..., and the last one
/// for what lies beyond the doublings listed (long cycles, chaos, windows).
inline constexpr int resting_label = 1;
inline constexpr int last_cascade_label = 2 + n_doublings;

/// Label of the cycle that attracts at this gain; the fixed point exists there.
template <class Real>
HOPSCOTCH_DEVICE inline Real cascade_label(const doubling_cascade& cascade, const Real& gain) {
    Real label(2.0);
    for (int k = 0; k < n_doublings; ++k) {
        label = select(gain > Real(cascade.lost_at[k]), Real(3.0 + k), label);
    }
    return label;
}

/// \param dies  what the resting state means in this model
inline bool describe_cascade_label(int label, std::string_view dies, std::string_view trap,
                                   label_description& text) {
    if (label < resting_label || label > last_cascade_label) return false;
    text = {.kind = dies, .trap = trap};
    if (label == 2) text.kind = "fixed point";
    if (label > 2) {
        text.kind = "period";
        text.index = text.period = 1 << (label - 2);
    }
    if (label == last_cascade_label) {
        text.kind = "beyond the cascade";
        text.index = -1;
        text.period = 0;
    }
    return true;
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
