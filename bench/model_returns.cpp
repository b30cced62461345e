// Returns of any model through the kernels' public entry.
#include "bench/model_returns.hpp"

#include "analysis/orbit/orbit_functions.hpp"
#include "host/run/backends.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include <fmt/format.h>

namespace hopscotch::bench {
namespace {

/// Index of the entry of a table with this name.
template <class Table>
std::size_t index_of(const Table& table, std::string_view name) {
    const auto found =
        std::ranges::find_if(table, [&](const auto& row) { return row.name == name; });
    if (found == table.end()) throw std::runtime_error(fmt::format("no {} in the model", name));
    return static_cast<std::size_t>(found - table.begin());
}

/// Kernels that take a tolerance get it; older ones integrate to their own.
template <class Request>
void set_tolerance(Request& request, double tolerance) {
    if constexpr (requires { request.tolerance; }) request.tolerance = tolerance;
}

}  // namespace

model_returns::model_returns(std::string_view model, std::string_view section,
                             const named_numbers& parameters, const named_words& options,
                             bool wants_time)
    : model_(find_model(model)), wants_time_(wants_time) {
    if (model_ == nullptr) throw std::runtime_error(fmt::format("{} is not built in", model));
    const model_info& info = *model_->info;
    section_ = static_cast<int>(index_of(info.sections, section));
    n_columns_ = static_cast<int>(info.sections[static_cast<std::size_t>(section_)].columns.size());
    for (const parameter_info& parameter : info.parameters)
        parameters_.push_back(parameter.standard);
    for (const auto& [name, value] : parameters)
        parameters_[index_of(info.parameters, name)] = value;
    for (const auto& [name, word] : options) {
        const std::size_t option = index_of(info.options, name);
        const auto& words = info.options[option].choices;
        options_[option] = static_cast<int>(std::ranges::find(words, word) - words.begin());
    }
}

void model_returns::set_starts(const std::vector<double>& rows) {
    rows_ = rows;
    size_ = rows.size() / row_length();
    starts_.assign(row_length(), std::vector<double>(size_));
    states_.assign(row_length(), std::vector<double>(size_));
    times_.assign(size_, 0.0);
    losses_.assign(size_, 0.0);
    ends_.assign(size_, 0);
    for (std::size_t i = 0; i < size_; ++i) {
        for (std::size_t c = 0; c < row_length(); ++c) starts_[c][i] = rows_[i * row_length() + c];
    }
}

int model_returns::variant() const {
    if (forced_variant_ >= 0) return forced_variant_;
    return model_->variant({parameters_.data(), parameters_.data(), options_, wants_time_});
}

ensemble_request model_returns::request(double tolerance, std::uint32_t returns) {
    ensemble_request request;
    set_tolerance(request, tolerance);
    request.n_cells = size_;
    request.section = section_;
    request.max_returns = returns;
    std::copy_n(options_, most_options, request.options);
    for (std::size_t c = 0; c < row_length(); ++c) {
        request.columns[c] = {starts_[c].data(), 1, size_};
        request.state[c] = states_[c].data();
    }
    for (std::size_t p = 0; p < parameters_.size(); ++p)
        request.parameters[p] = {&parameters_[p], 1, 1};
    request.outcome = ends_.data();
    if (wants_time_) request.time = times_.data();
    const auto& extras = model_->info->extras;
    const auto loss = std::ranges::find(extras, "loss", &extra_info::name);
    if (loss != extras.end()) request.extras[loss - extras.begin()] = losses_.data();
    return request;
}

lane_statistics model_returns::compute(backend which, double tolerance, std::uint32_t returns) {
    return model_->kernel(which, variant())(request(tolerance, returns));
}

bool model_returns::is_ok(std::size_t i) const {
    return ends_[i] == static_cast<std::uint8_t>(outcome::ok);
}

double model_returns::state(std::size_t i, int column) const {
    return states_[static_cast<std::size_t>(column)][i];
}

void model_returns::settle(std::uint32_t returns) {
    compute(backends().front(), 0.0, returns);
    std::vector<double> rows;
    for (std::size_t i = 0; i < size_; ++i) {
        if (!is_ok(i)) continue;
        for (int c = 0; c < n_columns_; ++c) rows.push_back(state(i, c));
    }
    set_starts(rows);
}

void model_returns::keep_returning(std::size_t n) {
    compute(backends().front());
    std::vector<double> rows;
    for (std::size_t i = 0; i < size_ && rows.size() < n * row_length(); ++i) {
        if (is_ok(i)) rows.insert(rows.end(), start(i), start(i) + n_columns_);
    }
    set_starts(rows);
}

orbit_answer model_returns::precise(std::size_t i, digits arithmetic) const {
    std::vector<std::string> start;
    std::vector<std::string> numbers;
    for (int c = 0; c < n_columns_; ++c) start.push_back(fmt::format("{:.17g}", this->start(i)[c]));
    for (const double x : parameters_) numbers.push_back(fmt::format("{:.17g}", x));
    orbit_row row;
    row.section = section_;
    row.options = options_;
    row.variant = variant();
    row.columns = start;
    row.parameters = numbers;
    const orbit_functions& orbits = model_->orbits();
    return arithmetic == digits::fifty ? orbits.run_mp50(row) : orbits.run_dd(row);
}

bool model_returns::truth(std::size_t i, double* columns, double* time) const {
    const orbit_answer answer = precise(i, digits::fifty);
    if (time != nullptr) *time = std::strtod(answer.time.c_str(), nullptr);
    if (answer.end != outcome::ok) return false;
    for (std::size_t c = 0; c < answer.columns.size(); ++c)
        columns[c] = std::strtod(answer.columns[c].c_str(), nullptr);
    return true;
}

bool model_returns::takes_tolerance() {
    return [](auto request) {
        return requires { request.tolerance; };
    }(ensemble_request{});
}

double model_returns::turn(int column) const {
    return model_->turn == nullptr ? 0.0 : model_->turn(section_, column, parameters_.data());
}

std::vector<backend> model_returns::backends() const {
    std::vector<backend> usable;
    for (const backend which : {backend::avx512, backend::avx2, backend::scalar}) {
        if (model_->has(which) && reason_against(which).empty()) usable.push_back(which);
    }
    return usable;
}

std::vector<double> uniform_rows(std::size_t n,
                                 const std::vector<std::pair<double, double>>& limits) {
    std::mt19937_64 bits(2002);
    std::vector<double> rows;
    for (std::size_t i = 0; i < n; ++i) {
        for (const auto& [low, high] : limits) {
            const double share = std::ldexp(static_cast<double>(bits() >> 12), -52) + 0x1p-53;
            rows.push_back(low + (high - low) * share);
        }
    }
    return rows;
}

}  // namespace hopscotch::bench
