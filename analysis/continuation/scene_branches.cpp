// Study, search, texts and picture in their order.
#include "analysis/continuation/scene_branches.hpp"

#include "analysis/continuation/branch_picture.hpp"
#include "analysis/continuation/branch_text.hpp"
#include "analysis/continuation/cascade.hpp"
#include "analysis/continuation/curve_text.hpp"
#include "analysis/continuation/gap_opening.hpp"
#include "analysis/continuation/scene_study.hpp"
#include "host/run/json.hpp"

#include <fmt/format.h>

namespace hopscotch {

namespace {

std::string cascades_json(const std::vector<accumulation>& cascades) {
    std::string text = "[";
    for (const accumulation& cascade : cascades) {
        text += fmt::format("{}{{\"flips\": {}, \"limit\": {}, \"error\": {}, \"ratio\": {}}}",
                            text.size() > 1 ? ", " : "", json_numbers(cascade.flips),
                            json_number(cascade.limit), json_number(cascade.error),
                            json_number(cascade.ratio));
    }
    return text + "]";
}

std::string_view free_column_of(const branch_family& family) {
    return family.map.columns_of().columns[static_cast<std::size_t>(family.columns[0])].name;
}

std::string gaps_json(const branch_family& family, const std::vector<gap_opening>& gaps) {
    std::string text = "[";
    for (const gap_opening& gap : gaps) {
        text += fmt::format("{}{{\"{}\": {}, \"{}\": {}}}", text.size() > 1 ? ", " : "",
                            family.variable.name(family.map), json_number(gap.variable),
                            free_column_of(family), json_number(gap.state));
    }
    return text + "]";
}

void add_gaps(std::vector<std::vector<std::string>>& table, const std::vector<gap_opening>& gaps) {
    for (const gap_opening& gap : gaps) {
        table.push_back({"", "", "gap opens", fmt::format("{:.17g}", gap.variable),
                         fmt::format("{:.17g}", gap.state), "", "starts there have no return"});
    }
}

void add_cascades(std::vector<std::vector<std::string>>& table,
                  const std::vector<accumulation>& cascades) {
    for (const accumulation& cascade : cascades) {
        table.push_back({"", "", "accumulation", fmt::format("{:.12g}", cascade.limit), "", "",
                         fmt::format("+- {:.2g}, from {} flips, last ratio {:.6g}", cascade.error,
                                     cascade.flips.size(), cascade.ratio)});
    }
}

}  // namespace

branch_answer follow_branches(const scene& scene, const std::string& stem) {
    const scene_study what = study_of(scene);
    const branch_family& family = what.study.family;
    const std::vector<branch> branches = find_branches(what.study);
    draw_branches(family, branches, what.shown_column, scene.title, stem + ".png");
    const std::vector<accumulation> cascades = cascades_of(branches);
    branch_answer answer{.table = rows_of(family, branches), .csv = csv_of(family, branches)};
    const std::vector<gap_opening> gaps = find_gap_openings(what.study);
    add_cascades(answer.table, cascades);
    add_gaps(answer.table, gaps);
    answer.json = json_of(family, branches) + ", \"cascades\": " + cascades_json(cascades) +
                  ", \"gaps\": " + gaps_json(family, gaps);
    if (what.second) {
        const auto curves = curves_through(family, *what.second, branches, what.study.limits);
        answer.curve_table = rows_of(family, *what.second, curves);
        answer.curve_csv = csv_of(family, *what.second, curves);
        answer.json += ", \"curves\": " + json_of(family, *what.second, curves);
        draw_curves(family, *what.second, curves, scene.title, stem + "_curves.png");
    }
    answer.json += "}\n";
    return answer;
}

}  // namespace hopscotch
