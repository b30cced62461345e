// "Did you mean": the closest of the known names to a misspelt one.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hopscotch {

/// Insertions, deletions, substitutions and swaps of neighbours that turn one word into the other.
int edit_distance(std::string_view one, std::string_view other);

/// The closest known name, or "" where none is close (more than two letters in five differ and
/// neither contains the other).
std::string closest(std::string_view name, std::span<const std::string_view> known);

/// `closest`, or the whole list ("one of a, b, c") where nothing is close.
std::string suggest(std::string_view name, std::span<const std::string_view> known);

/// "a, b, c".
std::string listed(std::span<const std::string_view> names);

/// The names of a table of described things (parameters, columns, options ...).
template <class Table>
std::vector<std::string_view> names_of(const Table& table) {
    std::vector<std::string_view> names;
    for (const auto& row : table) names.push_back(row.name);
    return names;
}

/// Position of `name` in a table of described things, or -1.
template <class Table>
int index_of(const Table& table, std::string_view name) {
    int index = 0;
    for (const auto& row : table) {
        if (row.name == name) return index;
        ++index;
    }
    return -1;
}

}  // namespace hopscotch
