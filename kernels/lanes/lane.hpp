// What every scalar type of the kernels ("Real") has in common: its mask type, its width, and the
// names of the operations a model may use. A model never branches on a lane's value; it selects.
//
// Every Real offers  + - * /  unary -  < <= > >= ==  (comparisons give a mask), construction from
// double, and the free functions
//   fma(a, b, c)   a * b + c, rounded once          sqrt abs floor nearest(x) (ties to even)
//   select(mask, a, b)  any(mask)  all(mask)        copysign(magnitude, sign)
//   negate_where(mask, x)   cheaper than select(mask, -x, x)
//   select_form(mask, a, b) select between two forms of one function
//   primal(x)      the value without derivatives (identity for all but dual numbers)
// and the elementary functions of kernels/elementary/. Masks combine with & | and !.
#pragma once

#include "kernels/target.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

template <class Real>
struct lane_traits;  // { using mask; using primal; static constexpr int width; bool is_binary64;
                     //   double rounding (unit roundoff), root_rounding (its square root) }

template <class Real>
using mask_of = typename lane_traits<Real>::mask;

/// The type of `primal(x)`: the same arithmetic without derivatives.
template <class Real>
using primal_of = typename lane_traits<Real>::primal;

/// Trajectories side by side in one Real.
template <class Real>
inline constexpr int width_of = lane_traits<Real>::width;

/// True for double and packs of it: types whose lanes are IEEE binary64 and nothing else.
template <class Real>
concept binary64_lane = lane_traits<Real>::is_binary64;

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
