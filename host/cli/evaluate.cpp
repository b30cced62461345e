// Rows through the return map.
#include "host/cli/evaluate.hpp"

#include "host/cli/event_word.hpp"
#include "host/run/backends.hpp"
#include "host/run/run_choices.hpp"
#include "host/run/state_rule.hpp"

#include <cmath>
#include <map>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

namespace hopscotch {
namespace {

const section_info& end_section(const row_source& rows) {
    const model_info& info = *rows.model().info;
    const auto& start = info.sections[static_cast<std::size_t>(rows.section())];
    return info.sections[static_cast<std::size_t>(start.returns_to)];
}

/// Rows that one kernel serves: same options, same compile-time variant.
struct row_group {
    std::vector<int> options;
    int variant = 0;
    std::vector<std::size_t> rows;
};

/// All rows as doubles: [column or parameter][row].
struct row_numbers {
    std::vector<std::vector<double>> columns;
    std::vector<std::vector<double>> parameters;
    std::vector<row_group> groups;
};

int variant_of(const model_entry& model, const start_row& row) {
    return model.variant({row.parameters.data(), row.parameters.data(), row.options.data(), true});
}

row_numbers read_all(const row_source& rows) {
    row_numbers all;
    std::map<std::pair<std::vector<int>, int>, std::size_t> known;
    for (std::size_t i = 0; i < rows.n_rows(); ++i) {
        const start_row row = rows.row(i);
        all.columns.resize(row.columns.size());
        all.parameters.resize(row.parameters.size());
        for (std::size_t c = 0; c < row.columns.size(); ++c)
            all.columns[c].push_back(row.columns[c]);
        for (std::size_t p = 0; p < row.parameters.size(); ++p) {
            all.parameters[p].push_back(row.parameters[p]);
        }
        const int variant = variant_of(rows.model(), row);
        const auto [found, is_new] = known.try_emplace({row.options, variant}, all.groups.size());
        if (is_new) all.groups.push_back({row.options, variant, {}});
        all.groups[found->second].rows.push_back(i);
    }
    return all;
}

orbit_row row_of(const row_source& rows, const evaluation& what, const start_row& start) {
    orbit_row row;
    row.section = rows.section();
    row.options = start.options.data();
    row.variant = variant_of(rows.model(), start);
    row.columns = start.column_texts;
    row.parameters = start.parameter_texts;
    row.returns = what.returns;
    row.max_steps = what.max_events;
    row.tolerance = what.tolerance;
    return row;
}

/// A piece of a group, gathered for one kernel call.
class row_batch {
public:
    row_batch(const row_source& rows, const evaluation& what, const row_numbers& all,
              const row_group& group, std::size_t begin, std::size_t n)
        : rows_(rows),
          what_(what),
          indices_(group.rows.begin() + static_cast<std::ptrdiff_t>(begin),
                   group.rows.begin() + static_cast<std::ptrdiff_t>(begin + n)) {
        request_.n_cells = n;
        request_.section = rows.section();
        request_.max_returns = what.returns;
        request_.max_steps = what.max_events;
        request_.tolerance = what.tolerance;
        std::copy(group.options.begin(), group.options.end(), request_.options);
        gather(all.columns, request_.columns);
        gather(all.parameters, request_.parameters);
        outcome_.resize(n);
        returns_.resize(n);
        events_.resize(n);
        time_.resize(n);
        request_.outcome = outcome_.data();
        request_.returns = returns_.data();
        request_.events = events_.data();
        request_.time = time_.data();
        state_.assign(end_section(rows).columns.size(), std::vector<double>(n));
        extras_.assign(rows.model().info->extras.size(), std::vector<double>(n));
        for (std::size_t c = 0; c < state_.size(); ++c) request_.state[c] = state_[c].data();
        for (std::size_t e = 0; e < extras_.size(); ++e) request_.extras[e] = extras_[e].data();
    }

    void run(ensemble_function kernel, std::vector<std::string>& lines) {
        kernel(request_);
        for (std::size_t i = 0; i < indices_.size(); ++i) lines[indices_[i]] = line(i);
    }

private:
    void gather(const std::vector<std::vector<double>>& from, column_source* to) {
        for (std::size_t c = 0; c < from.size(); ++c) {
            auto& table = tables_.emplace_back();
            for (const std::size_t row : indices_) table.push_back(from[c][row]);
            to[c] = {table.data(), 1, table.size()};
        }
    }

    std::string line(std::size_t i) const {
        const auto end = static_cast<outcome>(outcome_[i]);
        const bool is_shown = has_state(*rows_.model().info, rows_.section(), end, returns_[i]);
        std::string text = fmt::format("{},{},{},{},{}", indices_[i], name_of(end), returns_[i],
                                       events_[i], number_text(time_[i]));
        for (const auto& column : state_) text += "," + (is_shown ? number_text(column[i]) : "");
        for (std::size_t e = 0; e < extras_.size(); ++e) {
            const extra_info& extra = rows_.model().info->extras[e];
            text += "," + (extra.is_word() ? word(extra, indices_[i]) : number_text(extras_[e][i]));
        }
        return text;
    }

    std::string word(const extra_info& extra, std::size_t index) const {
        const start_row start = rows_.row(index);
        return event_word(rows_.model(), extra, row_of(rows_, what_, start));
    }

    const row_source& rows_;
    const evaluation& what_;
    std::vector<std::size_t> indices_;
    ensemble_request request_;
    std::vector<std::vector<double>> tables_;
    std::vector<std::uint8_t> outcome_;
    std::vector<std::uint32_t> returns_;
    std::vector<std::uint32_t> events_;
    std::vector<double> time_;
    std::vector<std::vector<double>> state_;
    std::vector<std::vector<double>> extras_;
};

void run_ensembles(const row_source& rows, const evaluation& what,
                   std::vector<std::string>& lines) {
    constexpr std::size_t batch = 4096;
    const row_numbers all = read_all(rows);
    for (const row_group& group : all.groups) {
        const kernel_choice kernel = choose_kernel(rows.model(), group.variant, what.backend);
        const std::size_t n_batches = (group.rows.size() + batch - 1) / batch;
        tbb::parallel_for(std::size_t{0}, n_batches, [&](std::size_t i) {
            const std::size_t n = std::min(batch, group.rows.size() - i * batch);
            row_batch(rows, what, all, group, i * batch, n).run(kernel.run, lines);
        });
    }
}

std::string answer_line(std::size_t index, const orbit_answer& answer) {
    std::string text = fmt::format("{},{},{},{},{}", index, name_of(answer.end), answer.returns,
                                   answer.events, answer.time);
    for (const auto* group : {&answer.columns, &answer.extras, &answer.derivative}) {
        for (const std::string& number : *group) text += number == "nan" ? "," : "," + number;
    }
    return text;
}

void run_orbits(const row_source& rows, const evaluation& what, std::vector<std::string>& lines) {
    for (std::size_t i = 0; i < rows.n_rows(); ++i) rows.row(i);  // the first bad row, not any
    tbb::parallel_for(std::size_t{0}, rows.n_rows(), [&](std::size_t i) {
        const start_row start = rows.row(i);
        orbit_row row = row_of(rows, what, start);
        row.derivative = what.has_derivative;
        orbit_answer answer = run_orbit(rows.model(), what.precision, row);
        const auto extras = rows.model().info->extras;
        for (std::size_t e = 0; e < extras.size(); ++e) {
            if (extras[e].is_word()) answer.extras[e] = event_word(rows.model(), extras[e], row);
        }
        lines[i] = answer_line(i, answer);
    });
}

}  // namespace

std::string number_text(double x) { return std::isnan(x) ? "" : fmt::format("{:.17g}", x); }

std::string output_header(const row_source& rows, const evaluation& what) {
    std::string text = "row,outcome,returns,events,time";
    const model_info& info = *rows.model().info;
    for (const column_info& column : end_section(rows).columns)
        text += fmt::format(",{}", column.name);
    for (const extra_info& extra : info.extras) text += fmt::format(",{}", extra.name);
    if (!what.has_derivative) return text;
    const auto start = info.sections[static_cast<std::size_t>(rows.section())].columns;
    for (const column_info& column : end_section(rows).columns) {
        for (const column_info& from : start)
            text += fmt::format(",d({})_d({})", column.name, from.name);
    }
    return text;
}

std::vector<std::string> evaluate(const row_source& rows, const evaluation& what) {
    const auto n_threads = static_cast<std::size_t>(threads_for(what.n_threads));
    tbb::global_control threads(tbb::global_control::max_allowed_parallelism, n_threads);
    std::vector<std::string> lines(rows.n_rows());
    const bool is_plain = what.precision == precision::binary64 && !what.has_derivative;
    if (is_plain)
        run_ensembles(rows, what, lines);
    else
        run_orbits(rows, what, lines);
    return lines;
}

}  // namespace hopscotch
