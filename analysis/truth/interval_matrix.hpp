// Small square matrices of intervals and certain bounds of their 2-norm, for proofs that a return
// map contracts.
#pragma once

#include "analysis/truth/interval.hpp"
#include "kernels/contract/info.hpp"

#include <array>

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// n x n doubles, n <= most_columns.
struct small_matrix {
    int n = 0;
    std::array<double, most_columns * most_columns> entry{};

    double& operator()(int i, int j) { return entry[static_cast<std::size_t>(i * n + j)]; }
    double operator()(int i, int j) const { return entry[static_cast<std::size_t>(i * n + j)]; }
};

/// Every matrix whose entries lie in the intervals.
struct interval_matrix {
    int n = 0;
    std::array<interval, most_columns * most_columns> entry{};

    explicit interval_matrix(int size) : n(size) {}
    static interval_matrix of(const small_matrix& points);
    static interval_matrix identity(int n);
    interval& operator()(int i, int j) { return entry[static_cast<std::size_t>(i * n + j)]; }
    const interval& operator()(int i, int j) const {
        return entry[static_cast<std::size_t>(i * n + j)];
    }
};

interval_matrix product(const interval_matrix& a, const interval_matrix& b);
interval_matrix operator-(const interval_matrix& a, const interval_matrix& b);

/// Inverse by elimination in doubles; NaN entries where there is none.
small_matrix approximate_inverse(small_matrix a);

/// Upper bound of the Frobenius norm of every matrix in a.
double frobenius_bound(const interval_matrix& a);

/// Upper bound of the 2-norm of every matrix in a: that of the middle, verified by a Cholesky
/// factorisation in intervals, and the Frobenius norm of the rest.
double norm_bound(const interval_matrix& a);

/// About the least 2-norm of the matrices in a: not a certain bound, for giving up early.
double least_norm(const interval_matrix& a);

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
