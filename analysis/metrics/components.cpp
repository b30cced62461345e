#include "analysis/metrics/components.hpp"

#include <algorithm>

namespace hopscotch::metrics {
namespace {

/// Equal cells side by side in one row.
struct run {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    class_index what = no_class;
};

using runs = std::vector<run>;

runs runs_of(const class_index* row, std::uint64_t n) {
    runs result;
    for (std::uint64_t i = 0; i < n;) {
        std::uint64_t end = i + 1;
        while (end < n && row[end] == row[i]) ++end;
        if (row[i] != no_class) {
            result.push_back(
                {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(end), row[i]});
        }
        i = end;
    }
    return result;
}

/// Union-find over runs, the number of cells at each root.
class forest {
public:
    explicit forest(std::size_t n) : parent_(n), cells_(n) {
        for (std::size_t i = 0; i < n; ++i) parent_[i] = i;
    }
    void set_cells(std::size_t i, std::uint64_t n) { cells_[i] = n; }
    std::uint64_t cells(std::size_t root) const { return cells_[root]; }
    bool is_root(std::size_t i) const { return parent_[i] == i; }

    void join(std::size_t a, std::size_t b) {
        a = root_of(a);
        b = root_of(b);
        if (a == b) return;
        if (cells_[a] < cells_[b]) std::swap(a, b);
        parent_[b] = a;
        cells_[a] += cells_[b];
    }

private:
    std::size_t root_of(std::size_t i) {
        while (parent_[i] != i) {
            parent_[i] = parent_[parent_[i]];
            i = parent_[i];
        }
        return i;
    }

    std::vector<std::size_t> parent_;
    std::vector<std::uint64_t> cells_;
};

/// Joins the runs of two neighbouring rows that overlap and have the same class.
void join_rows(const runs& a, std::size_t first_a, const runs& b, std::size_t first_b,
               forest& pieces) {
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < a.size() && j < b.size()) {
        const bool overlap = a[i].begin < b[j].end && b[j].begin < a[i].end;
        if (overlap && a[i].what == b[j].what) pieces.join(first_a + i, first_b + j);
        if (a[i].end < b[j].end) {
            ++i;
        } else {
            ++j;
        }
    }
}

}  // namespace

std::vector<component_count> components_of(const class_grid& grid) {
    const std::array<std::uint64_t, 3> n = grid.extent();
    std::vector<runs> rows(n[0] * n[1]);
#pragma omp parallel for schedule(static)
    for (std::uint64_t r = 0; r < rows.size(); ++r) {
        rows[r] = runs_of(grid.row(r / n[1], r % n[1]), n[2]);
    }
    std::vector<std::size_t> first(rows.size() + 1, 0);
    for (std::size_t r = 0; r < rows.size(); ++r) first[r + 1] = first[r] + rows[r].size();

    forest pieces(first.back());
    for (std::size_t r = 0; r < rows.size(); ++r) {
        for (std::size_t i = 0; i < rows[r].size(); ++i) {
            pieces.set_cells(first[r] + i, rows[r][i].end - rows[r][i].begin);
        }
        if (r % n[1] != 0) join_rows(rows[r - 1], first[r - 1], rows[r], first[r], pieces);
        if (r >= n[1]) join_rows(rows[r - n[1]], first[r - n[1]], rows[r], first[r], pieces);
    }
    std::vector<component_count> result(grid.classes.size());
    for (std::size_t r = 0; r < rows.size(); ++r) {
        for (std::size_t i = 0; i < rows[r].size(); ++i) {
            if (!pieces.is_root(first[r] + i)) continue;
            component_count& of_class = result[rows[r][i].what];
            ++of_class.n;
            of_class.largest = std::max(of_class.largest, pieces.cells(first[r] + i));
        }
    }
    return result;
}

}  // namespace hopscotch::metrics
