// Writes branches as text.
#include "analysis/continuation/branch_text.hpp"

#include "analysis/continuation/describe.hpp"
#include "host/run/json.hpp"

#include <fmt/format.h>

namespace hopscotch {
namespace {

std::string number(double x) { return fmt::format("{:.17g}", x); }

std::string multiplier_text(const std::vector<std::complex<double>>& multipliers) {
    std::string text;
    for (const auto& mu : multipliers) {
        if (mu.imag() < 0.0) continue;
        text += fmt::format("{}{:.9g}", text.empty() ? "" : " ", mu.real());
        if (mu.imag() > 0.0) text += fmt::format("+-{:.9g}i", mu.imag());
    }
    return text;
}

std::string state_text(const branch_family& family, const orbit_on_branch& orbit) {
    std::string text;
    for (const int column : family.columns) {
        text += (text.empty() ? "" : " ") + number(orbit.state[static_cast<std::size_t>(column)]);
    }
    return text;
}

std::string orbit_json(const branch_family& family, const orbit_on_branch& orbit) {
    std::vector<double> real;
    std::vector<double> imaginary;
    for (const auto& mu : orbit.multipliers) {
        real.push_back(mu.real());
        imaginary.push_back(mu.imag());
    }
    return fmt::format(
        "\"{}\": {}, \"state\": {}, \"multipliers_real\": {}, \"multipliers_imaginary\": {}, "
        "\"events\": {}",
        family.variable.name(family.map), json_number(orbit.variable), json_numbers(orbit.state),
        json_numbers(real), json_numbers(imaginary), json_text(orbit.word));
}

/// `why`, and where a multiplier has no bound, the place that orbits further away lead to.
std::string end_json(const branch_family& family, const end_of_branch& end) {
    const std::string why = fmt::format("\"why\": {}", json_text(text_of(end)));
    if (!end.place) return why;
    const singular_end& place = *end.place;
    const auto columns = [](const std::vector<double>& of) {
        return json_numbers(std::vector<double>(of.begin() + 1, of.end()));
    };
    return fmt::format(
        "{}, \"located\": {{\"{}\": {}, \"error\": {}, \"state\": {}, \"state_error\": {}}}", why,
        family.variable.name(family.map), json_number(place.numbers[0]),
        json_number(place.errors[0]), columns(place.numbers), columns(place.errors));
}

std::string branch_json(const branch_family& family, const branch& branch) {
    std::string text = fmt::format(
        "  {{\"period\": {}, \"parent\": {}, \"orbits\": {},\n   \"first\": {{{}, {}}},\n"
        "   \"last\": {{{}, {}}},\n   \"special\": [",
        branch.period, branch.parent, branch.orbits.size(), end_json(family, branch.first),
        orbit_json(family, branch.orbits.front()), end_json(family, branch.last),
        orbit_json(family, branch.orbits.back()));
    for (std::size_t i = 0; i < branch.special.size(); ++i) {
        const special_point& special = branch.special[i];
        text += fmt::format("{}\n    {{\"kind\": {}, {}, \"detail\": {}}}", i == 0 ? "" : ",",
                            json_text(name_of(special.kind)), orbit_json(family, special.orbit),
                            json_text(special.detail));
    }
    return text + "]}";
}

}  // namespace

std::string csv_of(const branch_family& family, const std::vector<branch>& branches) {
    const std::string_view variable = family.variable.name(family.map);
    std::string text = fmt::format("branch,period,orbit,point,{}", variable);
    const auto columns = family.map.columns_of().columns;
    for (const column_info& column : columns) {
        if (column.name != variable) text += fmt::format(",{}", column.name);
    }
    text += ",stable,multiplier_real,multiplier_imaginary,events\n";
    for (std::size_t b = 0; b < branches.size(); ++b) {
        const branch& branch = branches[b];
        for (std::size_t i = 0; i < branch.orbits.size(); ++i) {
            const orbit_on_branch& orbit = branch.orbits[i];
            int position = 0;
            for (const auto& point : points_of(family, branch.period, orbit)) {
                text += fmt::format("{},{},{},{},{}", b, branch.period, i, position++,
                                    number(orbit.variable));
                for (std::size_t c = 0; c < columns.size(); ++c) {
                    if (columns[c].name != variable) text += "," + number(point[c]);
                }
                text += fmt::format(",{},{},{},{}\n", orbit.is_stable() ? 1 : 0,
                                    number(orbit.multipliers.front().real()),
                                    number(orbit.multipliers.front().imag()), orbit.word);
            }
        }
    }
    return text;
}

std::string json_of(const branch_family& family, const std::vector<branch>& branches) {
    std::vector<std::string> columns;
    for (const column_info& column : family.map.columns_of().columns) {
        columns.emplace_back(column.name);
    }
    std::string text =
        fmt::format("{{\"model\": {}, \"variable\": {}, \"columns\": {}, \"branches\": [\n",
                    json_text(family.map.model->info->name),
                    json_text(family.variable.name(family.map)), json_texts(columns));
    for (std::size_t b = 0; b < branches.size(); ++b) {
        text += branch_json(family, branches[b]) + (b + 1 < branches.size() ? ",\n" : "\n");
    }
    return text + "]";
}

std::vector<std::vector<std::string>> rows_of(const branch_family& family,
                                              const std::vector<branch>& branches) {
    std::string unknowns;
    for (const int column : family.columns) {
        unknowns += unknowns.empty() ? "" : " ";
        unknowns += family.map.columns_of().columns[static_cast<std::size_t>(column)].name;
    }
    std::vector<std::vector<std::string>> rows{{"branch", "period", "what",
                                                std::string(family.variable.name(family.map)),
                                                unknowns, "multipliers", ""}};
    for (std::size_t b = 0; b < branches.size(); ++b) {
        const branch& branch = branches[b];
        const auto add = [&](std::string_view what, const orbit_on_branch& orbit,
                             const std::string& detail) {
            rows.push_back({fmt::format("{}", b), fmt::format("{}", branch.period),
                            std::string(what), number(orbit.variable), state_text(family, orbit),
                            multiplier_text(orbit.multipliers), detail});
        };
        add("begin", branch.orbits.front(), text_of(branch.first));
        for (const special_point& special : branch.special) {
            add(name_of(special.kind), special.orbit, special.detail);
        }
        add("end", branch.orbits.back(), text_of(branch.last));
    }
    return rows;
}

}  // namespace hopscotch
