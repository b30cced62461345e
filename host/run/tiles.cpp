// Computes one tile.
#include "host/run/tiles.hpp"

#include "host/map/rows.hpp"
#include "host/run/labelled_run.hpp"
#include "host/run/no_ellipsoid.hpp"
#include "host/run/requests.hpp"
#include "host/run/state_rule.hpp"
#include "host/run/surveys.hpp"
#include "host/run/uncertain.hpp"
#include "host/scene/grid.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <span>

namespace hopscotch {
namespace {

template <class Number>
Number* numbers(std::vector<std::byte>& buffer) {
    return reinterpret_cast<Number*>(buffer.data());  // new gives memory aligned for every number
}

/// Points the kernel's result to the layer's buffer. Other layers are no results: they follow from
/// the label, from the start, from further runs, from the refinement, from the orbit watched alone,
/// or from the finished map.
void bind(ensemble_request& request, const layer_plan& layer, std::vector<std::byte>& buffer) {
    switch (layer.role) {
        case layer_role::label:
            request.label = numbers<std::int16_t>(buffer);
            break;
        case layer_role::outcome:
            request.outcome = numbers<std::uint8_t>(buffer);
            break;
        case layer_role::returns:
            request.returns = numbers<std::uint32_t>(buffer);
            break;
        case layer_role::events:
            request.events = numbers<std::uint32_t>(buffer);
            break;
        case layer_role::time:
            request.time = numbers<double>(buffer);
            break;
        case layer_role::state:
            request.state[layer.index] = numbers<double>(buffer);
            break;
        case layer_role::extra:
            request.extras[layer.index] = numbers<double>(buffer);
            break;
        case layer_role::exponent:
            request.exponents.exponents[layer.index] = numbers<double>(buffer);
            break;
        case layer_role::exponent_rate:
            request.exponents.rate = numbers<double>(buffer);
            break;
        case layer_role::exponent_error:
            request.exponents.standard_error = numbers<double>(buffer);
            break;
        case layer_role::exponent_returns:
            request.exponents.returns = numbers<std::uint32_t>(buffer);
            break;
        case layer_role::motion:
            request.exponents.motion = numbers<std::uint8_t>(buffer);
            break;
        case layer_role::period:
        case layer_role::immediate:
        case layer_role::uncertain:
        case layer_role::level:
        case layer_role::clearance:
        case layer_role::hop_height:
        case layer_role::impact_speed:
        case layer_role::finite_exponent:
        case layer_role::failing_distance:
            break;
    }
}

std::int16_t period_of(const label_plan& plan, std::int16_t label) {
    for (const attractor_row& row : plan.attractors) {
        if (row.label == label) return static_cast<std::int16_t>(row.period);
    }
    return 0;
}

void fill_periods(const label_plan& plan, const std::int16_t* label, std::uint64_t n_cells,
                  std::vector<std::byte>& buffer) {
    std::int16_t* period = numbers<std::int16_t>(buffer);
    for (std::uint64_t cell = 0; cell < n_cells; ++cell)
        period[cell] = period_of(plan, label[cell]);
}

/// The attractor in whose immediate one-sided basin each start lies.
void fill_immediate(const label_plan& plan, const ensemble_request& request,
                    std::vector<std::byte>& buffer) {
    std::int16_t* immediate = numbers<std::int16_t>(buffer);
    const auto n = static_cast<std::size_t>(plan.n_immediate);
    for (std::uint64_t cell = 0; cell < request.n_cells; ++cell) {
        const double start = request.columns[0].at(cell);
        const auto point = static_cast<std::size_t>(request.trap_point.at(cell));
        immediate[cell] = 0;
        for (std::size_t i = point * n; i < (point + 1) * n; ++i) {
            const trap_interval& basin = plan.immediate[i];
            if (start < basin.lowest || start > basin.highest) continue;
            immediate[cell] = static_cast<std::int16_t>(basin.label);
        }
    }
}

/// State layers of cells without a state say so: NaN. A return map is blank where a return failed.
void blank_states(const scene& scene, const ensemble_request& request) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (std::uint64_t cell = 0; cell < request.n_cells; ++cell) {
        const auto end = static_cast<outcome>(request.outcome[cell]);
        const bool is_complete = scene.question.kind != "return_map" || end == outcome::ok;
        if (is_complete && has_state(scene.info(), scene.section, end, request.returns[cell]))
            continue;
        for (double* const state : request.state) {
            if (state != nullptr) state[cell] = nan;
        }
    }
}

}  // namespace

namespace {

/// Results asked of the kernel even where no layer shows them.
class unseen_results {
public:
    unseen_results(const tile_job& job, ensemble_request& request) {
        want(request.returns, returns_, request.n_cells);
        const bool is_compared =
            std::any_of(job.layers.begin(), job.layers.end(),
                        [](const auto& layer) { return layer.role == layer_role::uncertain; });
        if (!is_compared || is_chaos_map(job.what)) return;
        want(request.events, events_, request.n_cells);
        states_.resize(job.what.end_section().columns.size());
        for (std::size_t c = 0; c < states_.size(); ++c) {
            want(request.state[c], states_[c], request.n_cells);
        }
    }

private:
    template <class Number>
    static void want(Number*& result, std::vector<Number>& buffer, std::uint64_t n) {
        if (result != nullptr) return;
        buffer.resize(n);
        result = buffer.data();
    }

    std::vector<std::uint32_t> returns_;
    std::vector<std::uint32_t> events_;
    std::vector<std::vector<double>> states_;
};

using layer_buffers = std::vector<std::vector<std::byte>>;

/// All layers of the cells of one request, in its order; `cells` are their indices in the map.
layer_buffers compute_layers(const tile_job& job, const label_plan& plan,
                             std::span<const std::uint64_t> cells, ensemble_request& request,
                             lane_statistics& lanes) {
    const std::uint64_t n_cells = request.n_cells;
    layer_buffers buffers;
    for (const layer_plan& layer : job.layers) {
        bind(request, layer, buffers.emplace_back(n_cells * bytes_of(layer.description.type)));
    }
    unseen_results unseen(job, request);
    const auto run = [&](const ensemble_request& wanted) { return job.kernel.run(wanted); };
    lanes += run_labelled(job.what, plan, run, request);
    blank_states(job.what, request);
    fill_surveys(job.what, request, job.layers, buffers);
    for (std::size_t i = 0; i < job.layers.size(); ++i) {
        if (job.layers[i].role == layer_role::period) {
            fill_periods(plan, request.label, n_cells, buffers[i]);
        } else if (job.layers[i].role == layer_role::immediate) {
            fill_immediate(plan, request, buffers[i]);
        } else if (job.layers[i].role == layer_role::uncertain) {
            const auto flags = job.plan.of_cell ? second_look(job.what, plan, run, request)
                                                : certainty_of(job.what, plan, run, request, cells);
            std::memcpy(buffers[i].data(), flags.data(), flags.size());
        }
    }
    return buffers;
}

/// Cells of one parameter point: their coordinates and places.
struct cell_group {
    std::vector<std::uint64_t> first;   // coordinates of the first one
    std::vector<std::uint64_t> places;  // index among all cells
};

std::vector<cell_group> groups_of(const scene& scene, const label_plan& plan,
                                  const std::vector<std::uint64_t>& cells) {
    std::map<std::uint64_t, cell_group> groups;
    for (std::uint64_t place = 0; place < cells.size(); ++place) {
        const std::vector<std::uint64_t> coordinates = coordinates_of(scene, cells[place]);
        cell_group& group = groups[point_index(scene, plan, coordinates)];
        if (group.places.empty()) group.first = coordinates;
        group.places.push_back(place);
    }
    std::vector<cell_group> result;
    for (auto& [point, group] : groups) result.push_back(std::move(group));
    return result;
}

/// The plans of several points as one: what the first calls its only point is point 0, and so on.
label_plan joined(const label_plan& whole, const std::vector<label_plan>& plans) {
    label_plan result;
    result.decided_by = whole.decided_by;
    result.died_label = whole.died_label;
    result.attractors = whole.attractors;
    for (const label_plan& plan : plans) {
        result.n_ellipsoids = std::max(result.n_ellipsoids, plan.n_ellipsoids);
    }
    for (std::size_t point = 0; point < plans.size(); ++point) {
        const label_plan& plan = plans[point];
        result.ellipsoids.insert(result.ellipsoids.end(), plan.ellipsoids.begin(),
                                 plan.ellipsoids.end());
        result.ellipsoids.resize((point + 1) * static_cast<std::size_t>(result.n_ellipsoids),
                                 no_ellipsoid());
        for (chaotic_set set : plan.chaotic) {
            set.point = point;
            result.chaotic.push_back(std::move(set));
        }
    }
    return result;
}

/// Every parameter point has a plan of its own; the cells of all points are computed together, so
/// that lanes are full.
layer_buffers compute_by_point(const tile_job& job, const std::vector<std::uint64_t>& all,
                               lane_statistics& lanes) {
    std::vector<label_plan> plans;
    std::vector<double> point_of(all.size());
    for (const cell_group& group : groups_of(job.what, job.plan, all)) {
        for (const std::uint64_t place : group.places) {
            point_of[place] = static_cast<double>(plans.size());
        }
        plans.push_back(job.plan.of_cell(group.first));
    }
    const label_plan plan = joined(job.plan, plans);
    cell_request request = request_of(job.what, plan, all);
    request.request.trap_point = {point_of.data(), 1, point_of.size()};
    return compute_layers(job, plan, all, request.request, lanes);
}

/// The cells of a box, in its C order, by index in the map.
std::vector<std::uint64_t> cells_in(const map_layout& layout, const tile_box& box) {
    std::vector<std::uint64_t> shape;
    for (const axis& along : layout.axes) shape.push_back(along.size());
    std::vector<std::uint64_t> cells(box.n_cells());
    const std::uint64_t row = box.extent.back();
    for (std::uint64_t place = 0; place < cells.size(); place += row) {
        const auto begin = cells.begin() + static_cast<std::ptrdiff_t>(place);
        std::iota(begin, begin + static_cast<std::ptrdiff_t>(row),
                  offset_in(shape, coordinates_in(box, place)));
    }
    return cells;
}

}  // namespace

std::vector<std::vector<std::byte>> compute_cells(const tile_job& job,
                                                  const std::vector<std::uint64_t>& cells,
                                                  lane_statistics& lanes) {
    if (job.plan.of_cell) return compute_by_point(job, cells, lanes);
    cell_request request = request_of(job.what, job.plan, cells);
    return compute_layers(job, job.plan, cells, request.request, lanes);
}

tile_result compute_tile(const tile_job& job, const tile_box& box) {
    const auto begin = std::chrono::steady_clock::now();
    tile_result result;
    result.data.box = box;
    result.n_computed = box.n_cells();
    const std::vector<std::uint64_t> cells = cells_in(job.layout, box);
    if (job.plan.of_cell) {
        result.data.layers = compute_by_point(job, cells, result.lanes);
    } else {
        cell_request request = request_of(job.what, job.plan, job.layout, box);
        result.data.layers = compute_layers(job, job.plan, cells, request.request, result.lanes);
    }
    const auto end = std::chrono::steady_clock::now();
    result.seconds = std::chrono::duration<double>(end - begin).count();
    return result;
}

}  // namespace hopscotch
