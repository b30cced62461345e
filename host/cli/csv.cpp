// Comma-separated input.
#include "host/cli/csv.hpp"

#include "host/scene/error.hpp"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <iterator>

#include <fmt/format.h>

namespace hopscotch {
namespace {

std::string_view trimmed(std::string_view field) {
    constexpr std::string_view blanks = " \t\r";
    const std::size_t begin = field.find_first_not_of(blanks);
    if (begin == field.npos) return {};
    field = field.substr(begin, field.find_last_not_of(blanks) - begin + 1);
    const bool is_quoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
    return is_quoted ? field.substr(1, field.size() - 2) : field;
}

/// Fields of one line. \error scene_error where a quote is left open
std::vector<std::string_view> split(std::string_view line, const std::string& place) {
    std::vector<std::string_view> fields;
    std::size_t begin = 0;
    bool is_quoted = false;
    for (std::size_t i = 0; i <= line.size(); ++i) {
        if (i < line.size() && line[i] == '"') is_quoted = !is_quoted;
        const bool is_end = i == line.size() || (line[i] == ',' && !is_quoted);
        if (!is_end) continue;
        fields.push_back(trimmed(line.substr(begin, i - begin)));
        begin = i + 1;
    }
    if (is_quoted) throw scene_error({place, "a quote", "", "it is not closed", ""});
    return fields;
}

void check_header(const csv_table& table) {
    const std::string place = table.file + ":1";
    for (std::size_t i = 0; i < table.header.size(); ++i) {
        const std::string_view name = table.header[i];
        if (name.empty()) {
            throw scene_error(
                {place, fmt::format("header, column {}", i), "", "it has no name", ""});
        }
        if (std::count(table.header.begin(), table.header.end(), name) > 1) {
            throw scene_error(
                {place, "header", std::string(name), "the name stands there twice", ""});
        }
    }
}

void add_row(csv_table& table, std::string_view line, std::size_t number) {
    const std::string place = fmt::format("{}:{}", table.file, number);
    const std::vector<std::string_view> fields = split(line, place);
    if (fields.size() != table.header.size()) {
        const std::string why = trimmed(line).empty()
                                    ? "an empty line between rows"
                                    : fmt::format("{} fields where the header has {}",
                                                  fields.size(), table.header.size());
        throw scene_error({place, fmt::format("row {}", table.n_rows()), "", why, ""});
    }
    table.fields.insert(table.fields.end(), fields.begin(), fields.end());
    table.lines.push_back(number);
}

}  // namespace

std::string csv_table::place(std::size_t row) const {
    return fmt::format("{}:{}", file, lines[row]);
}

csv_table parse_csv(std::string_view text, std::string file) {
    csv_table table;
    table.file = std::move(file);
    table.text.assign(text.begin(), text.end());
    std::string_view left(table.text.data(), table.text.size());
    if (left.starts_with("\xef\xbb\xbf")) left.remove_prefix(3);  // byte order mark
    const std::size_t last = left.find_last_not_of(" \t\r\n");
    if (last == left.npos) {
        throw scene_error({table.file + ":1", "header", "", "the file is empty",
                           "a first line with the names of the columns"});
    }
    left = left.substr(0, last + 1);
    for (std::size_t number = 1; !left.empty(); ++number) {
        const std::size_t end = std::min(left.find('\n'), left.size());
        const std::string_view line = left.substr(0, end);
        left.remove_prefix(std::min(end + 1, left.size()));
        if (number > 1) {
            add_row(table, line, number);
            continue;
        }
        table.header = split(line, table.file + ":1");
        check_header(table);
    }
    return table;
}

csv_table read_csv(const std::filesystem::path& file) {
    if (file == "-") {
        const std::string text{std::istreambuf_iterator<char>(std::cin), {}};
        return parse_csv(text, "standard input");
    }
    std::error_code failure;
    if (!std::filesystem::exists(file, failure) || std::filesystem::is_directory(file, failure)) {
        throw scene_error({file.string(), "input", "", "no such file", ""});
    }
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream) throw scene_error({file.string(), "input", "", "the file cannot be read", ""});
    return parse_csv(text, file.string());
}

}  // namespace hopscotch
