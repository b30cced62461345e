// Runs moved starts and compares.
#include "host/run/uncertain.hpp"

#include "host/run/answers.hpp"
#include "host/run/doubtful.hpp"
#include "host/run/requests.hpp"
#include "host/scene/grid.hpp"

#include <utility>

namespace hopscotch {
namespace {

/// Cells of the map with their answers.
struct answered_cells {
    answered_cells(const scene& scene, const label_plan& plan, const kernel_run& run,
                   std::span<const std::uint64_t> cells)
        : tables(request_of(scene, plan, cells)), found(cells.size()), request(tables.request) {
        found.bind(request, scene);
        run_labelled(scene, plan, run, request);
    }

    cell_request tables;
    answers found;
    ensemble_request request;
};

/// Compares two runs of the same cells.
class comparison {
public:
    comparison(const scene& scene, const ensemble_request& first)
        : scene_(scene), first_(first), flags_(first.n_cells) {
        constexpr auto changes = static_cast<std::uint8_t>(certainty::answer_changes);
        for (std::uint64_t cell = 0; cell < first.n_cells; ++cell) {
            if (is_undecidable(static_cast<outcome>(first.outcome[cell]))) flags_[cell] = changes;
        }
    }

    void compare(const answer_view& second) {
        for (std::uint64_t cell = 0; cell < flags_.size(); ++cell) {
            if (has_other_answer(scene_, first_, cell, second, cell)) {
                flags_[cell] = static_cast<std::uint8_t>(certainty::answer_changes);
            } else if (flags_[cell] == 0 && has_other_events(scene_, first_, cell, second, cell)) {
                flags_[cell] = static_cast<std::uint8_t>(certainty::events_change);
            }
        }
    }

    std::vector<std::uint8_t> flags() && { return std::move(flags_); }

private:
    static bool is_undecidable(outcome end) {
        return end == outcome::unresolved_event || end == outcome::not_finite;
    }

    const scene& scene_;
    answer_view first_;
    std::vector<std::uint8_t> flags_;
};

}  // namespace

std::vector<std::uint8_t> second_look(const scene& scene, const label_plan& plan,
                                      const kernel_run& run, const ensemble_request& results) {
    const double tolerance = tolerance_of(scene);
    comparison compared(scene, results);
    answers found(results.n_cells);
    const auto look = [&](moved_request& again) {
        found.bind(again.request(), scene);
        run_labelled(scene, plan, run, again.request());
        compared.compare(answer_view(again.request()));
    };
    const std::vector<fixed_number> numbers = movable_numbers(scene, results);
    for (const double sign : {1.0, -1.0}) {
        for (const scene_axis& axis : scene.axes) {
            moved_request again(scene, results, tolerance);
            again.move_axis(axis, sign);
            look(again);
        }
        for (const fixed_number& number : numbers) {
            moved_request again(scene, results, tolerance);
            again.move_fixed(number, sign);
            look(again);
        }
    }
    return std::move(compared).flags();
}

std::vector<std::uint8_t> second_look(const scene& scene, const label_plan& plan,
                                      const kernel_run& run, std::span<const std::uint64_t> cells) {
    return second_look(scene, plan, run, answered_cells(scene, plan, run, cells).request);
}

std::vector<std::uint8_t> certainty_of(const scene& scene, const label_plan& plan,
                                       const kernel_run& run, const ensemble_request& results,
                                       std::span<const std::uint64_t> cells) {
    const double tolerance = tolerance_of(scene);
    if (!do_neighbours_tell(scene, tolerance)) {
        return second_look(scene, plan, run, results);
    }
    const answer_view found(results);
    const std::vector<std::uint64_t> places =
        doubtful_among(scene, plan, run, cells, found, tolerance);
    std::vector<std::uint8_t> flags(cells.size(), static_cast<std::uint8_t>(certainty::certain));
    if (places.empty()) return flags;
    std::vector<std::uint64_t> doubtful;
    answers first(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        doubtful.push_back(cells[places[i]]);
        first.take(i, found, places[i]);
    }
    cell_request again = request_of(scene, plan, doubtful);
    first.bind(again.request, scene);
    const std::vector<std::uint8_t> looked = second_look(scene, plan, run, again.request);
    for (std::size_t i = 0; i < places.size(); ++i) flags[places[i]] = looked[i];
    return flags;
}

std::vector<std::uint8_t> certainty_of(const scene& scene, const label_plan& plan,
                                       const kernel_run& run,
                                       std::span<const std::uint64_t> cells) {
    const answered_cells first(scene, plan, run, cells);
    return certainty_of(scene, plan, run, first.request, cells);
}

}  // namespace hopscotch
