// The true answers of many cells along a line with few orbits in higher precision: the answer is
// constant between its changes, and these are found by bisection. Used by uncertain_cases.hpp.
#pragma once

#include "host/run/audit.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <tbb/parallel_for.h>

namespace hopscotch::hard {

/// Cells of a one-dimensional scene with their stored answers and flags, and as many of the true
/// answers as are asked for. A true answer is that of double-double, where that disagrees with the
/// stored one of 50 digits (`judge` of host/run/audit.hpp).
class true_line {
public:
    true_line(const scene& line, const label_plan& plan, const std::vector<int>& stored,
              const std::vector<std::uint8_t>& flags)
        : line_(line), plan_(plan), stored_(stored), flags_(flags), truth_(stored.size()) {}

    /// Evaluates every `stride`-th cell, then halves between neighbours that differ until they are
    /// next to each other, and evaluates every cell whose stored answer is not that of the
    /// evaluated cells around it, again until nothing is left to do. Of what concerns flagged cells
    /// alone only about `most_flagged` are evaluated: in fractal basins most of them are wrong.
    void bracket(std::size_t stride, std::size_t most_flagged) {
        std::vector<std::size_t> wanted;
        for (std::size_t cell = 0; cell < stored_.size(); cell += stride) wanted.push_back(cell);
        if (!stored_.empty()) wanted.push_back(stored_.size() - 1);
        while (!wanted.empty()) {
            evaluate(wanted);
            std::vector<std::size_t> for_flagged;
            wanted.clear();
            find_open_cells(wanted, for_flagged);
            const std::size_t n = std::min(for_flagged.size(), most_flagged);
            for (std::size_t i = 0; i < n; ++i) {
                wanted.push_back(for_flagged[i * for_flagged.size() / n]);
            }
            most_flagged -= n;
        }
    }

    /// The true answer of one cell, evaluated if it has not been.
    int evaluate(std::size_t cell) {
        evaluate(std::vector{cell});
        return *truth_[cell];
    }

    bool is_evaluated(std::size_t cell) const { return truth_[cell].has_value(); }
    /// Known to be wrong; cells that were not evaluated have the answer of those around them.
    bool is_wrong(std::size_t cell) const {
        return truth_[cell].has_value() && *truth_[cell] != stored_[cell];
    }
    cell_verdict verdict(std::size_t cell) const {
        return {cell, stored_[cell], truth_[cell].value_or(stored_[cell])};
    }
    std::uint64_t n_evaluated() const {
        return static_cast<std::uint64_t>(
            std::count_if(truth_.begin(), truth_.end(), [](auto& t) { return t.has_value(); }));
    }

private:
    void evaluate(const std::vector<std::size_t>& cells) {
        tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) {
            const std::size_t cell = cells[i];
            if (truth_[cell].has_value()) return;
            truth_[cell] = judge(line_, plan_, cell, stored_[cell]).computed;
        });
    }

    /// The cell half-way between evaluated neighbours that differ; between equal ones all cells
    /// that differ from them.
    void find_open_cells(std::vector<std::size_t>& open,
                         std::vector<std::size_t>& for_flagged) const {
        std::size_t before = 0;
        for (std::size_t cell = 1; cell < truth_.size(); ++cell) {
            if (!truth_[cell].has_value()) continue;
            if (*truth_[cell] != *truth_[before] && cell - before > 1) {
                const auto first = flags_.begin() + static_cast<std::ptrdiff_t>(before) + 1;
                const auto last = flags_.begin() + static_cast<std::ptrdiff_t>(cell);
                const bool is_flagged = std::find(first, last, 0) == last;
                (is_flagged ? for_flagged : open).push_back(before + (cell - before) / 2);
            } else {
                for (std::size_t i = before + 1; i < cell; ++i) {
                    if (stored_[i] != *truth_[cell])
                        (flags_[i] != 0 ? for_flagged : open).push_back(i);
                }
            }
            before = cell;
        }
    }

    const scene& line_;
    const label_plan& plan_;
    const std::vector<int>& stored_;
    const std::vector<std::uint8_t>& flags_;
    std::vector<std::optional<int>> truth_;
};

}  // namespace hopscotch::hard
