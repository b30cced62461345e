// The tangent space of an orbit whose lane is made of dual numbers: N directions, kept apart by
// Gram-Schmidt on the section's columns and kept in range by powers of two. Used by the tangent
// ensemble and by single orbits in double-double.
#pragma once

#include "kernels/contract/info.hpp"
#include "kernels/ensemble/request.hpp"
#include "kernels/lanes/dual.hpp"

#include <type_traits>

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// |v| of one direction as 2^doublings m. Of N > 1 directions it is the square that is kept.
template <class Real>
struct split_size {
    Real log_mantissa;  // -infinity where the direction has vanished, NaN where it is lost
    Real doublings;
};

template <class Real>
HOPSCOTCH_DEVICE inline mask_of<Real> is_regular(const Real& size) {
    return (size >= Real(0x1p-1022)) & (size < infinity<Real>());
}

template <class Real>
HOPSCOTCH_DEVICE inline split_size<Real> split(const Real& size) {
    const mask_of<Real> regular = is_regular(size);
    const Real within = select(regular, size, Real(1.0));
    return {log(select(regular, mantissa(within), size)), exponent(within)};
}

/// The tangent space of a model's orbit.
///
/// \tparam T  arithmetic of values and slopes; sizes and angles are kept in double (or packs of it)
template <class Model, int Variant, class T, int N>
class tangent_space {
public:
    using number = dual<T, N>;
    using lane = lane_of<Model, Variant, number>;
    using Real = std::conditional_t<binary64_lane<T>, T, double>;

    /// Where directions are no longer resolved against those before them: cancellation to 2^-40.
    static constexpr double resolution = 0x1p-80;  // of squares

    /// The section's columns with their slopes; columns that the section has not are zero.
    HOPSCOTCH_DEVICE static void read(const lane& at, int section,
                                      number (&columns)[most_columns]) {
        for (number& column : columns) column = number(0.0);
        Model::read_state(at, section, columns);
    }

    /// Every column's direction along it, at the values that the columns have.
    HOPSCOTCH_DEVICE static void seed(number (&columns)[most_columns],
                                      const exponent_request& wanted, const mask_of<Real>& where) {
        for (int c = 0; c < most_columns; ++c) {
            const number along = number::variable(columns[c].value, wanted.direction[c] % N);
            columns[c] = select(where, along, columns[c]);
        }
    }

    /// Takes out of the directions of free columns what they have along conserved ones. It is none
    /// but for rounding (a conserved column does not change with any other); left in, it would not
    /// shrink with a direction that contracts, and soon be all that is left of it.
    HOPSCOTCH_DEVICE static void keep_free(number (&columns)[most_columns],
                                           const exponent_request& wanted) {
        for (int c = 0; c < N; ++c) {
            if (wanted.direction[c] < wanted.n_free) continue;
            for (int k = 0; k < N; ++k) {
                if (k < wanted.n_free) columns[c].slope[k] = T(0.0);
            }
        }
    }

    /// Of one direction: the length of the column's slope.
    HOPSCOTCH_DEVICE static Real size_of(const lane& at, int section) requires(N == 1) {
        number columns[most_columns];
        Model::read_state(at, section, columns);
        return abs(leading(columns[0].slope[0]));
    }

    /// One direction: brings the slopes of all fields, which transform linearly, back from far
    /// outside a wide range. Exact, so that it does not matter when it is done.
    ///
    /// \param doublings  is raised by what the slopes were divided by
    HOPSCOTCH_DEVICE static void keep_in_range(lane& at, int section,
                                               Real& doublings) requires(N == 1) {
        const Real size = size_of(at, section);
        const mask_of<Real> leaves =
            is_regular(size) & ((size < Real(0x1p-64)) | (size > Real(0x1p64)));
        if (!any(leaves)) return;
        const Real taken = select(leaves, exponent(select(leaves, size, Real(1.0))), Real(0.0));
        const Real half = floor(taken * Real(0.5));  // 2^-1023 is no normal number
        const Real first = power_of_two(-half);
        const Real second = power_of_two(half - taken);
        for (int f = 0; f < n_fields; ++f) {
            T& slope = field(at, f).slope[0];
            slope = slope * T(first) * T(second);
        }
        doublings = doublings + taken;
    }

    /// Makes the directions orthogonal on the columns, in the lanes wanted, and brings their
    /// lengths near 1. Directions that are not resolved vanish.
    ///
    /// \param doublings  of the squares; raised by what they were divided by
    /// \param squares    of the lengths afterwards
    HOPSCOTCH_DEVICE static void orthogonalise(number (&columns)[most_columns],
                                               const mask_of<Real>& wanted, Real (&doublings)[N],
                                               Real (&squares)[N]) {
        const Real zero(0.0);
        const Real one(1.0);
        for (int k = 0; k < N; ++k) {
            const Real before = product(columns, k, k);
            for (int j = 0; j < k; ++j) {
                const Real parallel =
                    select(wanted & (squares[j] > zero), product(columns, j, k) / squares[j], zero);
                for (int c = 0; c < N; ++c) {
                    T& slope = columns[c].slope[k];
                    slope = fma(T(-parallel), columns[c].slope[j], slope);
                }
            }
            const Real after = product(columns, k, k);
            const mask_of<Real> lost = wanted & (after < Real(resolution) * before);
            const mask_of<Real> regular =
                wanted & !lost & (after > Real(0x1p-1000)) & (after < Real(0x1p1000));
            const Real half =
                select(regular, floor(exponent(select(regular, after, one)) * Real(0.5)), zero);
            const Real scale = select(lost, zero, power_of_two(-half));
            for (int c = 0; c < N; ++c) columns[c].slope[k] = columns[c].slope[k] * T(scale);
            squares[k] = after * scale * scale;
            doublings[k] = doublings[k] + Real(2.0) * half;
        }
    }

    /// One step with one direction after the other: the bits of a step with all of them together,
    /// in the memory of one, for the work of N steps' values.
    HOPSCOTCH_DEVICE static progress<number> step_one_by_one(lane& at,
                                                             const mask_of<Real>& active) {
        using narrow = dual<T, 1>;
        lane_of<Model, Variant, narrow> one;
        static_assert(sizeof one / sizeof(narrow) == n_fields);
        narrow* const its = reinterpret_cast<narrow*>(&one);
        progress<narrow> done{};
#pragma GCC unroll 1
        for (int k = 0; k < N; ++k) {
            for (int f = 0; f < n_fields; ++f) {
                its[f].value = field(at, f).value;
                its[f].slope[0] = field(at, f).slope[k];
            }
            unwatched watch;
            done = Model::template step<Variant>(one, active, watch);
            for (int f = 0; f < n_fields; ++f) field(at, f).slope[k] = its[f].slope[0];
        }
        for (int f = 0; f < n_fields; ++f) field(at, f).value = its[f].value;
        return {done.returned, number(primal(done.ended))};
    }

    /// The slopes of all fields from a lane that was begun at the same state; values stay. They
    /// must not be carried on forever instead: rounding leaves the tangent space of the section by
    /// way of what an orbit conserves (a runner's speed is stored in several fields), and does not
    /// contract.
    ///
    /// \param lost  lanes without such a start: their slopes are none from now on
    HOPSCOTCH_DEVICE static void take_slopes(lane& at, const lane& begun,
                                             const mask_of<Real>& where,
                                             const mask_of<Real>& lost) {
        for (int f = 0; f < n_fields; ++f) {
            number& mine = field(at, f);
            const number& its = reinterpret_cast<const number*>(&begun)[f];
            for (int k = 0; k < N; ++k) {
                const T slope = select(lost, T(not_a_number<Real>()), its.slope[k]);
                mine.slope[k] = select(where, slope, mine.slope[k]);
            }
        }
    }

private:
    static constexpr int n_fields = static_cast<int>(sizeof(lane) / sizeof(number));

    HOPSCOTCH_DEVICE static number& field(lane& at, int f) {
        return reinterpret_cast<number*>(&at)[f];
    }
    HOPSCOTCH_DEVICE static Real leading(const T& x) {
        if constexpr (binary64_lane<T>) {
            return x;
        } else {
            return to_double(x);
        }
    }
    HOPSCOTCH_DEVICE static Real product(const number (&columns)[most_columns], int j, int k) {
        Real sum = leading(columns[0].slope[j]) * leading(columns[0].slope[k]);
        for (int c = 1; c < N; ++c) {
            sum = fma(leading(columns[c].slope[j]), leading(columns[c].slope[k]), sum);
        }
        return sum;
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
