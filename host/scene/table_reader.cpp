// Typed access to one table of a scene.
#include "host/scene/table_reader.hpp"

#include "host/scene/suggest.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace hopscotch {

table_reader::table_reader(const document& scene, std::string path, const setting* table, int line)
    : scene_(&scene), path_(std::move(path)), table_(table), line_(line) {}

table_reader table_reader::root(const document& scene) {
    return table_reader(scene, "", &scene.root, 1);
}

const setting* table_reader::entry(std::string_view key) const {
    return table_ == nullptr ? nullptr : table_->find(key);
}

std::string table_reader::dotted(std::string_view key) const {
    return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

table_reader table_reader::table(std::string_view key) const {
    const setting* found = entry(key);
    if (found == nullptr) return table_reader(*scene_, dotted(key), nullptr, line_);
    if (!found->is_table()) refuse(key, "a table is needed here", "[" + dotted(key) + "]");
    return table_reader(*scene_, dotted(key), found, found->line);
}

std::vector<table_reader> table_reader::tables(std::string_view key) const {
    std::vector<table_reader> result;
    const setting* found = entry(key);
    if (found == nullptr) return result;
    const std::string suggestion = "[[" + dotted(key) + "]]";
    const auto* list = std::get_if<setting::list>(&found->value);
    if (list == nullptr) refuse(key, "a list of tables is needed here", suggestion);
    for (std::size_t index = 0; index < list->size(); ++index) {
        const setting& entry = (*list)[index];
        if (!entry.is_table()) refuse(key, "a list of tables is needed here", suggestion);
        result.emplace_back(*scene_, fmt::format("{}[{}]", dotted(key), index), &entry, entry.line);
    }
    return result;
}

void table_reader::expect_keys(std::span<const std::string_view> known,
                               std::string_view what) const {
    for (const std::string& key : keys()) {
        const bool is_known = std::find(known.begin(), known.end(), key) != known.end();
        if (!is_known) refuse(key, fmt::format("unknown {}", what), suggest(key, known));
    }
}

void table_reader::expect_keys(std::initializer_list<std::string_view> known) const {
    expect_keys(std::span(known.begin(), known.size()));
}

std::vector<std::string> table_reader::keys() const {
    std::vector<std::string> names;
    if (table_ == nullptr) return names;
    for (const auto& [key, value] : std::get<setting::table>(table_->value)) names.push_back(key);
    return names;
}

std::string table_reader::place(std::string_view key) const {
    const setting* found = entry(key);
    return scene_->place(found == nullptr ? line_ : found->line);
}

std::optional<std::string> table_reader::text(std::string_view key) const {
    const setting* found = entry(key);
    if (found == nullptr) return std::nullopt;
    const auto* text = std::get_if<std::string>(&found->value);
    if (text == nullptr) refuse(key, "text in quotes is needed here");
    return *text;
}

std::optional<bool> table_reader::flag(std::string_view key) const {
    const setting* found = entry(key);
    if (found == nullptr) return std::nullopt;
    const auto* flag = std::get_if<bool>(&found->value);
    if (flag == nullptr) refuse(key, "true or false is needed here");
    return *flag;
}

std::optional<double> table_reader::number(std::string_view key) const {
    const setting* found = entry(key);
    if (found == nullptr) return std::nullopt;
    if (const auto* whole = std::get_if<std::int64_t>(&found->value)) {
        return static_cast<double>(*whole);
    }
    const auto* number = std::get_if<double>(&found->value);
    if (number == nullptr) refuse(key, "a number is needed here");
    if (std::isnan(*number)) refuse(key, "not a number");
    return *number;
}

namespace {

std::optional<std::int64_t> whole_of(const setting& value) {
    if (const auto* whole = std::get_if<std::int64_t>(&value.value)) return *whole;
    const auto* number = std::get_if<double>(&value.value);  // 1e6 is a whole number too
    if (number == nullptr || std::abs(*number) > 9e15) return std::nullopt;
    if (std::trunc(*number) != *number) return std::nullopt;
    return static_cast<std::int64_t>(*number);
}

}  // namespace

std::optional<std::int64_t> table_reader::whole(std::string_view key, std::int64_t least,
                                                std::int64_t most) const {
    const setting* found = entry(key);
    if (found == nullptr) return std::nullopt;
    const auto whole = whole_of(*found);
    if (!whole) refuse(key, "a whole number is needed here");
    if (*whole < least) refuse(key, fmt::format("must be at least {}", least));
    if (*whole > most) refuse(key, fmt::format("must be at most {}", most));
    return whole;
}

std::optional<std::vector<double>> table_reader::numbers(std::string_view key) const {
    const setting* found = entry(key);
    if (found == nullptr) return std::nullopt;
    const auto* list = std::get_if<setting::list>(&found->value);
    if (list == nullptr) refuse(key, "a list of numbers is needed here", "[0.1, 0.2]");
    std::vector<double> result;
    for (const setting& value : *list) {
        const auto* whole = std::get_if<std::int64_t>(&value.value);
        const auto* number = std::get_if<double>(&value.value);
        if (whole == nullptr && number == nullptr) {
            refuse(key, "a list of numbers is needed here", "[0.1, 0.2]");
        }
        result.push_back(whole != nullptr ? static_cast<double>(*whole) : *number);
        if (std::isnan(result.back())) refuse(key, "not a number");
    }
    return result;
}

std::optional<std::vector<std::string>> table_reader::texts(std::string_view key) const {
    const setting* found = entry(key);
    if (found == nullptr) return std::nullopt;
    const auto* list = std::get_if<setting::list>(&found->value);
    if (list == nullptr) refuse(key, "a list of texts is needed here", "[\"...\", \"...\"]");
    std::vector<std::string> result;
    for (const setting& value : *list) {
        const auto* text = std::get_if<std::string>(&value.value);
        if (text == nullptr) refuse(key, "a list of texts is needed here", "[\"...\", \"...\"]");
        result.push_back(*text);
    }
    return result;
}

std::optional<std::vector<std::int64_t>> table_reader::wholes(std::string_view key,
                                                              std::int64_t least) const {
    const setting* found = entry(key);
    if (found == nullptr) return std::nullopt;
    const auto* list = std::get_if<setting::list>(&found->value);
    if (list == nullptr) refuse(key, "a list of whole numbers is needed here", "[256, 256]");
    std::vector<std::int64_t> result;
    for (const setting& value : *list) {
        const auto whole = whole_of(value);
        if (!whole) refuse(key, "a list of whole numbers is needed here", "[256, 256]");
        if (*whole < least) refuse(key, fmt::format("each must be at least {}", least));
        result.push_back(*whole);
    }
    return result;
}

void table_reader::refuse(std::string_view key, const std::string& why,
                          const std::string& suggestion) const {
    const setting* found = entry(key);
    if (found == nullptr) missing(key, why, suggestion);
    const std::string value = found->is_table() ? "" : found->written();
    throw scene_error({scene_->place(found->line), dotted(key), value, why, suggestion});
}

void table_reader::missing(std::string_view key, const std::string& why,
                           const std::string& suggestion) const {
    throw scene_error({scene_->place(line_), dotted(key), "", why, suggestion});
}

}  // namespace hopscotch
