#include "analysis/metrics/shares.hpp"

#include "host/store/store_error.hpp"

#include <algorithm>
#include <cmath>

namespace hopscotch::metrics {
namespace {

struct index_range {
    std::uint64_t begin = 0;
    std::uint64_t end = 1;

    std::uint64_t size() const { return end - begin; }
};

using index_box = std::array<index_range, 3>;

index_box indices_of(const class_grid& grid, const value_box& box) {
    index_box result;
    for (std::size_t i = 0; i < grid.rank(); ++i) {
        const std::vector<double>& values = grid.axes[i].values;
        const auto first = std::lower_bound(values.begin(), values.end(), box.lowest[i]);
        const auto last = std::upper_bound(values.begin(), values.end(), box.highest[i]);
        if (first >= last) {
            throw store_error("reference box", "it holds no cell along " + grid.axes[i].name, "");
        }
        result[3 - grid.rank() + i] = {static_cast<std::uint64_t>(first - values.begin()),
                                       static_cast<std::uint64_t>(last - values.begin())};
    }
    return result;
}

/// The interleaved grids: every `factor`-th cell along each axis, from the box's first corner on.
/// Only complete blocks of factor^axes cells count, so that all of them cover the same ground.
struct interleaving {
    std::uint64_t factor = 1;
    std::array<std::uint64_t, 3> step{1, 1, 1};
    std::array<std::uint64_t, 3> covered{1, 1, 1};

    interleaving(const class_grid& grid, const index_box& box) {
        const std::array<std::uint64_t, 3> n = grid.extent();
        factor = 8;
        for (std::size_t i = 0; i < 3; ++i) {
            if (n[i] > 1) factor = std::min(factor, std::max<std::uint64_t>(box[i].size() / 2, 1));
        }
        for (std::size_t i = 0; i < 3; ++i) {
            step[i] = n[i] > 1 ? factor : 1;
            covered[i] = box[i].size() / step[i] * step[i];
        }
    }

    std::size_t n_grids() const { return static_cast<std::size_t>(step[0] * step[1] * step[2]); }
};

/// Cells of every class, [grid][class]; the last grid takes what no complete block covers.
std::vector<std::uint64_t> counts_in(const class_grid& grid, const index_box& box,
                                     const interleaving& grids) {
    const std::size_t width = 256;  // cells without a class have a number too
    std::vector<std::uint64_t> total((grids.n_grids() + 1) * width, 0);
#pragma omp parallel
    {
        std::vector<std::uint64_t> own(total.size(), 0);
#pragma omp for schedule(static)
        for (std::uint64_t r = 0; r < box[0].size() * box[1].size(); ++r) {
            const std::uint64_t a = r / box[1].size();
            const std::uint64_t b = r % box[1].size();
            const bool is_covered = a < grids.covered[0] && b < grids.covered[1];
            const std::uint64_t first =
                (a % grids.step[0] * grids.step[1] + b % grids.step[1]) * grids.step[2];
            const class_index* cells = grid.row(box[0].begin + a, box[1].begin + b) + box[2].begin;
            const std::uint64_t end = is_covered ? grids.covered[2] : 0;
            for (std::uint64_t c = 0; c < end; ++c) {
                ++own[(first + c % grids.step[2]) * width + cells[c]];
            }
            for (std::uint64_t c = end; c < box[2].size(); ++c) {
                ++own[grids.n_grids() * width + cells[c]];
            }
        }
#pragma omp critical
        for (std::size_t i = 0; i < total.size(); ++i) total[i] += own[i];
    }
    return total;
}

/// Standard error of one class' share from its shares on the interleaved grids.
double error_from(const std::vector<double>& shares, std::uint64_t factor, std::size_t rank) {
    const auto n = static_cast<double>(shares.size());
    if (factor < 2 || shares.size() < 2) return std::numeric_limits<double>::quiet_NaN();
    double mean = 0.0;
    for (const double share : shares) mean += share / n;
    double sum = 0.0;
    for (const double share : shares) sum += (share - mean) * (share - mean);
    const auto k = static_cast<double>(factor);
    return std::sqrt(sum / (n - 1.0)) / (rank == 1 ? std::sqrt(k) : k);
}

/// Of a line of cells: standard deviation of a class' share if each of its ends lies anywhere
/// between two cells.
double error_of_ends(const class_grid& grid, const index_box& box, std::size_t which) {
    const class_index* cells = grid.row(0, 0);
    double n_ends = 0.0;
    for (std::uint64_t c = box[2].begin + 1; c < box[2].end; ++c) {
        if ((cells[c - 1] == which) != (cells[c] == which)) n_ends += 1.0;
    }
    return std::sqrt(n_ends / 12.0) / static_cast<double>(box[2].size());
}

}  // namespace

basin_shares shares_in(const class_grid& grid, const value_box& asked) {
    const index_box box = indices_of(grid, asked);
    const interleaving grids(grid, box);
    const std::vector<std::uint64_t> counts = counts_in(grid, box, grids);
    const std::size_t n_classes = grid.classes.size();
    const auto count = [&](std::size_t which, std::size_t k) { return counts[which * 256 + k]; };

    std::vector<std::uint64_t> decided(grids.n_grids() + 1, 0);
    for (std::size_t i = 0; i < decided.size(); ++i) {
        for (std::size_t k = 0; k < n_classes; ++k) decided[i] += count(i, k);
    }
    basin_shares result;
    result.n_cells = box[0].size() * box[1].size() * box[2].size();
    for (const std::uint64_t each : decided) result.n_decided += each;
    const auto n = static_cast<double>(result.n_decided);
    const auto all = static_cast<double>(result.n_cells);
    for (std::size_t k = 0; k < n_classes; ++k) {
        basin_share& share = result.classes.emplace_back();
        std::vector<double> on_grids;
        for (std::size_t i = 0; i < decided.size(); ++i) {
            share.n_cells += count(i, k);
            if (i == grids.n_grids() || decided[i] == 0) continue;
            on_grids.push_back(static_cast<double>(count(i, k)) / static_cast<double>(decided[i]));
        }
        share.lowest = static_cast<double>(share.n_cells) / all;
        share.highest = (static_cast<double>(share.n_cells) + all - n) / all;
        if (result.n_decided == 0) continue;
        share.share = static_cast<double>(share.n_cells) / n;
        share.error = error_from(on_grids, grids.factor, grid.rank());
        if (grid.rank() != 1) continue;
        const double of_ends = error_of_ends(grid, box, k);
        if (share.error < of_ends) share.error = of_ends;
    }
    return result;
}

}  // namespace hopscotch::metrics
