// Settles orbits and records their returns, tile by tile.
#include "host/run/orbit_diagram.hpp"

#include "host/run/orbit_batch.hpp"
#include "host/run/requests.hpp"
#include "host/scene/grid.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>

namespace hopscotch {
namespace {

using clock_type = std::chrono::steady_clock;

double seconds_since(clock_type::time_point begin) {
    return std::chrono::duration<double>(clock_type::now() - begin).count();
}

/// One tile's numbers while they are recorded. States of orbits that have ended stay NaN.
class recorded_tile {
public:
    recorded_tile(const tile_job& job, const tile_box& box) : layers_(job.layers) {
        constexpr double nan = std::numeric_limits<double>::quiet_NaN();
        data_.box = box;
        for (const layer_plan& layer : layers_) {
            const number_type type = layer.description.type;
            auto& values = data_.layers.emplace_back(box.n_cells() * bytes_of(type));
            if (type == number_type::float64) {
                for (std::uint64_t cell = 0; cell < box.n_cells(); ++cell) {
                    std::memcpy(values.data() + cell * sizeof nan, &nan, sizeof nan);
                }
            }
        }
    }

    /// Where the i-th orbit of the batch is, `place` counted over the tile's points and orbits.
    void record(const orbit_batch& batch, std::size_t i, std::uint64_t place,
                std::uint64_t sample) {
        const std::uint64_t cell = place * data_.box.extent[sample_axis] + sample;
        for (std::size_t layer = 0; layer < layers_.size(); ++layer) {
            std::byte* const values = data_.layers[layer].data();
            if (layers_[layer].role == layer_role::outcome) {
                values[cell] = static_cast<std::byte>(batch.end(i));
            } else if (batch.goes_on(i)) {
                const double value = batch.state(static_cast<std::size_t>(layers_[layer].index), i);
                std::memcpy(values + cell * sizeof value, &value, sizeof value);
            }
        }
    }

    tile_result result(const lane_statistics& lanes, double seconds) && {
        const std::uint64_t n_cells = data_.box.n_cells();
        return {std::move(data_), lanes, seconds, n_cells};
    }

private:
    const std::vector<layer_plan>& layers_;
    tile_data data_;
};

/// Coordinates along the scene's own axes of a start, `start` counted in C order over the axes
/// after the first.
std::vector<std::uint64_t> coordinates_of_start(const scene& scene, std::uint64_t point,
                                                std::uint64_t start) {
    const std::uint64_t n_starts = scene.n_cells() / scene.axes[0].cells;
    return coordinates_of(scene, point * n_starts + start);
}

/// Past the transient, then return by return; `record` is told each time how many it has seen.
template <class Record>
void follow(const scene& scene, orbit_batch& batch, Record&& record) {
    const auto transient = static_cast<std::uint32_t>(scene.question.number("transient"));
    if (transient > 0) batch.advance(transient);
    for (std::uint64_t sample = 0; sample < scene.question.returns; ++sample) {
        batch.advance(1);
        record(sample);
    }
}

}  // namespace

orbit_diagram::orbit_diagram(const tile_job& job, const map_run& run, const stop_condition& stop,
                             const shard& part, std::string_view backend,
                             std::vector<std::uint64_t> missing)
    : job_(job),
      run_(run),
      stop_(stop),
      one_orbit_(kernel_of(job.what, backend == "auto" ? "scalar" : backend)),
      missing_(std::move(missing)) {
    const std::size_t n_columns = job.what.end_section().columns.size();
    for (std::size_t column = 0; column < n_columns; ++column) {
        for (std::size_t i = 0; i < job.layers.size(); ++i) {
            const layer_plan& layer = job.layers[i];
            const bool holds_it =
                layer.role == layer_role::state && layer.index == static_cast<int>(column);
            if (holds_it) state_layers_.push_back(i);
        }
    }
    if (state_layers_.size() != n_columns) state_layers_.clear();
    if (has_sweeps(job.what)) {
        add_sweep(rising_orbit, part);
        add_sweep(falling_orbit, part);
    }
    add_starts();
}

bool orbit_diagram::is_missing(std::uint64_t tile) const {
    return std::binary_search(missing_.begin(), missing_.end(), tile);
}

/// All tiles of a sweep in the order of its passage.
std::vector<std::uint64_t> orbit_diagram::sweep_tiles(std::uint64_t orbit) const {
    const std::vector<std::uint64_t> along = job_.layout.tiles_along();
    std::vector<std::uint64_t> tiles;
    for (std::uint64_t i = 0; i < along[0]; ++i) tiles.push_back(i * along[orbit_axis] + orbit);
    if (orbit == falling_orbit) std::reverse(tiles.begin(), tiles.end());
    return tiles;
}

void orbit_diagram::add_sweep(std::uint64_t orbit, const shard& part) {
    const std::vector<std::uint64_t> tiles = sweep_tiles(orbit);
    const auto missing = [&](std::uint64_t tile) { return is_missing(tile); };
    const auto first = std::find_if(tiles.begin(), tiles.end(), missing);
    if (first == tiles.end()) return;
    const auto last = std::find_if(tiles.rbegin(), tiles.rend(), missing).base();
    auto begin = first;
    const auto is_there = [&](std::uint64_t tile) {
        return !state_layers_.empty() && part.owns(tile);
    };
    while (begin != tiles.begin() && !is_there(*(begin - 1))) --begin;
    heads_.push_back(*first);
    pieces_[*first] = {begin, last};
}

void orbit_diagram::add_starts() {
    const std::uint64_t n_along = job_.layout.tiles_along()[orbit_axis];
    const std::uint64_t n_sweeps = has_sweeps(job_.what) ? first_start : 0;
    const std::vector<std::uint64_t> full = full_tile(job_.layout);
    const std::uint64_t most = std::max<std::uint64_t>(orbits_at_once / (full[0] * full[1]), 1);
    std::vector<std::uint64_t>* piece = nullptr;
    for (const std::uint64_t tile : missing_) {
        if (tile % n_along < n_sweeps) continue;
        const bool is_full =
            piece == nullptr || piece->size() == most || piece->front() / n_along != tile / n_along;
        if (is_full) {
            heads_.push_back(tile);
            piece = &pieces_[tile];
        }
        piece->push_back(tile);
    }
}

void orbit_diagram::compute(const tile_box& head, const tile_sink& store) {
    const std::vector<std::uint64_t>& tiles = pieces_.at(head.index);
    const bool is_sweep = has_sweeps(job_.what) && head.origin[orbit_axis] < first_start;
    is_sweep ? compute_sweep(tiles, store) : compute_starts(tiles, store);
}

void orbit_diagram::compute_starts(const std::vector<std::uint64_t>& tiles,
                                   const tile_sink& store) const {
    const auto begin = clock_type::now();
    const std::uint64_t n_sweeps = has_sweeps(job_.what) ? first_start : 0;
    orbit_batch batch(job_.what, job_.kernel, job_.what.section);
    std::vector<recorded_tile> records;
    std::vector<std::pair<std::size_t, std::uint64_t>> places;  // tile, place in it
    for (const std::uint64_t tile : tiles) {
        const tile_box box = box_of(job_.layout, tile);
        records.emplace_back(job_, box);
        const std::uint64_t n_places = box.extent[0] * box.extent[orbit_axis];
        for (std::uint64_t place = 0; place < n_places; ++place) {
            const std::uint64_t point = box.origin[0] + place / box.extent[orbit_axis];
            const std::uint64_t orbit = box.origin[orbit_axis] + place % box.extent[orbit_axis];
            batch.add(
                start_of(job_.what, coordinates_of_start(job_.what, point, orbit - n_sweeps)));
            places.emplace_back(records.size() - 1, place);
        }
    }
    follow(job_.what, batch, [&](std::uint64_t sample) {
        for (std::size_t i = 0; i < places.size(); ++i) {
            records[places[i].first].record(batch, i, places[i].second, sample);
        }
    });
    const double seconds = seconds_since(begin) / static_cast<double>(tiles.size());
    lane_statistics lanes = batch.lanes();
    for (recorded_tile& record : records) {
        store(std::move(record).result(lanes, seconds));
        lanes = {};  // told with the first tile
    }
}

void orbit_diagram::compute_sweep(const std::vector<std::uint64_t>& tiles, const tile_sink& store) {
    state carried = state_before(tiles);
    for (const std::uint64_t tile : tiles) {
        tile_result result = sweep_through(box_of(job_.layout, tile), carried);
        const double seconds = result.seconds;
        if (is_missing(tile)) store(std::move(result));
        if (stop_.is_due(seconds)) return;
    }
}

/// The state that a sweep comes to these tiles with.
orbit_diagram::state orbit_diagram::state_before(const std::vector<std::uint64_t>& tiles) const {
    const tile_box box = box_of(job_.layout, tiles.front());
    const std::uint64_t orbit = box.origin[orbit_axis];
    const std::vector<std::uint64_t> all = sweep_tiles(orbit);
    const auto here = std::find(all.begin(), all.end(), tiles.front());
    if (here == all.begin()) return {};
    const tile_data before = run_.read(*(here - 1));
    const std::uint64_t point = orbit == rising_orbit ? before.box.extent[0] - 1 : 0;
    const std::uint64_t n_samples = before.box.extent[sample_axis];
    const std::uint64_t cell = (point + 1) * n_samples - 1;
    state result;
    for (const std::size_t layer : state_layers_) {
        double value = 0.0;
        std::memcpy(&value, before.layers[layer].data() + cell * sizeof value, sizeof value);
        if (std::isnan(value)) return {};  // the orbit has ended there
        result.push_back(value);
    }
    return result;
}

/// Along the first axis; every orbit starts where the one before it ended, the first one and those
/// after an orbit that ended start at the grid's first start.
tile_result orbit_diagram::sweep_through(const tile_box& box, state& carried) {
    const auto begin = clock_type::now();
    const scene& scene = job_.what;
    const bool is_rising = box.origin[orbit_axis] == rising_orbit;
    recorded_tile record(job_, box);
    lane_statistics lanes;
    for (std::uint64_t i = 0; i < box.extent[0]; ++i) {
        const std::uint64_t place = is_rising ? i : box.extent[0] - 1 - i;
        cell_start start = start_of(scene, coordinates_of_start(scene, box.origin[0] + place, 0));
        const bool is_carried = !carried.empty();
        if (is_carried) {
            // an axis that is a state column (a conserved one) keeps its own value
            const scene_axis& axis = scene.axes[0];
            const auto index = static_cast<std::size_t>(axis.index);
            if (axis.kind == axis_kind::column) carried[index] = start.columns[index];
            start.columns = carried;
        }
        orbit_batch batch(scene, one_orbit_,
                          is_carried ? scene.start_section().returns_to : scene.section);
        batch.add(start);
        follow(scene, batch, [&](std::uint64_t sample) { record.record(batch, 0, place, sample); });
        lanes += batch.lanes();
        carried.clear();
        if (!batch.goes_on(0)) continue;
        for (std::size_t c = 0; c < scene.end_section().columns.size(); ++c) {
            carried.push_back(batch.state(c, 0));
        }
    }
    return std::move(record).result(lanes, seconds_since(begin));
}

}  // namespace hopscotch
