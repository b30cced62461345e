// Which tiles' classes are kept, and which of two versions of one.
#include "host/refine/class_cache.hpp"

#include "host/map/rows.hpp"

namespace hopscotch::refine {
namespace {

/// Tiles whose classes are kept in memory: 256 x 256 cells take 0.6 MB.
constexpr std::size_t most_kept_tiles = 128;

}  // namespace

class_cache::shared_classes class_cache::find(std::uint64_t tile) {
    const std::lock_guard guard(mutex_);
    const auto known = kept_.find(tile);
    return known == kept_.end() ? nullptr : known->second;
}

class_cache::shared_classes class_cache::keep(std::uint64_t tile, const shared_classes& classes,
                                              bool is_computed) {
    const std::lock_guard guard(mutex_);
    const auto [place, is_new] = kept_.try_emplace(tile, classes);
    if (is_new) order_.push_back(tile);
    if (is_computed) place->second = classes;
    const shared_classes result = place->second;
    while (kept_.size() > most_kept_tiles) {
        kept_.erase(order_.front());
        order_.pop_front();
        has_lost_some_ = true;
    }
    return result;
}

class_cache::shared_classes class_cache::classes(std::uint64_t tile) {
    if (shared_classes known = find(tile)) return known;
    const auto read = std::make_shared<const tile_classes>(classes_of(job_, run_.read(tile)));
    return keep(tile, read, false);
}

tiles_around class_cache::around(const tile_box& box) {
    const coordinates along = job_.layout.tiles_along();
    const tile_box all{0, coordinates(along.size(), 0), along};
    const coordinates at = coordinates_in(all, box.index);
    tiles_around result;
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

void class_cache::put(const tile_data& tile) {
    keep(tile.box.index, std::make_shared<const tile_classes>(classes_of(job_, tile)), true);
}

void class_cache::forget(const std::vector<std::uint64_t>& tiles) {
    const std::lock_guard guard(mutex_);
    if (!has_lost_some_) return;  // every change is known here
    for (const std::uint64_t tile : tiles) {
        if (kept_.erase(tile) > 0) order_.remove(tile);
    }
}

void class_cache::forget_all() {
    const std::lock_guard guard(mutex_);
    kept_.clear();
    order_.clear();
}

}  // namespace hopscotch::refine
