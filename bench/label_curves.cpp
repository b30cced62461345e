// Whole orbits by every method.
#include "bench/label_curves.hpp"

#include "bench/report.hpp"
#include "bench/single_kernels.hpp"
#include "host/run/audit.hpp"
#include "host/run/backends.hpp"
#include "host/run/requests.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include <fmt/format.h>

namespace hopscotch::bench {
namespace {

constexpr int n_rounds = 5;
constexpr std::uint64_t n_timed_cells = 4096;  // of the kernels
constexpr int finest_decade = 13;
constexpr double single_tolerance = 1e-6;
constexpr std::uint64_t n_compared_cells = 100'000;

class label_curves {
public:
    explicit label_curves(const labelled_scene& which) : which_(which), cells_(which) {}

    void put() {
        put_kernels(0.0);
        for (int decade = 4; decade <= finest_decade && which_.is_integrated; ++decade) {
            put_kernels(std::pow(10.0, -decade));
        }
        put_single();
        put("double-double", 0.0, cells_.of_double_double(),
            cells_.double_double_cells_per_second());
        for (const yardstick_case& one : all_cases()) {
            if (one.name != which_.yardstick) continue;
            for (const yardstick_case::solver& solver : one.solvers) put_solver(solver);
        }
    }

private:
    /// Every backend in turn; they give the same bits, so one wrong share serves them all.
    void put_kernels(double tolerance) {
        std::vector<backend> usable;
        std::vector<std::function<void()>> pieces;
        const std::vector<std::uint64_t> timed = cells_of_grid(n_timed_cells);
        std::vector<ensemble_function> kernels;
        for (const backend which : {backend::avx512, backend::avx2, backend::scalar}) {
            if (!reason_against(*cells_.whole().model, which, kernel_kind::plain).empty()) continue;
            const kernel_choice kernel = kernel_of(cells_.whole(), name_of(which));
            usable.push_back(which);
            pieces.emplace_back([this, &timed, kernel, tolerance] {
                cells_.compute(timed, kernel.run, tolerance);
            });
            kernels.push_back(kernel.run);
        }
        const wrong_answers wrong = cells_.of_kernel(kernels.front(), tolerance);
        const auto seconds = alternate(pieces, n_rounds);
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            put(name_of(usable[k]), tolerance, wrong,
                static_cast<double>(timed.size()) / median(seconds[k]));
        }
    }

    std::vector<std::uint64_t> cells_of_grid(std::uint64_t most) const {
        return audited_cells(cells_.whole(), std::min(most, cells_.whole().n_cells()), 2);
    }

    /// Float arithmetic is emulated: it has a wrong share and no speed.
    void put_single() const {
        const ensemble_function* table = single_kernels(cells_.whole().info().name);
        if (table == nullptr) return;
        const double tolerance = which_.is_integrated ? single_tolerance : 0.0;
        const ensemble_function single = table[variant_of(cells_.whole())];
        const wrong_answers wrong = cells_.of_kernel(single, tolerance);
        // double is right in nearly all cells of a grid: many more can be compared
        const double differs = cells_.difference(cells_of_grid(n_compared_cells), single, tolerance,
                                                 kernel_of(cells_.whole(), "auto").run);
        put("float32", tolerance, wrong, std::nan(""), differs);
    }

    void put_solver(const yardstick_case::solver& solver) {
        for (int decade = 4; decade <= finest_decade; decade += 3) {
            const double tolerance = std::pow(10.0, -decade);
            double cells_per_second = 0.0;
            const wrong_answers wrong = cells_.of_solver(solver.make, tolerance, cells_per_second);
            put(solver.name, tolerance, wrong, cells_per_second);
        }
    }

    void put(std::string_view method, double tolerance, const wrong_answers& wrong,
             double cells_per_second, std::optional<double> differs = {}) const {
        json_line line("work_precision");
        line.add("case", which_.name)
            .add("model", cells_.whole().info().name)
            .add("scene", which_.scene)
            .add("answer", cells_.whole().question.has_labels ? "label" : "returns before the fall")
            .add("method", method)
            .add("tolerance", tolerance)
            .add("cells_per_second", cells_per_second)
            .add("grid_cells", static_cast<double>(cells_.n_grid()))
            .add("wrong_grid", wrong.grid)
            .add("boundary_cells", static_cast<double>(cells_.n_boundary()))
            .add("wrong_boundary", wrong.boundary);
        if (differs) {
            line.add("compared_cells", static_cast<double>(cells_of_grid(n_compared_cells).size()))
                .add("differs_from_double", *differs);
            fmt::print("{:<30} float32 differs from double in {:.2e} of the grid\n", which_.name,
                       *differs);
        }
        line.print();
        fmt::print(
            "{:<30} {:<20} {:>8.0e} {:>12.4g} cells/s  wrong of the grid {:.4f}, next to "
            "boundaries {:.4f}\n",
            which_.name, method, tolerance, cells_per_second, wrong.grid, wrong.boundary);
        std::fflush(stdout);
    }

    const labelled_scene& which_;
    labelled_cells cells_;
};

}  // namespace

void put_label_curves(const labelled_scene& which) { label_curves(which).put(); }

}  // namespace hopscotch::bench
