// Tables and JSON of stability sectors.
#include "host/cli/sector_text.hpp"

#include "host/cli/tables.hpp"
#include "host/run/json.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace hopscotch {
namespace {

std::string extent_text(const stability_sector& sector) {
    return sector.is_bounded ? fmt::format("{:.12g}", sector.extent)
                             : fmt::format("> {:g}", sector.extent);
}

}  // namespace

std::string sector_text(const scene& scene, const label_plan& plan,
                        const std::vector<sector_row>& rows) {
    if (rows.empty()) return "";
    std::vector<std::vector<std::string>> table{
        {"at", "name", "directions that attract", "nearest end", "farthest end", "slowest law"}};
    for (const sector_row& row : rows) {
        std::string at;
        for (std::size_t i = 0; i < row.at.size(); ++i) {
            at += fmt::format("{}{} = {:.6g}", at.empty() ? "" : " ",
                              scene.axes[plan.point_axes[i]].name, row.at[i]);
        }
        const auto by_extent = [](const stability_sector& a, const stability_sector& b) {
            return a.extent < b.extent;
        };
        const auto [nearest, farthest] =
            std::minmax_element(row.sectors.begin(), row.sectors.end(), by_extent);
        const auto slowest = std::max_element(
            row.sectors.begin(), row.sectors.end(),
            [](const auto& a, const auto& b) { return a.coefficient < b.coefficient; });
        const auto n_attracting = std::count_if(row.sectors.begin(), row.sectors.end(),
                                                [](const auto& sector) { return sector.attracts; });
        table.push_back({at, row.name, fmt::format("{} of {}", n_attracting, row.sectors.size()),
                         extent_text(*nearest), extent_text(*farthest),
                         fmt::format("{:.6g} d^{:.6g}", slowest->coefficient, slowest->exponent)});
    }
    return "\n" + aligned(table, 0);
}

std::string sector_json(const std::vector<sector_row>& rows) {
    std::string text = "[";
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const sector_row& row = rows[i];
        text += fmt::format(
            "{}\n  {{\"name\": {}, \"at\": {}, \"point\": {}, \"scale\": {}, \"rays\": [",
            i == 0 ? "" : ",", json_text(row.name), json_numbers(row.at), json_numbers(row.point),
            json_numbers(row.scale));
        for (std::size_t k = 0; k < row.sectors.size(); ++k) {
            const stability_sector& sector = row.sectors[k];
            text += fmt::format(
                "{}\n    {{\"direction\": {}, \"attracts\": {}, \"coefficient\": {}, \"exponent\": "
                "{}, \"extent\": {}, \"is_bounded\": {}}}",
                k == 0 ? "" : ",", json_numbers(sector.direction), sector.attracts,
                json_number(sector.coefficient), json_number(sector.exponent),
                json_number(sector.extent), sector.is_bounded);
        }
        text += "]}";
    }
    return text + "\n]";
}

}  // namespace hopscotch
