// Runs one orbit of any model in any scalar arithmetic: double, double-double, 50 digits, and dual
// numbers over each. Included only by generated units, one per model.
#pragma once

#include "analysis/orbit/contact_survey.hpp"
#include "analysis/orbit/enclose.hpp"
#include "analysis/orbit/exponent_orbit.hpp"
#include "analysis/orbit/orbit_functions.hpp"
#include "analysis/truth/decimal.hpp"
#include "analysis/truth/real50.hpp"
#include "kernels/contract/model.hpp"
#include "kernels/ensemble/traps.hpp"
#include "kernels/lanes/double_double.hpp"
#include "kernels/lanes/dual.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// Most state columns of any section of a model: how many derivatives an orbit carries.
template <class Model>
constexpr int n_derivatives() {
    std::size_t most = 1;
    for (const section_info& section : Model::info.sections) {
        most = std::max(most, section.columns.size());
    }
    return static_cast<int>(most);
}

/// One trajectory while it is iterated one return at a time.
template <class Model, int Variant, class Real>
class single_orbit {
public:
    explicit single_orbit(const orbit_row& row) : row_(row) {}

    template <class Watch>
    void run(const Real* columns, const Real* parameters, Watch& watch) {
        take_tolerance<Model, Variant, Real>(lane, row_.tolerance);
        progress<Real> done = Model::template begin<Variant>(lane, row_.section, columns,
                                                             parameters, row_.options, watch);
        book(done);
        while (!is_over()) {
            done = Model::template step<Variant>(lane, true, watch);
            book(done);
        }
    }

    lane_of<Model, Variant, Real> lane;
    outcome end = outcome::ok;
    int label = 0;
    std::uint32_t returns = 0;
    bool has_state = true;

private:
    const orbit_row& row_;
    double steps_ = 0.0;

    bool is_over() const { return end != outcome::ok || label > 0 || returns >= row_.returns; }

    void book(const progress<Real>& done) {
        const double code = to_double(primal(done.ended));
        end = static_cast<outcome>(static_cast<int>(code));
        if (end == outcome::invalid_start) has_state = false;
        if (done.returned) ++returns;
        steps_ = done.returned ? 0.0 : steps_ + 1.0;
        if (end == outcome::ok && steps_ >= row_.max_steps) end = outcome::budget;
        if (end == outcome::ok) decide(done.returned);
        if (end == outcome::stuck || end == outcome::rest) label = row_.died_label;
        if (label > 0) {
            end = outcome::attracted;
        } else if (end == outcome::ok && returns >= row_.returns &&
                   row_.decided_by != decision::returns) {
            end = outcome::budget;
        }
    }

    int end_section() const {
        return Model::info.sections[static_cast<std::size_t>(row_.section)].returns_to;
    }

    void decide(bool returned) {
        const bool asks_model =
            row_.decided_by == decision::certificate || row_.decided_by == decision::ellipsoids;
        if constexpr (certifies<Model, Real>) {
            if (asks_model) {
                label =
                    static_cast<int>(to_double(primal(Model::template certificate<Variant>(lane))));
            }
        }
        if (row_.decided_by == decision::ellipsoids && label == 0 && returned) {
            Real columns[most_columns];
            Model::read_state(lane, end_section(), columns);
            for (const trap_ellipsoid& trap : row_.ellipsoids) {
                if (!holds(trap, columns)) continue;
                label = trap.label;
                return;
            }
        } else if (row_.decided_by == decision::intervals) {
            Real columns[most_columns];
            Model::read_state(lane, end_section(), columns);
            for (const trap_interval& trap : row_.traps) {
                if (columns[0] >= Real(trap.lowest) && columns[0] <= Real(trap.highest)) {
                    label = trap.label;
                    return;
                }
            }
        }
    }
};

template <class Real>
std::vector<Real> parse_all(std::span<const std::string> texts) {
    std::vector<Real> numbers;
    for (const std::string& text : texts) numbers.push_back(parse_real<Real>(text));
    return numbers;
}

template <class Model, int Variant, class Real>
orbit_answer plain_answer(const orbit_row& row) {
    const std::vector<Real> columns = parse_all<Real>(row.columns);
    const std::vector<Real> parameters = parse_all<Real>(row.parameters);
    single_orbit<Model, Variant, Real> orbit(row);
    unwatched watch;
    orbit.run(columns.data(), parameters.data(), watch);

    orbit_answer answer{.end = orbit.end, .label = orbit.label, .returns = orbit.returns};
    answer.events = static_cast<std::uint64_t>(to_double(orbit.lane.events));
    answer.time = print_real(orbit.lane.time);
    const auto& section = Model::info.sections[static_cast<std::size_t>(row.section)];
    const auto& ends_on = Model::info.sections[static_cast<std::size_t>(section.returns_to)];
    const bool has_state =
        orbit.has_state && (section.returns_to == row.section || orbit.returns > 0);
    std::array<Real, most_columns> state;
    Model::read_state(orbit.lane, section.returns_to, state.data());
    for (std::size_t c = 0; c < ends_on.columns.size(); ++c) {
        answer.columns.push_back(has_state ? print_real(state[c]) : "");
    }
    std::array<Real, most_extras> extras;
    Model::read_extras(orbit.lane, extras.data());
    for (std::size_t e = 0; e < Model::info.extras.size(); ++e) {
        answer.extras.push_back(print_real(extras[e]));
    }
    return answer;
}

/// Slopes of a dual orbit: by every column and, in double, by one parameter.
template <class Model, class Real>
using orbit_dual = dual<Real, n_derivatives<Model>() + (std::same_as<Real, double> ? 1 : 0)>;

template <class Model, int Variant, class Real>
void add_derivative(const orbit_row& row, orbit_answer& answer) {
    using number = orbit_dual<Model, Real>;
    std::vector<number> columns;
    for (std::size_t c = 0; c < row.columns.size(); ++c) {
        number column(parse_real<Real>(row.columns[c]));
        column.slope[c] = Real(1.0);
        columns.push_back(column);
    }
    std::vector<number> parameters;
    for (const std::string& text : row.parameters) parameters.emplace_back(parse_real<Real>(text));
    single_orbit<Model, Variant, number> orbit(row);
    unwatched watch;
    orbit.run(columns.data(), parameters.data(), watch);

    const auto& section = Model::info.sections[static_cast<std::size_t>(row.section)];
    const auto& ends_on = Model::info.sections[static_cast<std::size_t>(section.returns_to)];
    const bool has_state = orbit.returns > 0 && orbit.end == answer.end;
    std::array<number, most_columns> state;
    Model::read_state(orbit.lane, section.returns_to, state.data());
    for (std::size_t c = 0; c < ends_on.columns.size(); ++c) {
        for (std::size_t start = 0; start < row.columns.size(); ++start) {
            answer.derivative.push_back(has_state ? print_real(state[c].slope[start]) : "");
        }
    }
}

/// Variants that only leave out what nobody asked for (times) are not compiled a second time here.
template <class Model>
constexpr int full_variant(int variant) {
    if constexpr (requires { Model::full_variant(variant); }) {
        return Model::full_variant(variant);
    } else {
        return variant;
    }
}

/// Calls function(integral_constant<int, Variant>) for the row's compile-time variant.
template <class Model, int Variant = 0, class Function>
auto with_variant(int variant, const Function& function) {
    if constexpr (Variant + 1 < Model::n_variants) {
        if (variant != Variant) return with_variant<Model, Variant + 1>(variant, function);
    }
    return function(std::integral_constant<int, full_variant<Model>(Variant)>{});
}

template <class Model, class Real>
orbit_answer run_orbit(const orbit_row& row) {
    return with_variant<Model>(row.variant, [&](auto variant) {
        orbit_answer answer = plain_answer<Model, variant(), Real>(row);
        if (row.derivative) add_derivative<Model, variant(), Real>(row, answer);
        return answer;
    });
}

template <class Model, int Variant>
return_jet jet_of(const jet_query& query) {
    using number = orbit_dual<Model, double>;
    constexpr int by_parameter = n_derivatives<Model>();
    const auto& section = Model::info.sections[static_cast<std::size_t>(query.section)];
    const auto& ends_on = Model::info.sections[static_cast<std::size_t>(section.returns_to)];
    std::array<number, most_columns> columns;
    std::array<number, most_parameters> parameters;
    for (std::size_t c = 0; c < section.columns.size(); ++c) {
        columns[c] = number::variable(query.columns[c], static_cast<int>(c));
    }
    for (std::size_t p = 0; p < Model::info.parameters.size(); ++p) {
        parameters[p] = number(query.parameters[p]);
        if (static_cast<int>(p) == query.by_parameter) parameters[p].slope[by_parameter] = 1.0;
    }
    const orbit_row row{.section = query.section,
                        .options = query.options,
                        .returns = query.returns,
                        .max_steps = query.max_steps,
                        .tolerance = query.tolerance};
    single_orbit<Model, Variant, number> orbit(row);
    unwatched watch;
    orbit.run(columns.data(), parameters.data(), watch);

    return_jet jet{.end = orbit.end, .returns = orbit.returns};
    jet.events = static_cast<std::uint64_t>(orbit.lane.events.value);
    jet.time = orbit.lane.time.value;
    std::array<number, most_columns> state;
    Model::read_state(orbit.lane, section.returns_to, state.data());
    for (std::size_t i = 0; i < ends_on.columns.size(); ++i) {
        jet.state[i] = state[i].value;
        for (std::size_t j = 0; j < section.columns.size(); ++j) {
            jet.derivative[i][j] = state[i].slope[j];
        }
        jet.parameter_derivative[i] = state[i].slope[by_parameter];
    }
    return jet;
}

template <class Model>
return_jet run_jet(const jet_query& query) {
    return with_variant<Model>(query.variant,
                               [&](auto variant) { return jet_of<Model, variant()>(query); });
}

template <class Model>
exponent_answer run_exponents(const orbit_row& row, const exponent_request& wanted) {
    return with_variant<Model>(row.variant, [&](auto variant) {
        return exponent_orbit<Model, variant(), n_derivatives<Model>()>(row, wanted).run();
    });
}

/// Passes a model's phases and events on to an observer.
struct watching {
    static constexpr bool is_active = true;
    orbit_observer& observer;

    template <class Sampler>
    void phase(const char* mode, double start_time, double duration, const Sampler& sampler) {
        struct adapter final : orbit_observer::sampler {
            const Sampler& sample;
            explicit adapter(const Sampler& s) : sample(s) {}
            void state_at(double t, double* columns) const override { sample(t, columns); }
        };
        observer.phase(mode, start_time, duration, adapter(sampler));
    }
    void event(const char* name, double time, const char* mode_left, const char* mode_entered,
               const double* before, const double* after, double loss) {
        observer.event(name, time, mode_left, mode_entered, before, after, loss);
    }
};

template <class Model>
orbit_answer trace_orbit(const orbit_row& row, orbit_observer& observer) {
    return with_variant<Model>(row.variant, [&](auto variant) {
        const std::vector<double> columns = parse_all<double>(row.columns);
        const std::vector<double> parameters = parse_all<double>(row.parameters);
        single_orbit<Model, variant(), double> orbit(row);
        watching watch{observer};
        orbit.run(columns.data(), parameters.data(), watch);
        return plain_answer<Model, variant(), double>(row);
    });
}

template <class Model>
orbit_survey survey_orbit(const jet_query& query) {
    return with_variant<Model>(query.variant, [&](auto variant) {
        const orbit_row row{.section = query.section,
                            .options = query.options,
                            .returns = query.returns,
                            .max_steps = query.max_steps,
                            .tolerance = query.tolerance};
        single_orbit<Model, variant(), double> orbit(row);
        contact_survey<Model> watch(query.parameters, query.options);
        orbit.run(query.columns, query.parameters, watch);
        orbit_survey survey = watch.found;
        survey.end = orbit.end;
        survey.returns = orbit.returns;
        return survey;
    });
}

/// The survey of a model with a contact; none of others.
template <class Model>
constexpr auto survey_of() -> orbit_survey (*)(const jet_query&) {
    if constexpr (has_contact<Model>) {
        return &survey_orbit<Model>;
    } else {
        return nullptr;
    }
}

template <class Model>
inline constexpr orbit_functions orbit_table{
    &run_orbit<Model, double>, &run_orbit<Model, double_double<double>>,
    &run_orbit<Model, real50>, &trace_orbit<Model>,
    &run_jet<Model>,           &run_exponents<Model>,
    &enclose_returns<Model>,   survey_of<Model>()};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
