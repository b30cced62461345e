// The JSON that `hopscotch analyse` writes: everything in the table, in full digits, with the
// estimators named.
#include "host/cli/analysis_report.hpp"

#include "host/run/json.hpp"

#include <fmt/format.h>

namespace hopscotch {
namespace {

using metrics::map_analysis;

/// {"key": value, ...} with values that are JSON already.
class json_object {
public:
    json_object& add(std::string_view key, const std::string& json) {
        text_ += fmt::format("{}{}: {}", text_.empty() ? "" : ", ", json_text(key), json);
        return *this;
    }
    json_object& number(std::string_view key, double x) { return add(key, json_number(x)); }
    json_object& count(std::string_view key, std::uint64_t n) {
        return add(key, fmt::format("{}", n));
    }
    json_object& flag(std::string_view key, bool is_set) {
        return add(key, is_set ? "true" : "false");
    }
    json_object& text(std::string_view key, const std::string& words) {
        return add(key, json_text(words));
    }
    std::string str() const { return "{" + text_ + "}"; }

private:
    std::string text_;
};

template <class Range, class ToJson>
std::string json_array(const Range& range, ToJson&& to_json) {
    std::string text;
    for (const auto& each : range) text += (text.empty() ? "\n    " : ",\n    ") + to_json(each);
    return "[" + text + "]";
}

std::string undefined(const std::string& why) {
    return json_object().add("defined", "false").text("why", why).str();
}

std::string law_json(const metrics::power_law& law, std::string_view name, double value) {
    if (!law.is_defined) return undefined(law.why);
    return json_object()
        .number(name, value)
        .number("error", law.error())
        .number("fit_error", law.fit_error)
        .number("sampling_error", law.sampling_error)
        .flag("is_clear", law.is_clear())
        .add("scales_in_cells", json_numbers(law.scales))
        .add("fractions", json_numbers(law.fractions))
        .str();
}

std::string exponent_json(const metrics::power_law& law) {
    return law_json(law, "exponent", law.exponent);
}

std::string dimension_json(const metrics::class_grid& grid, const metrics::power_law& law) {
    return law_json(law, "dimension", metrics::dimension_of(grid, law));
}

std::string share_json(const metrics::basin_share& share) {
    return json_object()
        .count("cells", share.n_cells)
        .number("share", share.share)
        .number("error", share.error)
        .number("lowest", share.lowest)
        .number("highest", share.highest)
        .str();
}

std::string axis_json(const axis& each) {
    return json_object()
        .text("name", each.name)
        .text("unit", each.unit)
        .text("scale", each.scale)
        .count("cells", each.size())
        .text("lengths_in", length_text(each))
        .str();
}

std::string summary_json(const metrics::fall_distances& falls, std::size_t k) {
    if (!falls.is_defined) return undefined(falls.why);
    return json_object()
        .number("shortest", falls.classes[k].shortest)
        .number("median", falls.classes[k].median)
        .str();
}

std::string class_json(const map_analysis& result, std::size_t k) {
    const metrics::basin_class& what = result.grid.classes[k];
    json_object json;
    json.add("label", what.is_outcome ? "null" : fmt::format("{}", what.value))
        .text("name", what.name)
        .flag("is_failure", what.is_fall)
        .add("share", share_json(result.shares.classes[k]))
        .add("stability", share_json(result.stability.classes[k]))
        .count("boundary_cells", result.boundary.of_classes[k])
        .count("pieces", result.components[k].n)
        .count("largest_piece", result.components[k].largest)
        .add("uncertainty", exponent_json(result.uncertainty.classes[k]))
        .add("boundary_dimension", dimension_json(result.grid, result.box_counts.classes[k]));
    if (result.wada.is_defined) {
        json.number("wada_radius", result.wada.classes[k].radius)
            .count("merged_boundary_cells", result.wada.classes[k].n_cells);
    }
    return json.add("distance_to_failure_in_cells", summary_json(result.falls_in_cells, k))
        .add("distance_to_failure", summary_json(result.falls_in_axis_units, k))
        .str();
}

std::string classes_json(const map_analysis& result) {
    std::vector<std::size_t> numbers;
    for (std::size_t k = 0; k < result.grid.classes.size(); ++k) numbers.push_back(k);
    return json_array(numbers, [&](std::size_t k) { return class_json(result, k); });
}

std::string near_json(const metrics::class_grid& grid, const metrics::nearest_other& near) {
    const bool is_found = near.class_there >= 0;
    return json_object()
        .number("distance", near.distance)
        .add("nearest_cell", json_numbers(near.at))
        .add("basin_there",
             is_found ? json_text(grid.classes[static_cast<std::size_t>(near.class_there)].name)
                      : "null")
        .number("distance_to_edge", near.distance_to_edge)
        .flag("edge_is_nearer", near.is_limited_by_edge())
        .flag("undecided_is_nearer", near.is_limited_by_undecided())
        .str();
}

std::string_view name_of(metrics::basin_end end) {
    switch (end) {
        case metrics::basin_end::other_basin:
            return "other basin";
        case metrics::basin_end::undecided:
            return "undecided";
        case metrics::basin_end::edge:
            break;
    }
    return "edge";
}

std::string extent_json(const metrics::axis_extent& each) {
    return json_object()
        .number("left", each.left)
        .number("right", each.right)
        .text("left_end", std::string(name_of(each.left_end)))
        .text("right_end", std::string(name_of(each.right_end)))
        .str();
}

std::string shock_json(const metrics::class_grid& grid, const metrics::critical_shock& shock) {
    json_object json;
    json.add("label", fmt::format("{}", shock.label))
        .text("name", shock.name)
        .flag("defined", shock.is_defined)
        .count("points", shock.n_points)
        .count("points_in_map", shock.n_in_map);
    if (!shock.is_defined) return json.text("why", shock.why).str();
    return json.add("point", json_numbers(shock.point))
        .flag("point_is_in_own_basin", shock.is_in_own_basin)
        .add("in_axis_units", near_json(grid, shock.in_axis_units))
        .add("in_cells", near_json(grid, shock.in_cells))
        .add("extents", json_array(shock.extents, extent_json))
        .str();
}

/// Every attractor of every slice: a flat list, as data frames want it.
std::string slices_json(const metrics::class_grid& grid,
                        const metrics::shocks_over_parameters& over) {
    std::vector<std::string> rows;
    for (const metrics::slice_shocks& slice : over.slices) {
        for (const metrics::critical_shock& shock : slice.shocks) {
            json_object row;
            for (std::size_t i = 0; i < over.axes.size(); ++i) {
                row.number(over.axes[i].name, slice.at[i]);
            }
            rows.push_back(row.add("shock", shock_json(grid, shock)).str());
        }
    }
    return json_array(rows, [](const std::string& row) { return row; });
}

std::string entropy_json(const metrics::basin_entropy& entropy) {
    return json_object()
        .count("box", entropy.box)
        .count("boxes", entropy.n_boxes)
        .count("boundary_boxes", entropy.n_boundary_boxes)
        .number("basin_entropy", entropy.whole)
        .number("boundary_basin_entropy", entropy.boundary)
        .number("error", entropy.boundary_error)
        .flag("is_above_ln2", entropy.is_above_ln2())
        .str();
}

std::string wada_json(const map_analysis& result, wada_tolerance tolerance) {
    const metrics::wada_test& wada = result.wada;
    if (!wada.is_defined) return undefined(wada.why);
    std::vector<double> beyond;
    for (std::size_t i = 0; i < wada.radii.size(); ++i) beyond.push_back(wada.beyond(i));
    json_object json;
    json.number("radius", wada.radius()).number("tolerance", tolerance.cells);
    if (tolerance.is_decidable(result.grid)) {
        json.flag("is_wada", wada.is_wada(tolerance.cells));
    } else {
        json.add("is_wada", "null").text("why", "the map is too small to decide");
    }
    return json.add("radii", json_numbers(wada.radii))
        .add("largest_share_beyond", json_numbers(beyond))
        .str();
}

std::string estimators_json() {
    return json_object()
        .text(
            "share",
            "of the cells that have a class; error: interleaved coarser grids (Cochran 1977, "
            "chapter 8), on the large side; lowest, highest: cells without a class all elsewhere, "
            "all here")
        .text("stability", "the same in the reference box (Menck et al. 2013)")
        .text("uncertainty",
              "Grebogi et al. 1983; error: straight line and jackknife over parts "
              "of the map in quadrature")
        .text("boundary_dimension", "boxes seen through 3 points a side; errors as above")
        .text("entropy", "Daza et al. 2016; error: jackknife over parts of the map")
        .text("wada", "merging, Daza et al. 2018; cells")
        .text("distances",
              "between cell centres; the boundary lies up to one cell nearer; axes of "
              "different units are joined as plain numbers")
        .str();
}

}  // namespace

std::string analysis_json(const metrics::map_analysis& result, wada_tolerance tolerance,
                          const std::string& file) {
    const metrics::class_grid& grid = result.grid;
    std::string text = "{\n";
    const auto add = [&](std::string_view key, const std::string& json) {
        text += fmt::format("  {}: {},\n", json_text(key), json);
    };
    add("file", json_text(file));
    add("layer", json_text(result.layer));
    add("cells", fmt::format("{}", grid.cells.size()));
    add("axes", json_array(grid.axes, axis_json));
    add("decided", fmt::format("{}", grid.n_decided()));
    add("undecided", fmt::format("{}", grid.n_undecided));
    add("outside_domain", fmt::format("{}", grid.n_outside));
    add("not_computed", fmt::format("{}", grid.n_not_computed));
    add("classes_counted_together", fmt::format("{}", grid.n_lumped));
    add("boundary_cells", fmt::format("{}", result.boundary.n_cells));
    add("entropy", entropy_json(result.entropy));
    add("uncertainty", exponent_json(result.uncertainty.whole));
    add("boundary_dimension", dimension_json(grid, result.box_counts.whole));
    add("wada", wada_json(result, tolerance));
    add("reference_box_cells", fmt::format("{}", result.stability.n_cells));
    add("classes", classes_json(result));
    add("critical_shocks", json_array(result.shocks, [&](const metrics::critical_shock& shock) {
            return shock_json(grid, shock);
        }));
    add("critical_shocks_over_parameters", slices_json(grid, result.shocks_of_slices));
    add("problems", json_texts(result.problems));
    return text + fmt::format("  \"estimators\": {}\n}}\n", estimators_json());
}

}  // namespace hopscotch
