// Lyapunov exponents of one orbit in double-double: the audit's second opinion on the motion of a
// chaos map's cells. The same estimate as the kernels', on an orbit with twice the digits.
#pragma once

#include "analysis/orbit/orbit_functions.hpp"
#include "analysis/truth/decimal.hpp"
#include "kernels/contract/model.hpp"
#include "kernels/ensemble/exponent_estimate.hpp"
#include "kernels/lanes/double_double.hpp"
#include "kernels/lanes/dual.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// \tparam N  directions carried; those beyond the section's columns vanish
template <class Model, int Variant, int N>
class exponent_orbit {
    using space = tangent_space<Model, Variant, double_double<double>, N>;
    using number = typename space::number;

public:
    exponent_orbit(const orbit_row& row, const exponent_request& wanted)
        : row_(row),
          wanted_(wanted),
          end_section_(Model::info.sections[static_cast<std::size_t>(row.section)].returns_to) {}

    exponent_answer run() {
        number columns[most_columns];
        for (number& column : columns) column = number(0.0);
        for (std::size_t c = 0; c < row_.columns.size(); ++c) {
            columns[c] = number(parse_real<double_double<double>>(row_.columns[c]));
        }
        space::seed(columns, wanted_, true);
        for (std::size_t p = 0; p < row_.parameters.size(); ++p) {
            parameters_[p] = number(parse_real<double_double<double>>(row_.parameters[p]));
        }
        unwatched watch;
        estimate_.begin(wanted_);
        book(place(lane_, row_.section, columns));
        while (!is_over_) book(Model::template step<Variant>(lane_, true, watch));

        exponent_answer answer{.end = end_, .returns = returns_};
        if (end_ != outcome::ok) return answer;
        const auto result = estimate_.conclude(wanted_);
        answer.motion = static_cast<enum motion>(static_cast<int>(result.motion));
        answer.standard_error = result.standard_error;
        for (int k = 0; k < N && k < most_columns; ++k) answer.exponents[k] = result.exponents[k];
        return answer;
    }

private:
    void book(const progress<number>& done) {
        end_ = static_cast<outcome>(static_cast<int>(to_double(primal(done.ended))));
        steps_ = done.returned ? 0.0 : steps_ + 1.0;
        if (end_ == outcome::ok && steps_ >= row_.max_steps) end_ = outcome::budget;
        if (done.returned) {
            ++returns_;
            is_over_ = book_return();
        }
        is_over_ = is_over_ || end_ != outcome::ok || returns_ >= row_.returns;
    }

    progress<number> place(typename space::lane& at, int section,
                           const number (&columns)[most_columns]) const {
        take_tolerance<Model, Variant, number>(at, row_.tolerance);
        unwatched watch;
        return Model::template begin<Variant>(at, section, columns, parameters_, row_.options,
                                              watch);
    }

    /// As the tangent ensemble does it, with all directions renewed at every return.
    ///
    /// \return  the estimate is precise enough
    bool book_return() {
        double squares[N];
        number columns[most_columns];
        space::read(lane_, end_section_, columns);
        space::keep_free(columns, wanted_);
        space::orthogonalise(columns, true, estimate_.doublings, squares);
        estimate_.until_boundary -= 1.0;
        const bool is_boundary = estimate_.until_boundary == 0.0;
        if (is_boundary && estimate_.has_begun == 0.0 && has_vanished(squares)) {
            space::seed(columns, wanted_, true);
            for (int k = 0; k < N; ++k) squares[k] = 1.0, estimate_.doublings[k] = 0.0;
        }
        typename space::lane begun;
        const progress<number> done = place(begun, end_section_, columns);
        space::take_slopes(lane_, begun, true, !(to_double(primal(done.ended)) == 0.0));
        if (!is_boundary) return false;
        estimate_.book(wanted_, true, squares, to_double(primal(lane_.time)));
        return estimate_.is_precise(wanted_);
    }

    bool has_vanished(const double (&squares)[N]) const {
        const auto& section = Model::info.sections[static_cast<std::size_t>(end_section_)];
        for (int k = 0; k < N && k < static_cast<int>(section.columns.size()); ++k) {
            if (squares[k] == 0.0) return true;
        }
        return false;
    }

    const orbit_row& row_;
    const exponent_request& wanted_;
    int end_section_;
    typename space::lane lane_;
    number parameters_[most_parameters];
    exponent_estimate<double, N, true> estimate_;
    outcome end_ = outcome::ok;
    std::uint32_t returns_ = 0;
    double steps_ = 0.0;
    bool is_over_ = false;
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
