// How a model describes itself to the rest of the program: parameters with units and ranges,
// sections with their state columns, options, extras. The host reads these tables; kernels never
// do.
#pragma once

#include "kernels/contract/outcome.hpp"

#include <limits>
#include <span>
#include <string_view>

namespace hopscotch {

inline constexpr double unbounded = std::numeric_limits<double>::infinity();

/// An admissible interval; each end is part of it or not.
struct range {
    double lowest = -unbounded;
    double highest = unbounded;
    bool has_lowest = true;  // lowest itself is admissible
    bool has_highest =
        true;  // highest itself is admissible (infinite ends: infinity is a legal value)

    constexpr bool holds(double x) const {
        return (has_lowest ? x >= lowest : x > lowest) &&
               (has_highest ? x <= highest : x < highest);
    }
};

inline constexpr range any_finite{-unbounded, unbounded, false, false};
inline constexpr range positive{0.0, unbounded, false, false};
inline constexpr range non_negative{0.0, unbounded, true, false};
inline constexpr range only_zero{0.0, 0.0, true, true};

struct parameter_info {
    std::string_view name;
    std::string_view symbol;  // of the paper
    std::string_view unit;    // "1" where dimensionless
    double standard;          // the default
    range valid;
    std::string_view meaning;
};

struct column_info {
    std::string_view name;
    std::string_view unit;
    range valid;
    std::string_view meaning;
};

struct section_info {
    std::string_view name;
    std::span<const column_info> columns;
    int returns_to;  // index of the section whose columns a completed return puts out
    std::string_view meaning;
};

/// A choice between named alternatives; the first one is the default.
struct option_info {
    std::string_view name;
    std::span<const std::string_view> choices;
    std::string_view meaning;
};

/// The letter that an event (by its name in the trace) adds to an event word.
struct event_letter {
    std::string_view event;
    char letter;
};

/// A number reported beside the state: summed over returns, or a 0/1 flag that stays raised. With
/// letters it is a word instead, spelt by the orbit's events; the lane's number is then ignored.
struct extra_info {
    std::string_view name;
    std::string_view unit;
    std::string_view meaning;
    std::span<const event_letter> letters = {};

    constexpr bool is_word() const { return !letters.empty(); }
};

inline constexpr int most_columns = 8;
inline constexpr int most_parameters = 24;
inline constexpr int most_options = 4;
inline constexpr int most_extras = 4;

struct model_info {
    std::string_view name;
    std::string_view title;
    std::string_view reference;
    std::string_view time_unit;
    std::span<const parameter_info> parameters;
    std::span<const section_info> sections;  // the first one is the default
    std::span<const option_info> options;
    std::span<const extra_info> extras;
    std::span<const outcome> outcomes;           // besides budget, not_finite, invalid_start
    std::span<const column_info> trace_columns;  // the full physical state, as `trace` prints it
};

/// What a label that the model's own certificate gives stands for.
struct label_description {
    std::string_view kind;  // "fixed point", "hopping dies", ...; `index` is appended where >= 0
    int index = -1;
    int period = 1;
    bool has_point = false;
    double point = 0.0;  // of the section's first column
    double multiplier = 0.0;
    std::string_view trap;  // in words
};

/// A piece on which a one-dimensional return map is continuous: from a little left of `base` (where
/// a periodic point sits, or is born) to `end`.
struct map_branch {
    double base;
    double end;
};

/// What decides the compile-time variant of a kernel: the extremes of every parameter over the
/// whole map, the chosen options, and what the scene wants to see. Terms that are switched off cost
/// nothing.
struct variant_query {
    const double* lowest;   // one per parameter
    const double* highest;  // one per parameter
    const int* options;     // index of the choice, one per option
    bool wants_time = true;
};

}  // namespace hopscotch
