// Norms of small interval matrices.
#include "analysis/truth/interval_matrix.hpp"

#include <cmath>
#include <utility>

namespace hopscotch::inline HOPSCOTCH_TARGET {
namespace {

small_matrix middle_of(const interval_matrix& a) {
    small_matrix m{.n = a.n};
    for (int i = 0; i < a.n; ++i) {
        for (int j = 0; j < a.n; ++j) m(i, j) = a(i, j).middle();
    }
    return m;
}

/// About the largest singular value, by power iteration on M^T M.
double singular_value(const small_matrix& m) {
    std::array<double, most_columns> x;
    for (int i = 0; i < m.n; ++i) x[static_cast<std::size_t>(i)] = 1.0 + 0.1 * i;
    double size = 0.0;
    for (int step = 0; step < 200; ++step) {
        std::array<double, most_columns> y{};
        std::array<double, most_columns> z{};
        for (int i = 0; i < m.n; ++i) {
            for (int j = 0; j < m.n; ++j)
                y[static_cast<std::size_t>(i)] += m(i, j) * x[static_cast<std::size_t>(j)];
        }
        double norm = 0.0;
        for (int j = 0; j < m.n; ++j) {
            for (int i = 0; i < m.n; ++i)
                z[static_cast<std::size_t>(j)] += m(i, j) * y[static_cast<std::size_t>(i)];
            norm += z[static_cast<std::size_t>(j)] * z[static_cast<std::size_t>(j)];
        }
        norm = std::sqrt(norm);
        if (!(norm > 0.0) || !std::isfinite(norm)) return std::sqrt(norm);
        const double before = size;
        size = std::sqrt(norm);
        for (int j = 0; j < m.n; ++j)
            x[static_cast<std::size_t>(j)] = z[static_cast<std::size_t>(j)] / norm;
        if (step > 0 && std::abs(size - before) <= 1e-13 * size) break;
        // x has length 1 from the first step on, so that |M^T M x| tends to the square
    }
    return size;
}

/// Is q^2 I - M^T M certainly positive definite?
bool exceeds_norm(double q, const small_matrix& m) {
    const int n = m.n;
    interval_matrix s(n);
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j <= i; ++j) {
            interval sum = i == j ? square(interval::point(q)) : interval{};
            for (int k = 0; k < n; ++k)
                sum = sum - interval::point(m(k, i)) * interval::point(m(k, j));
            s(i, j) = sum;
        }
    }
    for (int j = 0; j < n; ++j) {  // Cholesky, column by column, in place
        interval pivot = s(j, j);
        for (int k = 0; k < j; ++k) pivot = pivot - square(s(j, k));
        if (!(pivot.low > 0.0)) return false;
        s(j, j) = sqrt(pivot);
        for (int i = j + 1; i < n; ++i) {
            interval sum = s(i, j);
            for (int k = 0; k < j; ++k) sum = sum - s(i, k) * s(j, k);
            s(i, j) = sum / s(j, j);
        }
    }
    return true;
}

double frobenius_of(const small_matrix& m) { return frobenius_bound(interval_matrix::of(m)); }

/// Distance of the intervals' ends from their middles, by the Frobenius norm.
double spread_bound(const interval_matrix& a, const small_matrix& middle) {
    interval_matrix rest(a.n);
    for (int i = 0; i < a.n; ++i) {
        for (int j = 0; j < a.n; ++j) rest(i, j) = a(i, j) - interval::point(middle(i, j));
    }
    return frobenius_bound(rest);
}

}  // namespace

interval_matrix interval_matrix::of(const small_matrix& points) {
    interval_matrix a(points.n);
    for (int i = 0; i < a.n; ++i) {
        for (int j = 0; j < a.n; ++j) a(i, j) = interval::point(points(i, j));
    }
    return a;
}
interval_matrix interval_matrix::identity(int n) {
    interval_matrix a(n);
    for (int i = 0; i < n; ++i) a(i, i) = interval::point(1.0);
    return a;
}

interval_matrix product(const interval_matrix& a, const interval_matrix& b) {
    interval_matrix c(a.n);
    for (int i = 0; i < a.n; ++i) {
        for (int j = 0; j < a.n; ++j) {
            for (int k = 0; k < a.n; ++k) c(i, j) = c(i, j) + product_of_slopes(a(i, k), b(k, j));
        }
    }
    return c;
}
interval_matrix operator-(const interval_matrix& a, const interval_matrix& b) {
    interval_matrix c(a.n);
    for (int i = 0; i < a.n; ++i) {
        for (int j = 0; j < a.n; ++j) c(i, j) = a(i, j) - b(i, j);
    }
    return c;
}

small_matrix approximate_inverse(small_matrix a) {
    const int n = a.n;
    small_matrix inverse{.n = n};
    for (int i = 0; i < n; ++i) inverse(i, i) = 1.0;
    for (int column = 0; column < n; ++column) {
        int pivot = column;
        for (int i = column; i < n; ++i) {
            if (std::abs(a(i, column)) > std::abs(a(pivot, column))) pivot = i;
        }
        for (int j = 0; j < n; ++j) {
            std::swap(a(pivot, j), a(column, j));
            std::swap(inverse(pivot, j), inverse(column, j));
        }
        const double scale = 1.0 / a(column, column);
        for (int j = 0; j < n; ++j) {
            a(column, j) *= scale;
            inverse(column, j) *= scale;
        }
        for (int i = 0; i < n; ++i) {
            const double factor = a(i, column);
            if (i == column) continue;
            for (int j = 0; j < n; ++j) {
                a(i, j) -= factor * a(column, j);
                inverse(i, j) -= factor * inverse(column, j);
            }
        }
    }
    return inverse;
}

double frobenius_bound(const interval_matrix& a) {
    double square = 0.0;
    for (int i = 0; i < a.n; ++i) {
        for (int j = 0; j < a.n; ++j) {
            const double size = a(i, j).size();
            if (!(size < interval::huge)) return interval::huge;
            square = just_above(square + just_above(size * size));
        }
    }
    return just_above(std::sqrt(square));
}

double norm_bound(const interval_matrix& a) {
    const small_matrix middle = middle_of(a);
    const double spread = spread_bound(a, middle);
    if (!(spread < interval::huge)) return interval::huge;
    const double about = singular_value(middle);
    for (double margin = 1e-12; margin < 1e-2; margin *= 10.0) {
        const double q = about * (1.0 + margin);
        if (exceeds_norm(q, middle)) return just_above(q + spread);
    }
    return just_above(frobenius_of(middle) + spread);
}

double least_norm(const interval_matrix& a) {
    const small_matrix middle = middle_of(a);
    return singular_value(middle) - spread_bound(a, middle);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
