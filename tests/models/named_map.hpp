// A return map by the names that users type, with exact derivatives: its periodic points by
// Newton's method, their multipliers, and where along a parameter a multiplier takes a value (1:
// folds, -1: flips). What the tests of published numbers share.
#pragma once

#include "analysis/periodic/map_point.hpp"
#include "analysis/truth/decimal.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hopscotch::testing_models {

enum class digits { sixteen, thirty_two, fifty };

/// P^n at a point: where it leads, and its derivatives by the free columns and by one number more.
struct map_image {
    outcome end = outcome::ok;
    Eigen::VectorXd to;         // free columns
    Eigen::MatrixXd jacobian;   // d to / d free columns
    Eigen::VectorXd by_knob;    // d to / d knob
    std::vector<double> state;  // all columns
    double time = 0.0;
    std::uint64_t events = 0;
};

/// A model with a section, options, parameters and a start, all of them by name.
class named_map {
public:
    using values = std::vector<std::pair<std::string_view, double>>;
    using choices = std::vector<std::pair<std::string_view, std::string_view>>;

    named_map(std::string_view model, std::string_view section, const values& numbers,
              const choices& chosen = {}) {
        at.model = find_model(model);
        if (at.model == nullptr) throw std::invalid_argument("no model " + std::string(model));
        const model_info& info = *at.model->info;
        at.section = index_of(info.sections, section);
        at.options.assign(most_options, 0);
        for (const auto& [option, choice] : chosen) {
            const auto o = static_cast<std::size_t>(index_of(info.options, option));
            const auto& all = info.options[o].choices;
            const auto place = std::find(all.begin(), all.end(), choice);
            if (place == all.end()) throw std::invalid_argument("no choice " + std::string(choice));
            at.options[o] = static_cast<int>(place - all.begin());
        }
        for (const parameter_info& p : info.parameters) at.parameters.push_back(p.standard);
        start.assign(at.columns_of().columns.size(), 0.0);
        for (std::size_t c = 0; c < start.size(); ++c) free.push_back(static_cast<int>(c));
        for (const auto& [name, x] : numbers) value(name) = x;
    }

    map_point at;
    std::vector<double> start;  // one number per column
    std::vector<int> free;      // columns that periodic points are sought in; the others stay fixed

    /// The number of that name, a parameter or a column.
    double& value(std::string_view name) {
        const auto& columns = at.columns_of().columns;
        for (std::size_t c = 0; c < columns.size(); ++c) {
            if (columns[c].name == name) return start[c];
        }
        return at.parameters[static_cast<std::size_t>(index_of(at.model->info->parameters, name))];
    }
    double value(std::string_view name) const { return named_map(*this).value(name); }
    named_map with(std::string_view name, double x) const {
        named_map changed = *this;
        changed.value(name) = x;
        return changed;
    }
    named_map with(const values& numbers) const {
        named_map changed = *this;
        for (const auto& [name, x] : numbers) changed.value(name) = x;
        return changed;
    }
    /// The same map in these columns only; the others are constants of the motion.
    named_map in(const std::vector<std::string_view>& columns) const {
        named_map changed = *this;
        changed.free.clear();
        for (const auto& name : columns) {
            changed.free.push_back(index_of(at.columns_of().columns, name));
        }
        return changed;
    }

    map_image image(std::uint32_t returns = 1, std::string_view knob = {}) const {
        map_point point = at;
        point.variant = variant();
        const auto& columns = at.columns_of().columns;
        int by_column = -1;
        for (std::size_t c = 0; c < columns.size(); ++c) {
            if (columns[c].name == knob) by_column = static_cast<int>(c);
        }
        const int by_parameter =
            knob.empty() || by_column >= 0 ? -1 : index_of(at.model->info->parameters, knob);
        const return_jet jet = point.jet(start.data(), returns, by_parameter);
        const auto n = static_cast<Eigen::Index>(free.size());
        map_image result{jet.end, Eigen::VectorXd(n), Eigen::MatrixXd(n, n), Eigen::VectorXd(n)};
        for (Eigen::Index i = 0; i < n; ++i) {
            const auto row = static_cast<std::size_t>(free[static_cast<std::size_t>(i)]);
            result.to[i] = jet.state[row];
            for (Eigen::Index j = 0; j < n; ++j) {
                result.jacobian(i, j) =
                    jet.derivative[row]
                                  [static_cast<std::size_t>(free[static_cast<std::size_t>(j)])];
            }
            result.by_knob[i] = by_column >= 0
                                    ? jet.derivative[row][static_cast<std::size_t>(by_column)]
                                    : jet.parameter_derivative[row];
        }
        result.state.assign(jet.state, jet.state + start.size());
        result.time = jet.time;
        result.events = jet.events;
        return result;
    }
    Eigen::VectorXd point() const {
        Eigen::VectorXd x(static_cast<Eigen::Index>(free.size()));
        for (std::size_t i = 0; i < free.size(); ++i) {
            x[static_cast<Eigen::Index>(i)] = start[static_cast<std::size_t>(free[i])];
        }
        return x;
    }
    void move(const Eigen::VectorXd& by) {
        for (std::size_t i = 0; i < free.size(); ++i) {
            start[static_cast<std::size_t>(free[i])] += by[static_cast<Eigen::Index>(i)];
        }
    }
    /// Where P^n leads, as a start.
    named_map after(std::uint32_t returns) const {
        named_map changed = *this;
        const map_image there = image(returns);
        EXPECT_EQ(there.end, outcome::ok);
        changed.start = there.state;
        return changed;
    }

    /// The answer of `eval` in the arithmetic asked for.
    orbit_answer answer(std::uint32_t returns = 1, digits kind = digits::sixteen,
                        bool derivative = false) const {
        std::vector<std::string> columns;
        std::vector<std::string> texts;
        for (const double x : start) columns.push_back(print_real(x));
        for (const double x : at.parameters) texts.push_back(print_real(x));
        orbit_row row = row_of(columns, texts, returns);
        row.derivative = derivative;
        const orbit_functions& orbits = at.model->orbits();
        if (kind == digits::sixteen) return orbits.run_double(row);
        return kind == digits::fifty ? orbits.run_mp50(row) : orbits.run_dd(row);
    }
    orbit_answer trace(orbit_observer& observer, std::uint32_t returns = 1) const {
        std::vector<std::string> columns;
        std::vector<std::string> texts;
        for (const double x : start) columns.push_back(print_real(x));
        for (const double x : at.parameters) texts.push_back(print_real(x));
        return at.model->orbits().trace(row_of(columns, texts, returns), observer);
    }

private:
    template <class Table>
    static int index_of(const Table& table, std::string_view name) {
        for (std::size_t i = 0; i < table.size(); ++i) {
            if (table[i].name == name) return static_cast<int>(i);
        }
        throw std::invalid_argument("nothing is called " + std::string(name));
    }
    int variant() const {
        return at.model->variant({at.parameters.data(), at.parameters.data(), at.options.data()});
    }
    orbit_row row_of(const std::vector<std::string>& columns, const std::vector<std::string>& texts,
                     std::uint32_t returns) const {
        return {.section = at.section,
                .options = at.options.data(),
                .variant = variant(),
                .columns = columns,
                .parameters = texts,
                .returns = returns};
    }
};

/// The periodic point next to the map's start, by Newton's method.
inline named_map periodic_point(named_map map, std::uint32_t returns = 1) {
    double residual = 1.0;
    double step = 1.0;
    for (int i = 0; i < 40 && (step > 1e-15 && residual > 0.0); ++i) {
        const map_image f = map.image(returns);
        EXPECT_EQ(f.end, outcome::ok);
        if (f.end != outcome::ok) return map;
        const Eigen::VectorXd excess = f.to - map.point();
        residual = excess.norm();
        const auto n = f.jacobian.rows();
        const Eigen::VectorXd by =
            (f.jacobian - Eigen::MatrixXd::Identity(n, n)).fullPivLu().solve(-excess);
        step = by.norm() / (1.0 + map.point().norm());
        map.move(by);
    }
    // a residual of rounding size: the exact derivative converges quadratically until there
    EXPECT_LT(residual, 1e-9 * (1.0 + map.point().norm())) << "Newton's method found no orbit";
    return map;
}

/// Multipliers of the periodic point that the map stands on, of the largest modulus first.
inline std::vector<std::complex<double>> multipliers(const named_map& map,
                                                     std::uint32_t returns = 1) {
    const Eigen::VectorXcd all =
        Eigen::EigenSolver<Eigen::MatrixXd>(map.image(returns).jacobian, false).eigenvalues();
    std::vector<std::complex<double>> sorted(all.data(), all.data() + all.size());
    std::sort(sorted.begin(), sorted.end(),
              [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
    return sorted;
}
inline double largest_multiplier_modulus(const named_map& map, std::uint32_t returns = 1) {
    return std::abs(multipliers(map, returns).front());
}
inline double largest_multiplier(const named_map& map, std::uint32_t returns = 1) {
    const std::complex<double> first = multipliers(map, returns).front();
    EXPECT_EQ(first.imag(), 0.0) << "a complex pair";
    return first.real();
}

/// The periodic point at which `multiplier` is one of its multipliers, as `knob` (a parameter or a
/// fixed column) varies: 1 gives a fold, -1 a flip. Newton's method on the point, the knob and
/// det(DP^n - multiplier); only the last row's derivatives are differences.
inline named_map point_with_multiplier(named_map map, std::string_view knob, double multiplier,
                                       std::uint32_t returns = 1) {
    const auto n = static_cast<Eigen::Index>(map.free.size());
    const auto test = [&](const named_map& there) {
        return (there.image(returns).jacobian - multiplier * Eigen::MatrixXd::Identity(n, n))
            .determinant();
    };
    double step = 1.0;
    for (int i = 0; i < 40 && step > 1e-13; ++i) {
        const map_image f = map.image(returns, knob);
        if (f.end != outcome::ok) {
            ADD_FAILURE() << "the search left the map's domain";
            return map;
        }
        Eigen::MatrixXd a(n + 1, n + 1);
        Eigen::VectorXd r(n + 1);
        a.topLeftCorner(n, n) = f.jacobian - Eigen::MatrixXd::Identity(n, n);
        a.topRightCorner(n, 1) = f.by_knob;
        r.head(n) = map.point() - f.to;
        r[n] = -test(map);
        for (Eigen::Index j = 0; j <= n; ++j) {
            named_map above = map;
            named_map below = map;
            double& x =
                j < n ? above.start[static_cast<std::size_t>(map.free[static_cast<std::size_t>(j)])]
                      : above.value(knob);
            double& y =
                j < n ? below.start[static_cast<std::size_t>(map.free[static_cast<std::size_t>(j)])]
                      : below.value(knob);
            const double h = 1e-6 * (1e-2 + std::abs(x));
            x += h;
            y -= h;
            a(n, j) = (test(above) - test(below)) / (x - y);
        }
        const Eigen::VectorXd by = a.fullPivLu().solve(r);
        map.move(by.head(n));
        map.value(knob) += by[n];
        step = std::abs(by[n]) / std::abs(map.value(knob)) + by.head(n).norm();
    }
    EXPECT_LT(step, 1e-7) << "Newton's method found no such multiplier";
    return map;
}

}  // namespace hopscotch::testing_models
