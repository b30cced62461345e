// A model that exists only in the host's tests: its tables exercise every kind of parameter, column
// and option, and its "kernel" is a plain loop whose results the tests can state in closed form.
#pragma once

#include "analysis/orbit/orbit_functions.hpp"
#include "kernels/contract/entry.hpp"

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace hopscotch::fake {

inline constexpr std::array<parameter_info, 3> parameters{{
    {"gain", "k", "1", 0.5, {0.0, 8.0, false, true}, "factor per return"},
    {"offset", "b", "m", 0.0, any_finite, "added per return"},
    {"mass_ratio", "M", "1", 1.0, {0.0, unbounded, false, true}, "without effect"},
}};
inline constexpr std::array<column_info, 2> apex_columns{{
    {"height", "m", non_negative, "height of the apex"},
    {"speed", "m/s", any_finite, "forward speed"},
}};
inline constexpr std::array<column_info, 1> launch_columns{
    {{"angle", "rad", any_finite, "launch angle"}}};
inline constexpr std::array<section_info, 2> sections{{
    {"apex", apex_columns, 0, "highest point"},
    {"launch", launch_columns, 0, "start only"},
}};
inline constexpr std::array<std::string_view, 2> laws{"plain", "steep"};
inline constexpr std::array<option_info, 1> options{{{"law", laws, "which law"}}};
inline constexpr std::array<extra_info, 1> extras{{{"bounces", "1", "bounces summed"}}};
inline constexpr std::array<outcome, 2> outcomes{outcome::fell, outcome::rest};
inline constexpr model_info info{"fake_bouncer", "A fake bouncer", "nobody, never", "s",
                                 parameters,     sections,         options,         extras,
                                 outcomes,       apex_columns};

inline int variant(const variant_query& query) { return query.options[0]; }

inline std::string_view refusal(const double* numbers, const int* choices) {
    const bool is_too_steep = choices[0] == 1 && numbers[0] > 2.0;
    return is_too_steep ? "the steep law needs gain <= 2" : "";
}

/// Called once per kernel call, for tests that slow down, interrupt or count.
inline std::function<void()> on_call;

/// One orbit of the fake model and where it ended.
struct flight {
    outcome end = outcome::ok;
    int label = 0;
    std::uint32_t returns = 0;
    double height = 0.0;
    double speed = 0.0;
};

/// height -> gain * height + offset until it passes 1000 (fell), enters a trap, or the returns are
/// done.
inline flight fly(int section, const double* column, const double* parameter, std::uint32_t returns,
                  decision decided_by, std::span<const trap_interval> traps) {
    flight at;
    at.height = column[0];
    at.speed = section == 1 ? 0.0 : column[1];
    if (section == 0 && !apex_columns[0].valid.holds(at.height)) at.end = outcome::invalid_start;
    while (at.end == outcome::ok && at.returns < returns) {
        at.height = parameter[0] * at.height + parameter[1];
        at.speed += 1.0;
        ++at.returns;
        if (at.height > 1000.0) at.end = outcome::fell;
        if (decided_by == decision::returns) continue;
        for (const trap_interval& trap : traps) {
            if (at.height < trap.lowest || at.height > trap.highest) continue;
            at.label = trap.label;
            at.end = outcome::attracted;
        }
    }
    if (decided_by != decision::returns && at.end == outcome::ok) at.end = outcome::budget;
    return at;
}

inline lane_statistics run(const ensemble_request& request) {
    if (on_call) on_call();
    lane_statistics lanes;
    const auto n_traps = static_cast<std::size_t>(request.n_traps);
    for (std::uint64_t cell = 0; cell < request.n_cells; ++cell) {
        double column[2]{};
        double parameter[3]{};
        for (int c = 0; c < (request.section == 1 ? 1 : 2); ++c)
            column[c] = request.columns[c].at(cell);
        for (int p = 0; p < 3; ++p) parameter[p] = request.parameters[p].at(cell);
        std::span<const trap_interval> traps;
        if (n_traps > 0) {
            traps = {
                request.traps + static_cast<std::size_t>(request.trap_point.at(cell)) * n_traps,
                n_traps};
        }
        const flight at =
            fly(request.section, column, parameter, request.max_returns, request.decided_by, traps);
        lanes.issued += at.returns;
        lanes.useful += at.returns;
        if (request.label) request.label[cell] = static_cast<std::int16_t>(at.label);
        if (request.outcome) request.outcome[cell] = static_cast<std::uint8_t>(at.end);
        if (request.returns) request.returns[cell] = at.returns;
        if (request.events) request.events[cell] = 2 * at.returns;
        if (request.time) request.time[cell] = 0.25 * at.returns;
        if (request.state[0]) request.state[0][cell] = at.height;
        if (request.state[1]) request.state[1][cell] = at.speed;
        if (request.extras[0]) request.extras[0][cell] = at.returns;
    }
    return lanes;
}

/// Single orbits. "dd" marks what it was given, so that tests see which texts arrive; with labels
/// it can be told to disagree, and mp50 to agree or not.
inline double dd_disagrees_above = unbounded;
inline double mp50_disagrees_above = unbounded;

inline orbit_answer orbit(const orbit_row& row, double disagrees_above) {
    std::vector<double> column;
    std::vector<double> parameter;
    for (const std::string& text : row.columns) column.push_back(std::stod(text));
    for (const std::string& text : row.parameters) parameter.push_back(std::stod(text));
    const flight at =
        fly(row.section, column.data(), parameter.data(), row.returns, row.decided_by, row.traps);
    orbit_answer answer;
    answer.end = at.end;
    answer.label = at.label + (column[0] > disagrees_above ? 1 : 0);
    answer.returns = at.returns;
    answer.events = 2 * at.returns;
    answer.time = "0.25";
    const bool is_shown = at.end != outcome::invalid_start;
    answer.columns = {is_shown ? "H" + row.columns[0] : "", is_shown ? "S" : ""};
    answer.extras = {"G" + row.parameters[0]};
    if (row.derivative) answer.derivative = {"1", "0", "0", "nan"};
    return answer;
}
inline orbit_answer run_double(const orbit_row& row) { return orbit(row, unbounded); }
inline orbit_answer run_dd(const orbit_row& row) { return orbit(row, dd_disagrees_above); }
inline orbit_answer run_mp50(const orbit_row& row) { return orbit(row, mp50_disagrees_above); }

inline orbit_answer trace(const orbit_row& row, orbit_observer& observer) {
    struct still final : orbit_observer::sampler {
        void state_at(double t, double* columns) const override {
            columns[0] = 1.0 + t;
            columns[1] = 2.0;
        }
    };
    const double before[2]{1.0, 2.0};
    const double after[2]{0.5, 2.0};
    observer.phase("flight", 0.0, 0.25, still{});
    observer.event("impact", 0.25, "flight", "ground", before, after, 0.125);
    observer.phase("ground", 0.25, unbounded, still{});
    return run_double(row);
}
inline constexpr orbit_functions orbits{run_double, run_dd, run_mp50, trace, nullptr, nullptr, nullptr,
                                              nullptr};
inline constexpr const orbit_functions* orbit_table = &orbits;

inline constexpr ensemble_function kernels[2]{run, run};
inline constexpr const ensemble_function* kernel_table = kernels;

constexpr model_entry make_entry() {
    model_entry made{};
    made.info = &info;
    made.n_variants = 2;
    made.variant = variant;
    made.refusal = refusal;
    made.integrates = [](int compiled_variant) { return compiled_variant == 0; };
    made.kernels[static_cast<int>(backend::scalar)] = &kernel_table;
    made.orbits_table = &orbit_table;
    return made;
}
inline constexpr model_entry entry = make_entry();

inline const std::vector<const model_entry*>& models() {
    static const std::vector<const model_entry*> all{&entry};
    return all;
}

}  // namespace hopscotch::fake
