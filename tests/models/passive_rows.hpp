// Runs lists of starts through the compiled ensemble kernels of the passive models, for tests.
#pragma once

#include "kernels/contract/entry.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hopscotch::passive_rows {

inline constexpr int lift_off = 0;
inline constexpr int flight = 1;

/// Compile-time variants of the passive models.
inline constexpr int untimed = 0;
inline constexpr int plastic = 1;
inline constexpr int elastic = 2;
inline constexpr int damped = 3;

/// A list of starts; a parameter is one number for all rows or one per row.
struct rows {
    std::string_view model = "passive_hopper";
    int section = lift_off;
    std::vector<std::vector<double>> columns;
    std::vector<double> mass_ratio{1.0};
    std::vector<double> restitution{0.0};
    std::vector<double> damping{0.0};
    std::vector<double> increment{0.0};
    std::uint32_t returns = 1;
    double max_steps = 1e5;
    decision decided_by = decision::returns;
    std::int16_t died_label = 0;
};

struct answers {
    std::vector<outcome> end;
    std::vector<std::int16_t> label;
    std::vector<std::uint32_t> returns;
    std::vector<std::uint32_t> events;
    std::vector<double> time;
    std::vector<double> speed;
    std::vector<double> bounces;
    std::vector<double> loss;
};

/// The variant that the model itself chooses for these rows.
inline int variant_of(const rows& of) {
    if (of.damping.size() > 1 || of.damping[0] > 0.0) return damped;
    if (of.restitution.size() > 1 || of.restitution[0] > 0.0) return elastic;
    return plastic;
}

/// Does this processor run the backend, and is it built?
inline bool can_run(backend which) {
    const model_entry* const entry = find_model("passive_hopper");
    if (entry == nullptr || !entry->has(which)) return false;
    if (which == backend::avx512)
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
    if (which == backend::avx2)
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    return true;
}
inline backend fastest() {
    if (can_run(backend::avx512)) return backend::avx512;
    return can_run(backend::avx2) ? backend::avx2 : backend::scalar;
}

inline answers run(const rows& of, backend which = backend::scalar, int variant = -1) {
    const std::size_t n = of.columns[0].size();
    answers result;
    std::vector<std::uint8_t> end(n, 255);
    result.label.assign(n, -1);
    result.returns.assign(n, 0);
    result.events.assign(n, 0);
    result.time.assign(n, 0.0);
    result.speed.assign(n, 0.0);
    result.bounces.assign(n, 0.0);
    result.loss.assign(n, 0.0);

    const std::vector<double> zero{0.0};
    ensemble_request request;
    request.n_cells = n;
    request.section = of.section;
    const auto source = [](const std::vector<double>& values) {
        return column_source{values.data(), 1, values.size()};
    };
    for (std::size_t c = 0; c < of.columns.size(); ++c) request.columns[c] = source(of.columns[c]);
    const std::vector<double>* const parameters[] = {
        &of.mass_ratio, &of.restitution, &of.damping, &of.increment, &zero, &zero, &zero};
    for (std::size_t p = 0; p < std::size(parameters); ++p)
        request.parameters[p] = source(*parameters[p]);
    request.max_returns = of.returns;
    request.max_steps = of.max_steps;
    request.decided_by = of.decided_by;
    request.died_label = of.died_label;
    request.label = result.label.data();
    request.outcome = end.data();
    request.returns = result.returns.data();
    request.events = result.events.data();
    request.time = result.time.data();
    request.state[0] = result.speed.data();
    request.extras[0] = result.bounces.data();
    request.extras[1] = result.loss.data();

    const model_entry* const entry = find_model(of.model);
    entry->kernel(which, variant < 0 ? variant_of(of) : variant)(request);
    for (const std::uint8_t code : end) result.end.push_back(static_cast<outcome>(code));
    return result;
}

/// One return of the plastic hopper from the lift-off speed alpha.
struct single_return {
    outcome end;
    double speed, bounces, loss, time;
};
inline single_return hop(double alpha, double mass_ratio, double restitution = 0.0,
                         double damping = 0.0, double increment = 0.0) {
    const answers one = run({.columns = {{alpha}},
                             .mass_ratio = {mass_ratio},
                             .restitution = {restitution},
                             .damping = {damping},
                             .increment = {increment}});
    return {one.end[0], one.speed[0], one.bounces[0], one.loss[0], one.time[0]};
}

/// A contact or flight start of the hopper.
inline single_return start(double y1, double v1, double y2, double v2, double mass_ratio,
                           double restitution = 0.0, double damping = 0.0) {
    const answers one = run({.section = flight,
                             .columns = {{y1}, {v1}, {y2}, {v2}},
                             .mass_ratio = {mass_ratio},
                             .restitution = {restitution},
                             .damping = {damping}});
    return {one.end[0], one.speed[0], one.bounces[0], one.loss[0], one.time[0]};
}

}  // namespace hopscotch::passive_rows
