// Starting points for `eval`, `trace` and `replay`: state columns, parameters and options by name,
// from the columns of a table, from `--set`, and from the model's defaults; every value checked.
#pragma once

#include "host/cli/csv.hpp"
#include "kernels/contract/entry.hpp"

#include <span>
#include <string>
#include <vector>

namespace hopscotch {

/// One start: as doubles, and as the decimals that were given (shortest ones for defaults).
struct start_row {
    std::vector<double> columns;
    std::vector<double> parameters;
    std::vector<int> options;
    std::vector<std::string> column_texts;
    std::vector<std::string> parameter_texts;
};

class row_source {
public:
    /// \param table  its header names state columns of the section, parameters and options
    /// \param sets   `name=value` for all rows
    /// \error scene_error: unknown or doubled names, missing state columns, values that are no
    /// numbers
    row_source(const model_entry& model, int section, csv_table table,
               std::span<const std::string> sets);

    /// A single start from `--set` alone.
    row_source(const model_entry& model, int section, std::span<const std::string> sets);

    std::size_t n_rows() const { return n_rows_; }
    const model_entry& model() const { return *model_; }
    int section() const { return section_; }

    /// \error scene_error naming file, line, row and column: no number, outside the legal range of
    /// a
    ///        parameter, infinite where that is not legal, no such choice, refused by the model
    start_row row(std::size_t index) const;

private:
    enum class kind : std::uint8_t { column, parameter, option };
    struct target {
        kind what = kind::column;
        std::size_t index = 0;
    };
    struct origin {  // where a value came from, for messages
        std::string place;
        std::string key;
    };

    target find(std::string_view name, const origin& from) const;
    void set(start_row& row, const target& to, std::string_view text, const origin& from) const;
    void set_number(double& number, std::string& text, std::string_view given, const range& valid,
                    bool is_checked, const origin& from) const;
    void take_common(std::span<const std::string> sets);
    void take_header();
    void check_complete() const;

    const model_entry* model_;
    int section_;
    csv_table table_;
    std::size_t n_rows_ = 1;
    std::vector<target> targets_;  // one per column of the table
    start_row common_;             // defaults and --set
    std::vector<bool> is_set_[3];  // by kind: named by --set or the header
};

}  // namespace hopscotch
