// A model that exists only in the host's tests: its tables exercise every kind of parameter, column and
// option, and its "kernel" is a plain loop whose results the tests can state in closed form.
#pragma once

#include "kernels/contract/entry.hpp"

#include <array>
#include <functional>
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

/// height -> gain * height + offset until it passes 1000 (fell) or the returns are done. With labels:
/// below 1 is attractor 1, from 10 on attractor 2, in between undecided until the returns are spent.
inline lane_statistics run(const ensemble_request& request) {
    if (on_call) on_call();
    lane_statistics lanes;
    for (std::uint64_t cell = 0; cell < request.n_cells; ++cell) {
        const bool is_launch = request.section == 1;
        double height = request.columns[0].at(cell);
        double speed = is_launch ? 0.0 : request.columns[1].at(cell);
        const double gain = request.parameters[0].at(cell);
        const double offset = request.parameters[1].at(cell);
        const bool is_valid = apex_columns[0].valid.holds(height) || is_launch;
        outcome end = is_valid ? outcome::ok : outcome::invalid_start;
        std::int16_t label = 0;
        std::uint32_t returns = 0;
        while (end == outcome::ok && returns < request.max_returns) {
            ++lanes.issued;
            ++lanes.useful;
            height = gain * height + offset;
            speed += 1.0;
            ++returns;
            if (height > 1000.0) end = outcome::fell;
            if (request.decided_by == decision::returns) continue;
            for (int trap = 0; trap < request.n_traps; ++trap) {
                const double point = request.trap_point.at(cell);
                const auto first = static_cast<std::size_t>(point) * static_cast<std::size_t>(request.n_traps);
                const trap_interval& interval = request.traps[first + static_cast<std::size_t>(trap)];
                if (height < interval.lowest || height > interval.highest) continue;
                label = static_cast<std::int16_t>(interval.label);
                end = outcome::attracted;
            }
        }
        if (request.decided_by != decision::returns && end == outcome::ok) end = outcome::budget;
        if (request.label != nullptr) request.label[cell] = label;
        if (request.outcome != nullptr) request.outcome[cell] = static_cast<std::uint8_t>(end);
        if (request.returns != nullptr) request.returns[cell] = returns;
        if (request.events != nullptr) request.events[cell] = 2 * returns;
        if (request.time != nullptr) request.time[cell] = 0.25 * returns;
        if (request.state[0] != nullptr) request.state[0][cell] = height;
        if (request.state[1] != nullptr) request.state[1][cell] = speed;
        if (request.extras[0] != nullptr) request.extras[0][cell] = returns;
    }
    return lanes;
}

inline constexpr ensemble_function kernels[2]{run, run};
inline constexpr const ensemble_function* kernel_table = kernels;

constexpr model_entry make_entry() {
    model_entry made{};
    made.info = &info;
    made.n_variants = 2;
    made.variant = variant;
    made.refusal = refusal;
    made.kernels[static_cast<int>(backend::scalar)] = &kernel_table;
    return made;
}
inline constexpr model_entry entry = make_entry();

inline const std::vector<const model_entry*>& models() {
    static const std::vector<const model_entry*> all{&entry};
    return all;
}

}  // namespace hopscotch::fake
