// One return of any model from many starts: the work that the benchmarks time, its results, and
// what they should be (50 digits). Through the kernels' public entry.
#pragma once

#include "analysis/orbit/orbit_functions.hpp"
#include "kernels/contract/entry.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hopscotch::bench {

using named_numbers = std::vector<std::pair<std::string_view, double>>;
using named_words = std::vector<std::pair<std::string_view, std::string_view>>;

/// A model with its section, parameters and options fixed; starts row by row.
class model_returns {
public:
    model_returns(std::string_view model, std::string_view section, const named_numbers& parameters,
                  const named_words& options = {}, bool wants_time = false);

    int n_columns() const { return n_columns_; }
    const std::vector<double>& parameters() const { return parameters_; }

    /// \param rows  [start][column]
    void set_starts(const std::vector<double>& rows);
    std::size_t size() const { return size_; }
    const double* start(std::size_t i) const { return rows_.data() + i * row_length(); }

    /// A compiled variant other than the one that serves the parameters.
    void use_variant(int compiled) { forced_variant_ = compiled; }

    /// What is computed: states and outcomes after `returns` returns. It points into this.
    ensemble_request request(double tolerance = 0.0, std::uint32_t returns = 1);

    /// What is timed: states and outcomes after `returns` returns.
    /// \param tolerance  of integrated flows; 0: the model's own
    lane_statistics compute(backend which, double tolerance = 0.0, std::uint32_t returns = 1);

    /// Whether the kernels of integrated models listen to a tolerance.
    static bool takes_tolerance();

    bool is_ok(std::size_t i) const;
    double state(std::size_t i, int column) const;

    /// Replaces the starts by the states reached after some returns; orbits that end are left out.
    void settle(std::uint32_t returns);

    /// Leaves the first `n` starts that come back to the section.
    void keep_returning(std::size_t n);

    double time(std::size_t i) const { return times_[i]; }
    /// The model's extra `loss`; 0 where it has none.
    double loss(std::size_t i) const { return losses_[i]; }

    enum class digits { thirty_two, fifty };
    /// The same return as text, in double-double or 50 digits.
    orbit_answer precise(std::size_t i, digits arithmetic) const;

    /// The same return in 50 digits: false where it does not end on the section.
    bool truth(std::size_t i, double* columns, double* time = nullptr) const;

    /// What a column that wraps repeats after; 0 for others.
    double turn(int column) const;

    /// The compiled variant that serves the parameters, or the one chosen instead.
    int variant() const;

    /// Backends built in and able to run here, fastest first.
    std::vector<backend> backends() const;

private:
    std::size_t row_length() const { return static_cast<std::size_t>(n_columns_); }

    const model_entry* model_;
    int section_;
    int n_columns_;
    bool wants_time_;
    int forced_variant_ = -1;
    std::vector<double> parameters_;
    int options_[most_options] = {};
    std::size_t size_ = 0;
    std::vector<double> rows_;                 // [start][column]
    std::vector<std::vector<double>> starts_;  // [column][start]
    std::vector<std::vector<double>> states_;  // [column][start]
    std::vector<double> times_;
    std::vector<double> losses_;
    std::vector<std::uint8_t> ends_;
};

/// `n` rows of numbers, each column uniform within its limits; always the same ones.
std::vector<double> uniform_rows(std::size_t n,
                                 const std::vector<std::pair<double, double>>& limits);

}  // namespace hopscotch::bench
