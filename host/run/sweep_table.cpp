// Columns of a sweep's index.
#include "host/run/sweep_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace hopscotch {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr const char* attractor_dimension = "attractor";
constexpr const char* ending_dimension = "ending";

using maps_of_sweep = std::vector<swept_map>;

/// A column with a number per map.
template <class Read>
index_column per_map(const maps_of_sweep& maps, std::string name, std::string unit,
                     std::string meaning, Read&& read) {
    index_column column{
        std::move(name), std::move(unit), std::move(meaning), {}, hdf5_type::float64, {}, {}};
    for (const swept_map& map : maps) column.values.push_back(map.is_there ? read(map) : nan);
    return column;
}

index_column whole_numbers(index_column column) {
    column.type = hdf5_type::int32;
    for (double& value : column.values) {
        if (std::isnan(value)) value = -1.0;
    }
    return column;
}

/// A column with a number per map and attractor (the row's label); rows(map) gives (label, number).
template <class Rows>
index_column per_attractor(const maps_of_sweep& maps, int n_labels, std::string name,
                           std::string meaning, Rows&& rows) {
    index_column column{std::move(name),
                        "1",
                        std::move(meaning),
                        {attractor_dimension},
                        hdf5_type::float64,
                        {},
                        {}};
    const auto width = static_cast<std::size_t>(n_labels);
    column.values.assign(maps.size() * width, nan);
    for (std::size_t i = 0; i < maps.size(); ++i) {
        for (const auto& [label, number] : rows(maps[i])) {
            if (label < 1 || label > n_labels) continue;
            column.values[i * width + static_cast<std::size_t>(label - 1)] = number;
        }
    }
    return column;
}

using labelled_numbers = std::vector<std::pair<int, double>>;

template <class Read>
auto of_basins(Read&& read) {
    return [read](const swept_map& map) {
        labelled_numbers rows;
        for (const attractor_row& row : map.attractors) {
            if (map.is_there)
                rows.emplace_back(row.label, 0.0);  // known, but no cell belongs to it
        }
        for (const basin_fact& fact : map.facts.basins) {
            if (!fact.is_outcome) rows.emplace_back(fact.value, read(fact));
        }
        return rows;
    };
}

int highest_label(const maps_of_sweep& maps) {
    int highest = 0;
    for (const swept_map& map : maps) {
        for (const attractor_row& row : map.attractors) highest = std::max(highest, row.label);
    }
    return highest;
}

void add_attractors(sweep_index& index, const maps_of_sweep& maps) {
    const int n_labels = highest_label(maps);
    if (n_labels == 0) return;
    index_dimension labels{attractor_dimension, "label of the attractor in its map", {}, {}};
    for (int label = 1; label <= n_labels; ++label) labels.values.push_back(label);
    index.dimensions.push_back(labels);
    index.columns.push_back(whole_numbers(per_map(
        maps, "n_attractors", "1", "attractors with a cell in the map", [](const auto& map) {
            return static_cast<double>(
                std::count_if(map.attractors.begin(), map.attractors.end(),
                              [](const attractor_row& row) { return row.share > 0.0; }));
        })));
    index.columns.push_back(
        per_attractor(maps, n_labels, "basin_share", "share of the decided cells of the map",
                      of_basins([](const basin_fact& fact) { return fact.share; })));
    index.columns.push_back(
        per_attractor(maps, n_labels, "basin_share_error", "standard error of basin_share",
                      of_basins([](const basin_fact& fact) { return fact.error; })));
    index.columns.push_back(whole_numbers(
        per_attractor(maps, n_labels, "attractor_period", "returns per period, 0 where aperiodic",
                      [](const swept_map& map) {
                          labelled_numbers rows;
                          for (const attractor_row& row : map.attractors)
                              rows.emplace_back(row.label, row.period);
                          return rows;
                      })));
    index_column names{"attractor_name",
                       "",
                       "name of the attractor",
                       {attractor_dimension},
                       hdf5_type::text,
                       {},
                       {}};
    names.texts.resize(maps.size() * static_cast<std::size_t>(n_labels));
    for (std::size_t i = 0; i < maps.size(); ++i) {
        for (const attractor_row& row : maps[i].attractors) {
            if (row.label < 1) continue;
            names.texts[i * static_cast<std::size_t>(n_labels) +
                        static_cast<std::size_t>(row.label - 1)] = row.name;
        }
    }
    index.columns.push_back(names);
}

/// The first point of every attractor, so that it can be followed along the sweep.
void add_points(sweep_index& index, const maps_of_sweep& maps) {
    const int n_labels = highest_label(maps);
    std::vector<std::string> columns;
    for (const swept_map& map : maps) {
        if (columns.empty()) columns = map.point_columns;
    }
    for (std::size_t c = 0; c < columns.size() && n_labels > 0; ++c) {
        index.columns.push_back(
            per_attractor(maps, n_labels, "attractor_" + columns[c],
                          "first point of the attractor: " + columns[c], [c](const swept_map& map) {
                              labelled_numbers rows;
                              for (const attractor_row& row : map.attractors) {
                                  if (row.points.size() > c)
                                      rows.emplace_back(row.label, row.points[c]);
                              }
                              return rows;
                          }));
    }
}

/// Shares of the cells without a label, by how they end.
void add_endings(sweep_index& index, const maps_of_sweep& maps) {
    std::map<int, std::string> names;
    for (const swept_map& map : maps) {
        for (const basin_fact& fact : map.facts.basins) {
            if (fact.is_outcome) names.emplace(fact.value, fact.name);
        }
    }
    if (names.empty()) return;
    index_dimension endings{ending_dimension, "how orbits without a label end", {}, {}};
    for (const auto& [code, name] : names) endings.texts.push_back(name);
    index.dimensions.push_back(endings);
    index_column shares{"ending_share",
                        "1",
                        "share of the decided cells of the map",
                        {ending_dimension},
                        hdf5_type::float64,
                        {},
                        {}};
    index_column errors{"ending_share_error",
                        "1",
                        "standard error of ending_share",
                        {ending_dimension},
                        hdf5_type::float64,
                        {},
                        {}};
    for (const swept_map& map : maps) {
        for (const auto& [code, name] : names) {
            double share = map.is_there ? 0.0 : nan;
            double error = share;
            for (const basin_fact& fact : map.facts.basins) {
                if (!fact.is_outcome || fact.value != code) continue;
                share = fact.share;
                error = fact.error;
            }
            shares.values.push_back(share);
            errors.values.push_back(error);
        }
    }
    index.columns.push_back(shares);
    index.columns.push_back(errors);
}

}  // namespace

void add_table(sweep_index& index, const std::vector<swept_map>& maps) {
    add_attractors(index, maps);
    add_points(index, maps);
    add_endings(index, maps);
    index.columns.push_back(per_map(maps, "undecided_share", "1",
                                    "share of all cells without answer",
                                    [](const auto& map) { return map.facts.undecided; }));
    index.columns.push_back(per_map(maps, "basin_entropy", "1", "basin entropy",
                                    [](const auto& map) { return map.facts.entropy; }));
    index.columns.push_back(per_map(maps, "boundary_basin_entropy", "1",
                                    "basin entropy of the boxes with more than one basin",
                                    [](const auto& map) { return map.facts.boundary_entropy; }));
    index.columns.push_back(
        per_map(maps, "compute_seconds", "s",
                "time that threads have spent on the map; differs from run to run",
                [](const auto& map) { return map.seconds; }));
    index_column hashes{"map_hash", "", "hash of the map", {}, hdf5_type::text, {}, {}};
    for (const swept_map& map : maps) hashes.texts.push_back(map.hash);
    index.columns.push_back(hashes);
}

void name_labels(map_layout& layout, const std::vector<swept_map>& maps) {
    std::map<int, std::string> names{{0, "none"}};
    for (const swept_map& map : maps) {
        for (const attractor_row& row : map.attractors) {
            const auto [known, is_new] = names.emplace(row.label, row.name);
            if (!is_new && known->second != row.name) return;
        }
    }
    if (names.size() == 1) return;
    for (layer& each : layout.layers) {
        if (!each.holds_labels && each.name != "label") continue;
        each.flags.assign(names.begin(), names.end());
    }
}

}  // namespace hopscotch
