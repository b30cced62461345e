// Random legal rows of any model, run through its ensemble kernels with every output kept as bits:
// what the tests share that hold for all models. They read only the models' descriptions, so a new
// model is tested without editing them.
#pragma once

#include "host/run/backends.hpp"
#include "kernels/contract/entry.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace hopscotch::every_model {

inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

/// Rows of one section of a model under one choice of its options, one number per row everywhere.
struct rows {
    const model_entry* model = nullptr;
    int section = 0;
    std::vector<int> options;
    std::vector<std::vector<double>> columns;     // [column][row]
    std::vector<std::vector<double>> parameters;  // [parameter][row]
    std::uint32_t returns = 3;
    double max_steps = 400.0;
    decision decided_by = decision::returns;

    std::size_t size() const { return columns[0].size(); }
    const section_info& starts_on() const {
        return model->info->sections[static_cast<std::size_t>(section)];
    }
    const section_info& ends_on() const {
        return model->info->sections[static_cast<std::size_t>(starts_on().returns_to)];
    }
    /// "model section option option", for messages.
    std::string name() const {
        std::string text = std::string(model->info->name) + " " + std::string(starts_on().name);
        for (std::size_t o = 0; o < model->info->options.size(); ++o) {
            text +=
                " " +
                std::string(model->info->options[o].choices[static_cast<std::size_t>(options[o])]);
        }
        return text;
    }
};

/// Uniform in [0, 1), the same with every standard library.
struct dice {
    std::mt19937_64 bits;
    double operator()() { return std::ldexp(static_cast<double>(bits() >> 11), -53); }
    double between(double low, double high) { return low + (high - low) * (*this)(); }
    /// Some number of the range, of a size between 1e-4 and 20 where the range allows it; half of
    /// them uniform below 8.
    double inside(const range& valid) {
        for (int attempt = 0; attempt < 100; ++attempt) {
            double x = 0.0;
            if (std::isfinite(valid.lowest) && std::isfinite(valid.highest)) {
                x = between(valid.lowest, valid.highest);
            } else {
                x = (*this)() < 0.5 ? between(0.0, 8.0) : std::pow(10.0, between(-4.0, 1.3));
                x = (*this)() < 0.5 ? -x : x;
            }
            if (valid.holds(x)) return x;
        }
        return valid.lowest;
    }
    /// A value of the parameter: often its default, else one of the same size, seldom an end of
    /// its range.
    double value_of(const parameter_info& parameter) {
        for (int attempt = 0; attempt < 100; ++attempt) {
            const double standard = parameter.standard;
            const bool is_given = standard == standard;
            double x = standard;
            const double kind = (*this)();
            if (kind < 0.03) {
                x = kind < 0.015 ? parameter.valid.lowest : parameter.valid.highest;
            } else if (kind < 0.5) {
                const double size = is_given && standard != 0.0 ? standard : 0.3;
                x = size * std::pow(10.0, between(-0.4, 0.4));
            }
            if (!is_given && x != x) return x;
            if (parameter.valid.holds(x)) return x;
        }
        return parameter.standard;
    }
};

inline bool is_refused(const rows& of, std::size_t row) {
    std::vector<double> parameters;
    for (const auto& values : of.parameters) parameters.push_back(values[row]);
    return !of.model->refusal(parameters.data(), of.options.data()).empty();
}

/// Random rows, parameters included, that the program would accept.
inline rows random_rows(const model_entry& model, int section, std::vector<int> options,
                        std::size_t n, std::uint64_t seed) {
    rows of{.model = &model, .section = section, .options = std::move(options)};
    of.options.resize(most_options, 0);
    of.columns.assign(of.starts_on().columns.size(), {});
    of.parameters.assign(model.info->parameters.size(), {});
    dice roll{std::mt19937_64(seed)};
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t c = 0; c < of.columns.size(); ++c) {
            of.columns[c].push_back(roll.inside(of.starts_on().columns[c].valid));
        }
        for (std::size_t p = 0; p < of.parameters.size(); ++p) of.parameters[p].push_back(0.0);
        for (int attempt = 0; attempt < 50; ++attempt) {
            for (std::size_t p = 0; p < of.parameters.size(); ++p) {
                of.parameters[p][i] = attempt < 49 ? roll.value_of(model.info->parameters[p])
                                                   : model.info->parameters[p].standard;
            }
            if (!is_refused(of, i)) break;
        }
    }
    return of;
}

/// All combinations of a model's options.
inline std::vector<std::vector<int>> all_options(const model_info& info) {
    std::vector<std::vector<int>> all{std::vector<int>(most_options, 0)};
    for (std::size_t o = 0; o < info.options.size(); ++o) {
        std::vector<std::vector<int>> longer;
        for (const auto& chosen : all) {
            for (std::size_t c = 0; c < info.options[o].choices.size(); ++c) {
                longer.push_back(chosen);
                longer.back()[o] = static_cast<int>(c);
            }
        }
        all = longer;
    }
    return all;
}

/// The variant that the model chooses for these rows together.
inline int variant_of(const rows& of, bool wants_time = true) {
    std::vector<double> lowest;
    std::vector<double> highest;
    for (const auto& values : of.parameters) {
        double low = values[0];
        double high = values[0];
        for (const double x : values) {
            if (x < low) low = x;
            if (x > high) high = x;
        }
        lowest.push_back(low);
        highest.push_back(high);
    }
    return of.model->variant({lowest.data(), highest.data(), of.options.data(), wants_time});
}

inline rows picked(const rows& of, const std::vector<std::size_t>& which) {
    rows some = of;
    const auto pick = [&](const std::vector<double>& from, std::vector<double>& to) {
        to.clear();
        for (const std::size_t i : which) to.push_back(from[i]);
    };
    for (std::size_t c = 0; c < of.columns.size(); ++c) pick(of.columns[c], some.columns[c]);
    for (std::size_t p = 0; p < of.parameters.size(); ++p) {
        pick(of.parameters[p], some.parameters[p]);
    }
    return some;
}

/// What the kernel says of every row.
struct answers {
    std::vector<std::int16_t> label;
    std::vector<std::uint8_t> end;
    std::vector<std::uint32_t> returns;
    std::vector<std::uint32_t> events;
    std::vector<double> time;
    std::vector<std::vector<double>> state;
    std::vector<std::vector<double>> extras;

    outcome ended(std::size_t i) const { return static_cast<outcome>(end[i]); }

    /// Every field of one row; all numbers that are none count as the same.
    std::vector<std::uint64_t> bits(std::size_t i) const {
        std::vector<std::uint64_t> all{static_cast<std::uint64_t>(label[i]), end[i], returns[i],
                                       events[i]};
        const auto add = [&](double x) {
            all.push_back(std::bit_cast<std::uint64_t>(x == x ? x : not_given));
        };
        add(time[i]);
        for (const auto& values : state) add(values[i]);
        for (const auto& values : extras) add(values[i]);
        return all;
    }
    /// The state is finite; a time (a flight without gravity) or an extra (the work of a huge
    /// thrust) may overflow, no more.
    bool is_sound(std::size_t i) const {
        bool finite = !std::isnan(time[i]);
        for (const auto& values : state) finite = finite && std::isfinite(values[i]);
        for (const auto& values : extras) finite = finite && !std::isnan(values[i]);
        return finite;
    }
};

inline answers run(const rows& of, backend which, int variant) {
    const std::size_t n = of.size();
    answers result;
    result.label.assign(n, -1);
    result.end.assign(n, 255);
    result.returns.assign(n, 0);
    result.events.assign(n, 0);
    result.time.assign(n, 0.0);
    result.state.assign(of.ends_on().columns.size(), std::vector<double>(n));
    result.extras.assign(of.model->info->extras.size(), std::vector<double>(n));

    ensemble_request request;
    request.n_cells = n;
    request.section = of.section;
    for (std::size_t c = 0; c < of.columns.size(); ++c) {
        request.columns[c] = {of.columns[c].data(), 1, n};
    }
    for (std::size_t p = 0; p < of.parameters.size(); ++p) {
        request.parameters[p] = {of.parameters[p].data(), 1, n};
    }
    for (std::size_t o = 0; o < of.options.size(); ++o) request.options[o] = of.options[o];
    request.max_returns = of.returns;
    request.max_steps = of.max_steps;
    request.decided_by = of.decided_by;
    request.died_label = of.decided_by == decision::returns ? std::int16_t{0} : std::int16_t{1};
    request.label = result.label.data();
    request.outcome = result.end.data();
    request.returns = result.returns.data();
    request.events = result.events.data();
    request.time = result.time.data();
    for (std::size_t c = 0; c < result.state.size(); ++c) {
        request.state[c] = result.state[c].data();
    }
    for (std::size_t e = 0; e < result.extras.size(); ++e) {
        request.extras[e] = result.extras[e].data();
    }
    of.model->kernel(which, variant)(request);
    return result;
}

/// A failure's row, to be repeated with `eval`.
inline std::string describe(const rows& of, std::size_t i) {
    std::string text = of.name();
    char number[40];
    const auto add = [&](std::string_view name, double value) {
        std::snprintf(number, sizeof number, "%.17g", value);
        text += ", " + std::string(name) + "=" + number;
    };
    for (std::size_t c = 0; c < of.columns.size(); ++c) {
        add(of.starts_on().columns[c].name, of.columns[c][i]);
    }
    for (std::size_t p = 0; p < of.parameters.size(); ++p) {
        add(of.model->info->parameters[p].name, of.parameters[p][i]);
    }
    return text;
}

/// Models, each with the names a parametrised test needs.
inline std::vector<const model_entry*> models() {
    const auto all = all_models();
    return {all.begin(), all.end()};
}

}  // namespace hopscotch::every_model
