// The table that `hopscotch analyse` prints.
#include "host/cli/analysis_report.hpp"

#include "host/cli/tables.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace hopscotch {
namespace {

using metrics::map_analysis;
using table = std::vector<std::vector<std::string>>;

std::string number(double x) { return fmt::format("{:.6g}", x); }

std::string with_error(double value, double error) {
    if (std::isnan(error)) return fmt::format("{:.4g} +- ?", value);
    return fmt::format("{:.4g} +- {:.2g}", value, error);
}

std::string exponent_text(const metrics::power_law& law, double offset, double sign) {
    if (!law.is_defined) return "-";
    return with_error(offset + sign * law.exponent, law.error());
}

std::string range_text(const metrics::power_law& law) {
    return fmt::format("{:g} to {:g} cells", law.scales.front(), law.scales.back());
}

std::string value_text(const metrics::basin_class& what) {
    return what.is_outcome ? "-" : fmt::format("{}", what.value);
}

std::string heading(const map_analysis& result) {
    const metrics::class_grid& grid = result.grid;
    std::vector<std::string> names;
    std::vector<std::uint64_t> sizes;
    for (const axis& each : grid.axes) {
        names.push_back(each.name);
        sizes.push_back(each.size());
    }
    const auto share = [&](std::uint64_t n) {
        return number(static_cast<double>(n) / static_cast<double>(grid.cells.size()));
    };
    std::string text = fmt::format(
        "layer {}, {} cells along {}\nwithout a class: {} undecided, {} outside the domain, {} not "
        "computed (shares of all cells)\n",
        result.layer, fmt::join(sizes, " x "), fmt::join(names, " x "), share(grid.n_undecided),
        share(grid.n_outside), share(grid.n_not_computed));
    if (grid.n_lumped > 0) {
        text += fmt::format("the {} rarest classes are counted together\n", grid.n_lumped);
    }
    return text;
}

std::string class_table(const map_analysis& result) {
    const metrics::class_grid& grid = result.grid;
    const auto rank = static_cast<double>(grid.rank());
    table rows{
        {"label", "name", "share", "boundary cells", "pieces", "largest", "exponent", "dimension"}};
    for (std::size_t k = 0; k < grid.classes.size(); ++k) {
        const metrics::basin_share& share = result.shares.classes[k];
        rows.push_back({value_text(grid.classes[k]), grid.classes[k].name,
                        with_error(share.share, share.error),
                        fmt::format("{}", result.boundary.of_classes[k]),
                        fmt::format("{}", result.components[k].n),
                        fmt::format("{}", result.components[k].largest),
                        exponent_text(result.uncertainty.classes[k], 0.0, 1.0),
                        exponent_text(result.box_counts.classes[k], rank, -1.0)});
    }
    return "\n" + aligned(rows, 0);
}

std::string wada_text(const map_analysis& result, wada_tolerance tolerance) {
    const metrics::wada_test& wada = result.wada;
    if (!wada.is_defined) return "- (" + wada.why + ")";
    const std::string radius =
        fmt::format("merged boundaries lie up to {:.4g} cells apart", wada.radius());
    if (!tolerance.is_decidable(result.grid)) return radius + " (the map is too small to decide)";
    return fmt::format("{}: {} (tolerance {:g})", wada.is_wada(tolerance.cells) ? "yes" : "no",
                       radius, tolerance.cells);
}

std::string whole_map(const map_analysis& result, wada_tolerance tolerance) {
    const metrics::power_law& law = result.uncertainty.whole;
    const metrics::power_law& boxes = result.box_counts.whole;
    const auto rank = static_cast<double>(result.grid.rank());
    const metrics::basin_entropy& entropy = result.entropy;
    const auto reason = [](const metrics::power_law& from) {
        if (!from.is_defined) return from.why;
        return range_text(from) + (from.is_clear() ? "" : "; no clear power law");
    };
    const table rows{
        {"boundary cells", fmt::format("{}", result.boundary.n_cells)},
        {"basin entropy",
         fmt::format("S_b {}, S_bb {} ({} boxes of {} cells a side{})", number(entropy.whole),
                     with_error(entropy.boundary, entropy.boundary_error), entropy.n_boxes,
                     entropy.box, entropy.is_above_ln2() ? "; above ln 2: fractal" : "")},
        {"uncertainty exponent", fmt::format("{} ({})", exponent_text(law, 0.0, 1.0), reason(law))},
        {"box dimension", fmt::format("{} ({})", exponent_text(boxes, rank, -1.0), reason(boxes))},
        {"Wada", wada_text(result, tolerance)}};
    return "\nwhole map\n" + aligned(rows);
}

std::string stability_table(const map_analysis& result) {
    if (result.stability.n_cells == result.grid.cells.size()) return "";
    table rows{{"label", "name", "share"}};
    for (std::size_t k = 0; k < result.grid.classes.size(); ++k) {
        const metrics::basin_share& share = result.stability.classes[k];
        rows.push_back({value_text(result.grid.classes[k]), result.grid.classes[k].name,
                        with_error(share.share, share.error)});
    }
    return fmt::format("\nbasin stability in the reference box ({} cells)\n",
                       result.stability.n_cells) +
           aligned(rows);
}

std::string fall_table(const map_analysis& result) {
    if (!result.falls_in_cells.is_defined) return "";
    table rows{{"label", "name", "shortest (cells)", "median (cells)", "shortest", "median"}};
    for (std::size_t k = 0; k < result.grid.classes.size(); ++k) {
        const metrics::distance_summary& cells = result.falls_in_cells.classes[k];
        const metrics::distance_summary& units = result.falls_in_axis_units.classes[k];
        if (!(cells.shortest > 0.0)) continue;
        rows.push_back({value_text(result.grid.classes[k]), result.grid.classes[k].name,
                        number(cells.shortest), number(cells.median), number(units.shortest),
                        number(units.median)});
    }
    return "\ndistance to the nearest failing cell\n" + aligned(rows);
}

/// A length up to another basin; ">" in front where undecided cells or the map's edge come first.
std::string reach(double length, bool is_limited) {
    return (is_limited ? ">" : "") + number(length);
}

std::string extents_text(const metrics::critical_shock& shock) {
    std::string text;
    for (const metrics::axis_extent& each : shock.extents) {
        text += fmt::format("{}{} / {}", text.empty() ? "" : ", ",
                            reach(each.left, each.left_end != metrics::basin_end::other_basin),
                            reach(each.right, each.right_end != metrics::basin_end::other_basin));
    }
    return text;
}

/// The shock, and what may make it smaller.
std::string shock_text(const metrics::nearest_other& near) {
    std::string text = number(near.distance);
    if (near.is_limited_by_edge()) text += " (edge nearer)";
    if (near.is_limited_by_undecided()) text += " (undecided nearer)";
    return text;
}

/// Over the slices of fixed parameters: where the smallest and the largest shock are.
std::string slices_table(const map_analysis& result) {
    const metrics::shocks_over_parameters& over = result.shocks_of_slices;
    struct sized {
        double distance;
        const metrics::slice_shocks* slice;
    };
    std::map<std::pair<int, std::string>, std::vector<sized>> by_label;
    for (const metrics::slice_shocks& slice : over.slices) {
        for (const metrics::critical_shock& shock : slice.shocks) {
            by_label[{shock.label, shock.name}].push_back({shock.in_axis_units.distance, &slice});
        }
    }
    const auto told = [&](const sized& each) {
        std::string text = number(each.distance) + " at";
        for (std::size_t i = 0; i < over.axes.size(); ++i) {
            text += fmt::format(" {} = {}", over.axes[i].name, number(each.slice->at[i]));
        }
        return text;
    };
    table rows{{"label", "name", "slices", "smallest", "median", "largest"}};
    for (auto& [key, shocks] : by_label) {
        std::sort(shocks.begin(), shocks.end(),
                  [](const sized& a, const sized& b) { return a.distance < b.distance; });
        rows.push_back({fmt::format("{}", key.first), key.second,
                        fmt::format("{} of {}", shocks.size(), over.slices.size()),
                        told(shocks.front()), number(shocks[shocks.size() / 2].distance),
                        told(shocks.back())});
    }
    return "\nminimal critical shock, slice by slice (all are in the JSON)\n" +
           (rows.size() > 1 ? aligned(rows) : "  no attractor has a point in its slice\n");
}

std::string shock_table(const map_analysis& result) {
    if (!result.shocks_of_slices.slices.empty()) return slices_table(result);
    if (result.shocks.empty()) return "";
    table rows{{"label", "name", "shock", "in cells", "nearest cell", "extents (left / right)"}};
    std::string reasons;
    for (const metrics::critical_shock& shock : result.shocks) {
        if (!shock.is_defined) {
            if (reasons.find(shock.why) == std::string::npos)
                reasons += "  - (" + shock.why + ")\n";
            continue;
        }
        rows.push_back({fmt::format("{}", shock.label), shock.name, shock_text(shock.in_axis_units),
                        number(shock.in_cells.distance),
                        fmt::format("{:.6g}", fmt::join(shock.in_axis_units.at, ", ")),
                        extents_text(shock)});
    }
    return "\nminimal critical shock\n" + (rows.size() > 1 ? aligned(rows) : "") + reasons;
}

std::string length_note(const map_analysis& result) {
    std::vector<std::string> parts;
    for (const axis& each : result.grid.axes)
        parts.push_back(each.name + " in " + length_text(each));
    std::string text = fmt::format("\nlengths: {}\n", fmt::join(parts, ", "));
    constexpr std::size_t most = 5;  // all of them are in the JSON
    for (std::size_t i = 0; i < std::min(most, result.problems.size()); ++i) {
        text += result.problems[i] + "\n";
    }
    if (result.problems.size() > most) {
        text += fmt::format("and {} more tiles\n", result.problems.size() - most);
    }
    return text;
}

}  // namespace

bool wada_tolerance::is_decidable(const metrics::class_grid& grid) const {
    return std::all_of(grid.axes.begin(), grid.axes.end(), [&](const axis& each) {
        return static_cast<double>(each.size()) >= 10.0 * cells;
    });
}

std::string length_text(const axis& along) {
    if (along.scale == "log") return "ln(value)";
    return along.unit.empty() ? "value" : "value (" + along.unit + ")";
}

std::string analysis_text(const metrics::map_analysis& analysis, wada_tolerance wada) {
    return heading(analysis) + class_table(analysis) + whole_map(analysis, wada) +
           stability_table(analysis) + fall_table(analysis) + shock_table(analysis) +
           length_note(analysis);
}

}  // namespace hopscotch
