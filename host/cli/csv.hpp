// Comma-separated input: a header and rows of equal length, kept as views into the file's text.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hopscotch {

/// Movable only: the fields point into `text`.
struct csv_table {
    csv_table() = default;
    csv_table(csv_table&&) = default;
    csv_table& operator=(csv_table&&) = default;

    std::string file;
    std::vector<char> text;
    std::vector<std::string_view> header;
    std::vector<std::string_view> fields;  // row by row
    std::vector<std::size_t> lines;        // of each row, counted from 1

    std::size_t n_rows() const { return lines.size(); }
    std::string_view at(std::size_t row, std::size_t column) const {
        return fields[row * header.size() + column];
    }
    /// "rows.csv:7"
    std::string place(std::size_t row) const;
};

/// \param file  only names the text in messages
/// \error scene_error naming line and row: no header, a header name twice, fields too few or too
/// many,
///        an empty line between rows, a quote that is not closed
csv_table parse_csv(std::string_view text, std::string file);

/// Reads a file, or standard input where it is "-".
csv_table read_csv(const std::filesystem::path& file);

}  // namespace hopscotch
