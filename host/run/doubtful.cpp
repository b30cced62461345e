// Compares cells with their neighbours and tries the fixed numbers block by block.
#include "host/run/doubtful.hpp"

#include "host/run/moved_starts.hpp"
#include "host/run/requests.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

namespace hopscotch {
namespace {

constexpr double least_spacing = 0x1p14;            // displacements between neighbours that tell
constexpr double probe_share = 0x1p-6;              // of the distance between cells: further starts
constexpr double probe_ratio = 0.6180339887498949;  // of the shares along one axis and the next

/// Cells per axis that share a trial of the fixed numbers: about 64 in all.
std::uint64_t block_edge(std::size_t n_axes) {
    constexpr std::uint64_t edges[] = {1, 64, 8, 4, 3};
    return n_axes < std::size(edges) ? edges[n_axes] : 2;
}

using cell_list = std::vector<std::uint64_t>;

/// Answers of cells by index in the map, rising: those given and those computed beside them.
struct known_cells {
    explicit known_cells(std::uint64_t n) : found(n) {}

    cell_list cells;
    answers found;
};

/// The i-th neighbour of a cell along an axis, or none at the edge.
std::optional<std::uint64_t> neighbour(const scene& scene, std::uint64_t cell, std::size_t axis,
                                       std::uint64_t stride, int side) {
    const std::uint64_t along = scene.axes[axis].cells;
    const std::uint64_t position = cell / stride % along;
    if (side < 0) return position == 0 ? std::nullopt : std::optional(cell - stride);
    return position + 1 == along ? std::nullopt : std::optional(cell + stride);
}

/// How far apart in the index neighbours along each axis are.
cell_list strides_of(const scene& scene) {
    cell_list strides(scene.axes.size());
    std::uint64_t stride = 1;
    for (std::size_t axis = strides.size(); axis-- > 0;) {
        strides[axis] = stride;
        stride *= scene.axes[axis].cells;
    }
    return strides;
}

/// The cell at which a cell's block tries the fixed numbers.
std::uint64_t trial_of(const scene& scene, const cell_list& strides, std::uint64_t cell) {
    const std::uint64_t edge = block_edge(strides.size());
    std::uint64_t trial = 0;
    for (std::size_t axis = 0; axis < strides.size(); ++axis) {
        const std::uint64_t position = cell / strides[axis] % scene.axes[axis].cells;
        trial += position / edge * edge * strides[axis];
    }
    return trial;
}

void make_a_set(cell_list& cells) {
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
}

/// Calls `visit(i, place)` for every cell that has a neighbour on that side, with the neighbour's
/// place among `known` (which may be its size: not there). Both lists rise, so one pass does.
template <class Visit>
void with_neighbours(const scene& scene, std::span<const std::uint64_t> cells,
                     std::span<const std::uint64_t> known, std::size_t axis, std::uint64_t stride,
                     int side, Visit visit) {
    std::size_t at = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto wanted = neighbour(scene, cells[i], axis, stride, side);
        if (!wanted) continue;
        while (at < known.size() && known[at] < *wanted) ++at;
        const bool is_there = at < known.size() && known[at] == *wanted;
        visit(i, is_there ? at : known.size(), *wanted);
    }
}

/// The cells, all their neighbours and the trial cells of their blocks, with their answers.
known_cells with_surroundings(const scene& scene, const label_plan& plan, const kernel_run& run,
                              std::span<const std::uint64_t> cells, const cell_list& trials,
                              const answer_view& found) {
    const cell_list strides = strides_of(scene);
    cell_list more;
    for (std::size_t axis = 0; axis < strides.size(); ++axis) {
        for (const int side : {-1, 1}) {
            with_neighbours(scene, cells, cells, axis, strides[axis], side,
                            [&](std::size_t, std::size_t place, std::uint64_t wanted) {
                                if (place == cells.size()) more.push_back(wanted);
                            });
        }
    }
    std::set_difference(trials.begin(), trials.end(), cells.begin(), cells.end(),
                        std::back_inserter(more));
    make_a_set(more);
    answers beside(more.size());
    if (!more.empty()) {
        cell_request request = request_of(scene, plan, more);
        beside.bind(request.request, scene);
        run_labelled(scene, plan, run, request.request);
    }
    known_cells known(cells.size() + more.size());
    ensemble_request none;
    beside.bind(none, scene);
    const answer_view computed(none);
    for (std::size_t i = 0, j = 0; i + j < cells.size() + more.size();) {
        const bool is_given = j == more.size() || (i < cells.size() && cells[i] < more[j]);
        known.found.take(known.cells.size(), is_given ? found : computed, is_given ? i : j);
        known.cells.push_back(is_given ? cells[i++] : more[j++]);
    }
    return known;
}

/// At which trial cells do other fixed numbers give another answer?
std::vector<bool> tried(const scene& scene, const label_plan& plan, const kernel_run& run,
                        const cell_list& trials, const known_cells& known,
                        const answer_view& known_answers, double tolerance) {
    std::vector<bool> changes(trials.size(), false);
    const cell_request at_trials = request_of(scene, plan, trials);
    const auto compare = [&](const answer_view& moved) {
        for (std::size_t i = 0; i < trials.size(); ++i) {
            const auto place = static_cast<std::uint64_t>(
                std::lower_bound(known.cells.begin(), known.cells.end(), trials[i]) -
                known.cells.begin());
            if (has_other_answer(scene, known_answers, place, moved, i) ||
                has_other_events(scene, known_answers, place, moved, i)) {
                changes[i] = true;
            }
        }
    };
    for (const fixed_number& number : movable_numbers(scene, at_trials.request)) {
        for (const double sign : {1.0, -1.0}) {
            answers again(trials.size());
            moved_request moved(scene, at_trials.request, tolerance);
            moved.move_fixed(number, sign);
            again.bind(moved.request(), scene);
            run_labelled(scene, plan, run, moved.request());
            compare(answer_view(moved.request()));
        }
    }
    return changes;
}

bool are_far_apart(const scene_axis& axis, double tolerance) {
    const auto is_far = [&](double x) {
        return spacing_at(axis, x) > least_spacing * displacement_on(axis, x, tolerance);
    };
    return is_far(axis.lowest) && is_far(axis.highest);
}

/// Which of some cells (by place among `cells`) differ from a start between them and a neighbour?
cell_list unlike_probes(const scene& scene, const label_plan& plan, const kernel_run& run,
                        std::span<const std::uint64_t> cells, const answer_view& found,
                        const cell_list& places) {
    cell_list probed;
    for (const std::uint64_t place : places) probed.push_back(cells[place]);
    const cell_request at_cells = request_of(scene, plan, probed);
    std::vector<bool> differs(places.size(), false);
    for (const double side : {probe_share, -probe_share}) {
        answers again(places.size());
        moved_request moved(scene, at_cells.request, 0.0);
        double share = side;
        for (const scene_axis& axis : scene.axes) {
            moved.move_between_cells(axis, share);
            share *= probe_ratio;
        }
        again.bind(moved.request(), scene);
        run_labelled(scene, plan, run, moved.request());
        const answer_view probes(moved.request());
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (has_other_answer(scene, found, places[i], probes, i) ||
                has_other_events(scene, found, places[i], probes, i)) {
                differs[i] = true;
            }
        }
    }
    cell_list unlike;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (differs[i]) unlike.push_back(places[i]);
    }
    return unlike;
}

/// Which cells (by place) differ from a neighbour, or lack one?
cell_list unlike_neighbours(const scene& scene, std::span<const std::uint64_t> cells,
                            const answer_view& found, const known_cells& known,
                            const answer_view& all) {
    const cell_list strides = strides_of(scene);
    std::vector<int> n_alike(cells.size(), 0);
    for (std::size_t axis = 0; axis < strides.size(); ++axis) {
        for (const int side : {-1, 1}) {
            with_neighbours(scene, cells, known.cells, axis, strides[axis], side,
                            [&](std::size_t i, std::size_t place, std::uint64_t) {
                                const bool is_alike =
                                    !has_other_answer(scene, found, i, all, place) &&
                                    !has_other_events(scene, found, i, all, place);
                                n_alike[i] += is_alike ? 1 : 0;
                            });
        }
    }
    cell_list unlike;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (n_alike[i] < 2 * static_cast<int>(strides.size())) unlike.push_back(i);
    }
    return unlike;
}

}  // namespace

bool do_neighbours_tell(const scene& scene, double tolerance) {
    if (scene.refine > 0 || is_chaos_map(scene)) return false;
    return std::all_of(scene.axes.begin(), scene.axes.end(),
                       [&](const scene_axis& axis) { return are_far_apart(axis, tolerance); });
}

std::vector<std::uint64_t> doubtful_among(const scene& scene, const label_plan& plan,
                                          const kernel_run& run,
                                          std::span<const std::uint64_t> cells,
                                          const answer_view& found, double tolerance) {
    const cell_list strides = strides_of(scene);
    cell_list trial_of_cell;
    trial_of_cell.reserve(cells.size());
    for (const std::uint64_t cell : cells) trial_of_cell.push_back(trial_of(scene, strides, cell));
    cell_list trials = trial_of_cell;
    make_a_set(trials);

    known_cells known = with_surroundings(scene, plan, run, cells, trials, found);
    ensemble_request holder;
    known.found.bind(holder, scene);
    const answer_view all(holder);

    cell_list doubtful = unlike_neighbours(scene, cells, found, known, all);
    if (!doubtful.empty()) {
        doubtful = unlike_probes(scene, plan, run, cells, found, doubtful);
    }
    const std::vector<bool> changes = tried(scene, plan, run, trials, known, all, tolerance);
    if (std::find(changes.begin(), changes.end(), true) == changes.end()) return doubtful;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto trial = static_cast<std::size_t>(
            std::lower_bound(trials.begin(), trials.end(), trial_of_cell[i]) - trials.begin());
        if (changes[trial]) doubtful.push_back(i);
    }
    make_a_set(doubtful);
    return doubtful;
}

}  // namespace hopscotch
