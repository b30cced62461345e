// Multiplies derivatives, with the product's size kept apart.
#include "analysis/orbit/finite_time_exponent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hopscotch {
namespace {

/// A matrix of at most most_columns x most_columns, brought to size 1 again and again.
class scaled_product {
public:
    scaled_product(int rows, int columns) : rows_(rows), columns_(columns) {}

    /// From the left, by a jet's derivative. \param inner  columns of the factor
    void multiply(const return_jet& factor, int inner) {
        double next[most_columns][most_columns] = {};
        double square = 0.0;
        for (int i = 0; i < rows_; ++i) {
            for (int j = 0; j < columns_; ++j) {
                double sum = 0.0;
                for (int k = 0; k < inner; ++k) sum += factor.derivative[i][k] * entries_[k][j];
                next[i][j] = is_empty_ ? factor.derivative[i][j] : sum;
                square += next[i][j] * next[i][j];
            }
        }
        is_empty_ = false;
        const double size = std::sqrt(square);
        log_size_ += std::log(size);
        for (int i = 0; i < rows_; ++i) {
            for (int j = 0; j < columns_; ++j) {
                entries_[i][j] = size > 0.0 ? next[i][j] / size : 0.0;
            }
        }
    }

    double log_size() const { return log_size_; }

private:
    int rows_;
    int columns_;
    bool is_empty_ = true;
    double log_size_ = 0.0;
    double entries_[most_columns][most_columns] = {};
};

}  // namespace

double finite_time_exponent(const orbit_functions& model, const jet_query& start, int ends_on,
                            int n_start_columns, int n_end_columns) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (start.returns == 0) return nan;
    scaled_product product(n_end_columns, n_start_columns);
    jet_query next = start;
    next.returns = 1;
    double state[most_columns];
    for (std::uint32_t n = 0; n < start.returns; ++n) {
        const return_jet jet = model.jet(next);
        if (jet.end != outcome::ok) return nan;
        product.multiply(jet, n_end_columns);
        std::copy(std::begin(jet.state), std::end(jet.state), state);
        next.columns = state;
        next.section = ends_on;
    }
    return product.log_size() / start.returns;
}

}  // namespace hopscotch
