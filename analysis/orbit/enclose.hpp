// Runs one model over a whole set of starts in enclosures. Included only by generated units,
// one per model.
#pragma once

#include "analysis/orbit/enclosed_orbit.hpp"
#include "analysis/truth/enclosure.hpp"
#include "kernels/contract/model.hpp"

#include <algorithm>
#include <array>

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// Enclosures with their derivatives by every direction a start of the model can move in.
template <class Model>
constexpr int most_directions() {
    std::size_t most = 1;
    for (const section_info& section : Model::info.sections) {
        most = std::max(most, section.columns.size());
    }
    return static_cast<int>(most);
}
template <class Model>
using enclosed_dual = dual<enclosure, most_directions<Model>()>;

/// Puts the starts of a region on columns, exactly up to outward rounding.
template <int N>
void place_starts(const start_region& starts, std::span<dual<enclosure, N>> columns) {
    for (int i = 0; i < starts.n_columns; ++i) {
        interval value = interval::point(starts.centre[i]);
        const double* row = starts.frame + i * starts.n_directions;
        for (int j = 0; j < starts.n_directions; ++j) {
            value = value + interval::point(row[j]) * interval::point(starts.from[j]);
        }
        dual<enclosure, N> column(enclosure::of_start(value, row));
        for (int j = 0; j < starts.n_directions; ++j) column.slope[j] = enclosure(row[j]);
        columns[static_cast<std::size_t>(i)] = column;
    }
}

inline enclosed_end end_of(doubt reason) {
    switch (reason) {
        case doubt::event_not_unique:
            return enclosed_end::event_not_unique;
        case doubt::endless:
            return enclosed_end::undecided_comparison;
        case doubt::is_integrated:
        case doubt::inconsistent:
            break;
    }
    return enclosed_end::not_supported;
}

/// What a step says about the region: enclosed_end::returned while all its starts go on alike.
template <int N>
enclosed_end judged(const progress<dual<enclosure, N>>& done) {
    const interval& code = done.ended.value.range;
    if (!code.is_point()) return enclosed_end::undecided_comparison;
    if (code.low != 0.0) return enclosed_end::ended;
    return done.returned.is_certain() ? enclosed_end::returned : enclosed_end::undecided_comparison;
}

template <class Model, int Variant>
enclosed_end run_enclosed(const enclosed_query& query, std::span<enclosed_dual<Model>> state) {
    using number = enclosed_dual<Model>;
    std::array<number, most_columns> columns;
    std::array<number, most_parameters> parameters;
    place_starts(query.starts, std::span<number>(columns));
    for (std::size_t i = 0; i < query.parameters.size(); ++i) {
        parameters[i] = number(query.parameters[i]);
    }
    lane_of<Model, Variant, number> lane{};
    unwatched watch;
    progress<number> done = Model::template begin<Variant>(lane, query.section, columns.data(),
                                                           parameters.data(), query.options, watch);
    int returns = 0;
    double steps = 0.0;
    while (true) {
        const enclosed_end end = judged(done);
        if (end != enclosed_end::returned) return end;
        if (done.returned.over.can_hold) {
            ++returns;
            steps = 0.0;
        }
        if (returns >= query.returns) break;
        if (++steps > query.max_steps) return enclosed_end::ended;
        done = Model::template step<Variant>(lane, enclosure_mask(true), watch);
    }
    Model::read_state(lane, query.section, state.data());
    return enclosed_end::returned;
}

/// Both bounds of a derivative hold. Where the value's own is unbounded there may be a jump, which
/// the dual number does not see.
template <int N>
interval slope_of_state(const dual<enclosure, N>& x, int j) {
    const interval& own = x.value.slope[static_cast<std::size_t>(j)];
    const interval& finer = x.slope[j].range;
    if (!own.is_bounded() || finer.is_nan()) return interval::entire();
    return {std::max(own.low, finer.low), std::min(own.high, finer.high)};
}

/// The bounds of a region's returns under one compile-time variant.
template <class Model, int Variant>
enclosed_returns enclose_variant(const enclosed_query& query) {
    start_set set;
    set.n_columns = query.starts.n_directions;
    set.is_ball = query.starts.is_ball;
    set.radius = query.starts.radius;
    set.reach.fill(query.starts.radius);
    const enclosing scope(set);
    std::array<enclosed_dual<Model>, most_columns> state;
    enclosed_returns result;
    try {
        result.end = run_enclosed<Model, Variant>(query, state);
    } catch (const doubtful& stop) {
        result.end = end_of(stop.reason);
    }
    if (result.end != enclosed_end::returned) return result;
    const int n = query.starts.n_directions;
    for (int i = 0; i < query.starts.n_columns; ++i) {
        const enclosure& x = state[static_cast<std::size_t>(i)].value;
        result.centre_low[i] = x.centre.low;
        result.centre_high[i] = x.centre.high;
        result.low[i] = x.range.low;
        result.high[i] = x.range.high;
        for (int j = 0; j < n; ++j) {
            const interval slope = slope_of_state(state[static_cast<std::size_t>(i)], j);
            result.slope_low[i * n + j] = slope.low;
            result.slope_high[i * n + j] = slope.high;
        }
    }
    return result;
}

/// The bounds of a region's returns. The compile-time variant that leaves out times serves too.
template <class Model, int Variant = 0>
enclosed_returns enclose_returns(const enclosed_query& query) {
    if constexpr (Variant + 1 < Model::n_variants) {
        if (query.variant != Variant) return enclose_returns<Model, Variant + 1>(query);
    }
    return enclose_variant<Model, Variant>(query);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
