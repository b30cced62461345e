// Rounds of boundary refinement.
#include "host/run/refinement.hpp"

#include "host/map/numbers.hpp"
#include "host/map/rows.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <set>

namespace hopscotch {
namespace {

using coordinates = std::vector<std::uint64_t>;

/// Tiles whose classes are kept in memory: 256 x 256 cells take 0.6 MB.
constexpr std::size_t most_kept_tiles = 128;

std::size_t level_index(const tile_job& job) {
    std::size_t index = 0;
    while (job.layers[index].role != layer_role::level) ++index;  // always stored
    return index;
}

/// Layers that tell classes apart and that inherited cells have.
bool is_class(const layer_plan& layer) {
    const number_type type = layer.description.type;
    const bool is_small = type == number_type::int16 || type == number_type::uint8;
    return is_small && layer.role != layer_role::level && layer.role != layer_role::uncertain;
}

/// Cells along a side of the blocks in which a round has left the map.
std::uint64_t block_after(int round, int levels) {
    return round >= levels ? 1 : std::uint64_t{1} << (levels - round);
}

std::uint64_t ceiling(std::uint64_t n, std::uint64_t size) { return (n + size - 1) / size; }

/// Calls visit(offset) for every corner of {0, 1}^n, or with `is_signed` for {-1, 0, 1}^n.
template <class Visit>
void for_each_offset(std::size_t n, int lowest, Visit&& visit) {
    std::vector<int> offset(n, lowest);
    while (true) {
        visit(offset);
        std::size_t digit = n;
        while (digit > 0 && offset[digit - 1] == 1) offset[--digit] = lowest;
        if (digit == 0) return;
        ++offset[digit - 1];
    }
}

constexpr std::size_t most_axes = 8;  // a scene has no more
using cell_index = std::array<std::uint64_t, most_axes>;

/// Calls visit(position, k) for every position in a box of that extent, in C order.
template <class Visit>
void for_each_position(const coordinates& extent, Visit&& visit) {
    std::uint64_t n = 1;
    for (const std::uint64_t each : extent) n *= each;
    cell_index position{};
    for (std::uint64_t k = 0; k < n; ++k) {
        visit(position, k);
        for (std::size_t i = extent.size(); i-- > 0;) {
            if (++position[i] < extent[i]) break;
            position[i] = 0;
        }
    }
}

/// The classes of one tile: a number per cell for all class layers, and the levels. Positions count
/// from the tile's origin, which is a multiple of the coarsest block.
struct tile_classes {
    tile_box box;
    std::vector<std::uint64_t> classes;
    std::vector<std::uint8_t> levels;
    bool is_uniform = false;

    std::uint64_t offset_of(const cell_index& position) const {
        std::uint64_t offset = 0;
        for (std::size_t i = 0; i < box.extent.size(); ++i) {
            offset = offset * box.extent[i] + position[i];
        }
        return offset;
    }

    /// The cell whose block a cell lies in after a round: itself, or the nearest one computed.
    std::uint64_t owner_of(cell_index position, int round) const {
        for (std::uint64_t size = 2;; size *= 2) {
            const std::uint64_t offset = offset_of(position);
            if (levels[offset] <= round) return offset;
            // round 0 has computed the last of these
            for (std::size_t i = 0; i < box.extent.size(); ++i) position[i] &= ~(size - 1);
        }
    }
};

/// One number for all class layers of a cell: at most 64 bits of them.
std::uint64_t class_at(const tile_job& job, const tile_data& tile, std::uint64_t cell) {
    std::uint64_t result = 0;
    for (std::size_t i = 0; i < job.layers.size(); ++i) {
        if (!is_class(job.layers[i])) continue;
        const number_type type = job.layers[i].description.type;
        const unsigned bits = 8 * static_cast<unsigned>(bytes_of(type));
        const auto value = static_cast<std::int64_t>(number_at(type, tile.layers[i].data(), cell));
        result = result << bits | (static_cast<std::uint64_t>(value) & ((1U << bits) - 1));
    }
    return result;
}

tile_classes classes_of(const tile_job& job, const tile_data& tile) {
    tile_classes result{tile.box, std::vector<std::uint64_t>(tile.box.n_cells(), 0), {}, false};
    for (std::uint64_t cell = 0; cell < result.classes.size(); ++cell) {
        result.classes[cell] = class_at(job, tile, cell);
    }
    const auto* levels =
        reinterpret_cast<const std::uint8_t*>(tile.layers[level_index(job)].data());
    result.levels.assign(levels, levels + tile.box.n_cells());
    result.is_uniform = std::adjacent_find(result.classes.begin(), result.classes.end(),
                                           std::not_equal_to<>()) == result.classes.end();
    return result;
}

/// Gives every inherited cell the classes of the cell whose block it lies in, and no numbers.
void inherit(const tile_job& job, tile_data& tile) {
    const tile_classes known = classes_of(job, tile);
    std::vector<std::uint64_t> owners(tile.box.n_cells());
    for_each_position(tile.box.extent, [&](const cell_index& position, std::uint64_t cell) {
        const bool is_known = known.levels[cell] != inherited_level;
        owners[cell] = is_known ? cell : known.owner_of(position, job.what.refine);
    });
    for (std::size_t i = 0; i < job.layers.size(); ++i) {
        if (job.layers[i].role == layer_role::level) continue;
        const layer& each = job.layers[i].description;
        const std::size_t size = bytes_of(each.type);
        std::byte* const values = tile.layers[i].data();
        for (std::uint64_t cell = 0; cell < owners.size(); ++cell) {
            if (owners[cell] == cell) continue;
            if (is_class(job.layers[i])) {
                std::memcpy(values + cell * size, values + owners[cell] * size, size);
            } else {
                fill_numbers(each.type, values, cell, 1, each.fill);
            }
        }
    }
}

/// Computes cells of a tile (by place in it) for a round; what others inherit is not yet set.
void compute_places(const tile_job& job, tile_data& tile, const std::vector<std::uint64_t>& places,
                    int round, lane_statistics& lanes) {
    coordinates shape;
    for (const axis& along : job.layout.axes) shape.push_back(along.size());
    std::vector<std::uint64_t> cells;
    for (const std::uint64_t place : places) {
        cells.push_back(offset_in(shape, coordinates_in(tile.box, place)));
    }
    const std::vector<std::vector<std::byte>> found = compute_cells(job, cells, lanes);
    for (std::size_t i = 0; i < job.layers.size(); ++i) {
        const std::size_t size = bytes_of(job.layers[i].description.type);
        const bool is_level = job.layers[i].role == layer_role::level;
        for (std::size_t k = 0; k < places.size(); ++k) {
            std::byte* const value = tile.layers[i].data() + places[k] * size;
            if (is_level) {
                *value = static_cast<std::byte>(round);
            } else {
                std::memcpy(value, found[i].data() + k * size, size);
            }
        }
    }
}

using clock_type = std::chrono::steady_clock;

tile_result finished(const tile_job& job, tile_data tile, std::uint64_t n_computed,
                     const lane_statistics& lanes, clock_type::time_point begin) {
    inherit(job, tile);
    tile_result result;
    result.data = std::move(tile);
    result.lanes = lanes;
    result.n_computed = n_computed;
    result.seconds = std::chrono::duration<double>(clock_type::now() - begin).count();
    return result;
}

}  // namespace

std::uint64_t coarse_cells_in(const tile_box& box, int levels) {
    std::uint64_t cells = 1;
    for (const std::uint64_t extent : box.extent) cells *= ceiling(extent, block_after(0, levels));
    return cells;
}

tile_result compute_coarse(const tile_job& job, const tile_box& box) {
    const auto begin = clock_type::now();
    lane_statistics lanes;
    const std::uint64_t size = block_after(0, job.what.refine);
    tile_data tile{box, {}};
    for (const layer_plan& layer : job.layers) {
        auto& values = tile.layers.emplace_back(box.n_cells() * bytes_of(layer.description.type));
        if (layer.role == layer_role::level) {
            std::fill(values.begin(), values.end(), static_cast<std::byte>(inherited_level));
        }
    }
    std::vector<std::uint64_t> places;
    for_each_position(box.extent, [&](const cell_index& position, std::uint64_t place) {
        if (std::all_of(position.begin(), position.end(), [&](auto x) { return x % size == 0; })) {
            places.push_back(place);
        }
    });
    compute_places(job, tile, places, 0, lanes);
    return finished(job, std::move(tile), places.size(), lanes, begin);
}

struct refinement::implementation {
    using shared_classes = std::shared_ptr<const tile_classes>;

    shared_classes classes(std::uint64_t tile);
    shared_classes find(std::uint64_t tile);
    /// What is read never replaces what was computed meanwhile. Returns what is kept.
    shared_classes keep(std::uint64_t tile, const shared_classes& classes, bool is_computed);
    std::vector<shared_classes> around(const tile_box& box);

    const tile_job& job;
    const map_run& run;
    std::mutex mutex;
    std::map<std::uint64_t, shared_classes> kept;
    std::list<std::uint64_t> order;  // the tile read first is the first to go
    bool has_lost_some = false;      // so that tiles were read from their files again
};

refinement::implementation::shared_classes refinement::implementation::find(std::uint64_t tile) {
    const std::lock_guard guard(mutex);
    const auto known = kept.find(tile);
    return known == kept.end() ? nullptr : known->second;
}

refinement::implementation::shared_classes refinement::implementation::keep(
    std::uint64_t tile, const shared_classes& classes, bool is_computed) {
    const std::lock_guard guard(mutex);
    const auto [place, is_new] = kept.try_emplace(tile, classes);
    if (is_new) order.push_back(tile);
    if (is_computed) place->second = classes;
    const shared_classes result = place->second;
    while (kept.size() > most_kept_tiles) {
        kept.erase(order.front());
        order.pop_front();
        has_lost_some = true;
    }
    return result;
}

refinement::implementation::shared_classes refinement::implementation::classes(std::uint64_t tile) {
    if (shared_classes known = find(tile)) return known;
    const auto read = std::make_shared<const tile_classes>(classes_of(job, run.read(tile)));
    return keep(tile, read, false);
}

/// A tile and its neighbours, by 0, 1, 2 along each axis; null beyond the map.
std::vector<refinement::implementation::shared_classes> refinement::implementation::around(
    const tile_box& box) {
    const coordinates along = job.layout.tiles_along();
    const tile_box all{0, coordinates(along.size(), 0), along};
    const coordinates at = coordinates_in(all, box.index);
    std::vector<shared_classes> result;
    for_each_offset(at.size(), -1, [&](const std::vector<int>& offset) {
        std::uint64_t tile = 0;
        bool is_inside = true;
        for (std::size_t i = 0; i < at.size(); ++i) {
            const std::uint64_t x = at[i] + static_cast<std::uint64_t>(offset[i]);  // wraps
            is_inside = is_inside && x < along[i];
            tile = tile * along[i] + x;
        }
        result.push_back(is_inside ? classes(tile) : nullptr);
    });
    return result;
}

refinement::refinement(const tile_job& job, const map_run& run)
    : self_(new implementation{job, run, {}, {}, {}, false}) {}

refinement::~refinement() = default;

void refinement::forget(const std::vector<std::uint64_t>& tiles) {
    const std::lock_guard guard(self_->mutex);
    if (!self_->has_lost_some) return;  // every change is known here
    for (const std::uint64_t tile : tiles) {
        if (self_->kept.erase(tile) > 0) self_->order.remove(tile);
    }
}

void refinement::forget_all() {
    const std::lock_guard guard(self_->mutex);
    self_->kept.clear();
    self_->order.clear();
}

namespace {

/// The blocks of a tile as a round has left them, and one more on every side. Beyond the map lies
/// what lies at its edge.
struct block_view {
    std::uint64_t size = 1;  // cells along a side of a block
    coordinates blocks;      // of the tile, along each axis
    coordinates extent;      // with those around
    std::vector<std::uint64_t> classes;
    std::vector<std::ptrdiff_t> neighbours;  // distances in `classes`

    /// Where a block of the tile lies in `classes`.
    std::uint64_t at(const cell_index& block) const {
        std::uint64_t offset = 0;
        for (std::size_t i = 0; i < extent.size(); ++i) offset = offset * extent[i] + block[i] + 1;
        return offset;
    }

    bool differs_at(std::uint64_t block) const {
        const std::uint64_t* const own = classes.data() + block;
        return std::any_of(neighbours.begin(), neighbours.end(),
                           [own](std::ptrdiff_t distance) { return own[distance] != *own; });
    }
};

block_view empty_view(const tile_box& box, std::uint64_t size) {
    block_view view;
    view.size = size;
    std::uint64_t n = 1;
    for (const std::uint64_t cells : box.extent) {
        view.blocks.push_back(ceiling(cells, size));
        view.extent.push_back(view.blocks.back() + 2);
        n *= view.extent.back();
    }
    view.classes.resize(n);
    for_each_offset(view.extent.size(), -1, [&](const std::vector<int>& offset) {
        std::ptrdiff_t distance = 0;
        for (std::size_t i = 0; i < offset.size(); ++i) {
            distance = distance * static_cast<std::ptrdiff_t>(view.extent[i]) + offset[i];
        }
        if (distance != 0) view.neighbours.push_back(distance);
    });
    return view;
}

/// Where the blocks of a view lie along one axis: tile before, this one or after (0, 1, 2), and the
/// place of the block's first cell in it.
struct place_along {
    std::uint64_t tile;
    std::uint64_t position;
};

std::vector<place_along> places_along(const map_layout& layout, const tile_box& box,
                                      const block_view& view, std::size_t axis) {
    const std::uint64_t tile = full_tile(layout)[axis];
    const std::uint64_t own = box.origin[axis] / tile;
    const std::uint64_t first = box.origin[axis] / view.size;
    const std::uint64_t last = ceiling(layout.axes[axis].size(), view.size) - 1;
    std::vector<place_along> places;
    for (std::uint64_t k = 0; k < view.extent[axis]; ++k) {
        const std::uint64_t block = std::min(first + k == 0 ? 0 : first + k - 1, last);
        const std::uint64_t cell = block * view.size;
        places.push_back({cell / tile + 1 - own, cell % tile});
    }
    return places;
}

using tiles_around = std::vector<std::shared_ptr<const tile_classes>>;

const tile_classes& own_tile(const tiles_around& around) { return *around[around.size() / 2]; }

/// Nothing to refine: one class in the tile and all around it.
bool is_uniform(const tiles_around& around) {
    const std::uint64_t own = own_tile(around).classes.front();
    return std::all_of(around.begin(), around.end(), [own](const auto& tile) {
        return tile == nullptr || (tile->is_uniform && tile->classes.front() == own);
    });
}

/// Calls visit(k, tile, position) for every block of a view: where its first cell lies.
template <class Visit>
void for_each_block(const map_layout& layout, const tile_box& box, const block_view& view,
                    const tiles_around& around, Visit&& visit) {
    std::vector<std::vector<place_along>> places;
    for (std::size_t i = 0; i < view.extent.size(); ++i) {
        places.push_back(places_along(layout, box, view, i));
    }
    for_each_position(view.extent, [&](const cell_index& block, std::uint64_t k) {
        std::uint64_t tile = 0;
        cell_index position{};
        for (std::size_t i = 0; i < view.extent.size(); ++i) {
            const place_along& place = places[i][block[i]];
            tile = tile * 3 + place.tile;
            position[i] = place.position;
        }
        visit(k, *around[tile], position);
    });
}

/// Rounds 1 to L: the places in the tile of the parts that blocks on a boundary lack.
std::vector<std::uint64_t> missing_parts(const tile_job& job, const tile_box& box,
                                         const tiles_around& around, int round) {
    const tile_classes& own = own_tile(around);
    block_view view = empty_view(box, block_after(round - 1, job.what.refine));
    for_each_block(job.layout, box, view, around,
                   [&](std::uint64_t k, const tile_classes& tile, const cell_index& position) {
                       view.classes[k] = tile.classes[tile.owner_of(position, round - 1)];
                   });
    const std::uint64_t part = view.size / 2;
    const coordinates parts(box.extent.size(), 2);
    std::vector<std::uint64_t> missing;
    for_each_position(view.blocks, [&](const cell_index& block, std::uint64_t) {
        if (!view.differs_at(view.at(block))) return;
        for_each_position(parts, [&](const cell_index& step, std::uint64_t) {
            cell_index position{};
            for (std::size_t i = 0; i < parts.size(); ++i) {
                position[i] = block[i] * view.size + step[i] * part;
                if (position[i] >= box.extent[i]) return;  // beyond the map
            }
            const std::uint64_t place = own.offset_of(position);
            if (own.levels[place] == inherited_level) missing.push_back(place);
        });
    });
    std::sort(missing.begin(), missing.end());
    return missing;
}

/// The last round within one tile: follows boundaries until they are known or leave it.
class boundary_walk {
public:
    boundary_walk(const tile_job& job, const tile_box& box, const tiles_around& around)
        : job_(job), inherited_(empty_view(box, 1)), classes_(inherited_.classes.size()) {
        is_known_.resize(classes_.size());
        place_of_.resize(classes_.size(), nowhere);
        for_each_block(job.layout, box, inherited_, around,
                       [&](std::uint64_t k, const tile_classes& tile, const cell_index& position) {
                           const std::uint64_t cell = tile.offset_of(position);
                           inherited_.classes[k] =
                               tile.classes[tile.owner_of(position, job.what.refine)];
                           classes_[k] = tile.classes[cell];
                           is_known_[k] = tile.levels[cell] != inherited_level;
                       });
        for_each_position(box.extent, [&](const cell_index& position, std::uint64_t place) {
            const std::uint64_t at = inherited_.at(position);
            place_of_[at] = place;
            cells_.push_back(at);
        });
    }

    /// Cells of the tile that have to be computed, given what is known.
    std::vector<std::uint64_t> first_steps() const {
        std::vector<std::uint64_t> places;
        for (const std::uint64_t at : cells_) {
            if (!is_known_[at] && is_wanted(at)) places.push_back(place_of_[at]);
        }
        return places;
    }

    /// Takes the classes of cells that were computed; returns those that have to be now.
    std::vector<std::uint64_t> next_steps(const tile_data& tile,
                                          const std::vector<std::uint64_t>& places) {
        for (const std::uint64_t place : places) {
            is_known_[cells_[place]] = true;
            classes_[cells_[place]] = class_at(job_, tile, place);
        }
        std::set<std::uint64_t> next;
        for (const std::uint64_t place : places) {
            for (const std::ptrdiff_t distance : inherited_.neighbours) {
                const std::uint64_t at = cells_[place] + static_cast<std::uint64_t>(distance);
                if (place_of_[at] == nowhere || is_known_[at]) continue;
                if (classes_[cells_[place]] != inherited_.classes[at]) next.insert(place_of_[at]);
            }
        }
        return {next.begin(), next.end()};
    }

private:
    static constexpr std::uint64_t nowhere = ~std::uint64_t{0};

    bool is_wanted(std::uint64_t at) const {
        if (inherited_.differs_at(at)) return true;
        return std::any_of(inherited_.neighbours.begin(), inherited_.neighbours.end(),
                           [&](std::ptrdiff_t distance) {
                               const std::uint64_t other =
                                   at + static_cast<std::uint64_t>(distance);
                               return is_known_[other] && classes_[other] != inherited_.classes[at];
                           });
    }

    const tile_job& job_;
    block_view inherited_;                // classes after round L
    std::vector<std::uint64_t> classes_;  // classes as they are known now
    std::vector<bool> is_known_;          // computed
    std::vector<std::uint64_t> place_of_;
    std::vector<std::uint64_t> cells_;  // by place
};

}  // namespace

std::optional<tile_result> refinement::compute(const tile_box& box, int round) {
    const auto begin = clock_type::now();
    const tile_job& job = self_->job;
    const tiles_around around = self_->around(box);
    if (is_uniform(around)) return std::nullopt;
    const bool is_last = round > job.what.refine;
    std::optional<boundary_walk> walk;
    if (is_last) walk.emplace(job, box, around);
    std::vector<std::uint64_t> places =
        is_last ? walk->first_steps() : missing_parts(job, box, around, round);
    if (places.empty()) return std::nullopt;
    tile_data tile = self_->run.read(box.index);
    lane_statistics lanes;
    std::uint64_t n_computed = 0;
    while (!places.empty()) {
        compute_places(job, tile, places, round, lanes);
        n_computed += places.size();
        places = is_last ? walk->next_steps(tile, places) : std::vector<std::uint64_t>();
    }
    tile_result result = finished(job, std::move(tile), n_computed, lanes, begin);
    self_->keep(box.index, std::make_shared<const tile_classes>(classes_of(job, result.data)),
                true);
    return result;
}

std::vector<std::uint64_t> with_neighbours(const map_layout& layout,
                                           const std::vector<std::uint64_t>& tiles) {
    const coordinates along = layout.tiles_along();
    const tile_box all{0, coordinates(along.size(), 0), along};
    std::set<std::uint64_t> result;
    for (const std::uint64_t tile : tiles) {
        const coordinates at = coordinates_in(all, tile);
        for_each_offset(at.size(), -1, [&](const std::vector<int>& offset) {
            coordinates other = at;
            for (std::size_t i = 0; i < other.size(); ++i) {
                if (offset[i] < 0 && other[i] == 0) return;
                other[i] += static_cast<std::uint64_t>(offset[i]);
                if (other[i] >= along[i]) return;
            }
            result.insert(offset_in(along, other));
        });
    }
    return {result.begin(), result.end()};
}

}  // namespace hopscotch
