// Starting points by name.
#include "host/cli/row_source.hpp"

#include "host/cli/decimal.hpp"
#include "host/scene/error.hpp"
#include "host/scene/range_text.hpp"
#include "host/scene/suggest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace hopscotch {
namespace {

const section_info& section_of(const model_entry& model, int section) {
    return model.info->sections[static_cast<std::size_t>(section)];
}

}  // namespace

row_source::row_source(const model_entry& model, int section, csv_table table,
                       std::span<const std::string> sets)
    : row_source(model, section, sets) {
    table_ = std::move(table);
    n_rows_ = table_.n_rows();
    take_header();
}

row_source::row_source(const model_entry& model, int section, std::span<const std::string> sets)
    : model_(&model), section_(section) {
    const std::size_t n_columns = section_of(model, section).columns.size();
    common_.columns.assign(n_columns, std::numeric_limits<double>::quiet_NaN());
    common_.column_texts.resize(n_columns);
    for (const parameter_info& parameter : model.info->parameters) {
        common_.parameters.push_back(parameter.standard);
        // the shortest decimal is the one that the model's author wrote
        common_.parameter_texts.push_back(fmt::format("{}", parameter.standard));
    }
    common_.options.assign(model.info->options.size(), 0);
    is_set_[0].resize(n_columns);
    is_set_[1].resize(model.info->parameters.size());
    is_set_[2].resize(model.info->options.size());
    take_common(sets);
}

void row_source::take_common(std::span<const std::string> sets) {
    for (const std::string& text : sets) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0) {
            throw scene_error({"command line", "--set " + text, "", "needs name=value", ""});
        }
        const std::string name = text.substr(0, equals);
        const origin from{"command line", "--set " + name};
        const target to = find(name, from);
        is_set_[static_cast<std::size_t>(to.what)][to.index] = true;
        set(common_, to, std::string_view(text).substr(equals + 1), from);
    }
}

void row_source::take_header() {
    for (const std::string_view name : table_.header) {
        const origin from{table_.file + ":1", fmt::format("header, {}", name)};
        const target to = find(name, from);
        if (is_set_[static_cast<std::size_t>(to.what)][to.index]) {
            throw scene_error(
                {from.place, from.key, "", "set by --set as well", "remove one of them"});
        }
        is_set_[static_cast<std::size_t>(to.what)][to.index] = true;
        targets_.push_back(to);
    }
    check_complete();
}

void row_source::check_complete() const {
    const section_info& section = section_of(*model_, section_);
    for (std::size_t i = 0; i < section.columns.size(); ++i) {
        if (is_set_[0][i]) continue;
        const std::string_view name = section.columns[i].name;
        const std::string place = table_.file.empty() ? "command line" : table_.file + ":1";
        const std::string suggestion = fmt::format("--set {}=...", name);
        throw scene_error(
            {place, std::string(name), "",
             fmt::format("missing: state column of section {}", section.name),
             table_.file.empty() ? suggestion : "a column of that name or " + suggestion});
    }
}

row_source::target row_source::find(std::string_view name, const origin& from) const {
    const section_info& section = section_of(*model_, section_);
    const model_info& info = *model_->info;
    std::vector<std::string_view> known = names_of(section.columns);
    if (const int i = index_of(section.columns, name); i >= 0) {
        return {kind::column, static_cast<std::size_t>(i)};
    }
    if (const int i = index_of(info.parameters, name); i >= 0) {
        return {kind::parameter, static_cast<std::size_t>(i)};
    }
    if (const int i = index_of(info.options, name); i >= 0) {
        return {kind::option, static_cast<std::size_t>(i)};
    }
    for (const parameter_info& parameter : info.parameters) known.push_back(parameter.name);
    for (const option_info& option : info.options) known.push_back(option.name);
    throw scene_error({from.place, from.key, "",
                       fmt::format("no state column of section {}, parameter or option of {}",
                                   section.name, info.name),
                       suggest(name, known)});
}

void row_source::set_number(double& number, std::string& text, std::string_view given,
                            const range& valid, bool is_checked, const origin& from) const {
    const auto value = parse_decimal(given);
    if (!value) {
        const std::string why = given.empty() ? "an empty field" : "not a number";
        throw scene_error(
            {from.place, from.key, std::string(given), why, "a decimal such as 0.25"});
    }
    const bool must_hold = is_checked || std::isinf(*value);
    if (must_hold && !valid.holds(*value)) {
        throw scene_error(
            {from.place, from.key, std::string(given), "outside " + written(valid), ""});
    }
    number = *value;
    text = given.starts_with('+') ? given.substr(1) : given;
}

void row_source::set(start_row& row, const target& to, std::string_view text,
                     const origin& from) const {
    const std::size_t i = to.index;
    if (to.what == kind::column) {
        // a start outside its section's domain is no mistake: the kernel says `invalid_start`
        const range& valid = section_of(*model_, section_).columns[i].valid;
        set_number(row.columns[i], row.column_texts[i], text, valid, false, from);
    } else if (to.what == kind::parameter) {
        const range& valid = model_->info->parameters[i].valid;
        set_number(row.parameters[i], row.parameter_texts[i], text, valid, true, from);
    } else {
        const option_info& option = model_->info->options[i];
        const auto found = std::find(option.choices.begin(), option.choices.end(), text);
        if (found == option.choices.end()) {
            throw scene_error({from.place, from.key, std::string(text), "no such choice",
                               suggest(text, option.choices)});
        }
        row.options[i] = static_cast<int>(found - option.choices.begin());
    }
}

start_row row_source::row(std::size_t index) const {
    if (table_.header.empty()) check_complete();
    start_row row = common_;
    for (std::size_t i = 0; i < targets_.size(); ++i) {
        const origin from{table_.place(index), fmt::format("row {}, {}", index, table_.header[i])};
        set(row, targets_[i], table_.at(index, i), from);
    }
    const std::string_view why = model_->refusal(row.parameters.data(), row.options.data());
    if (why.empty()) return row;
    if (table_.header.empty()) {
        throw scene_error({"command line", "--set", "", std::string(why), ""});
    }
    throw scene_error(
        {table_.place(index), fmt::format("row {}", index), "", std::string(why), ""});
}

}  // namespace hopscotch
