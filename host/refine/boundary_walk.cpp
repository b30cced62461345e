// Which cells of a tile the boundaries pass.
#include "host/refine/boundary_walk.hpp"

#include <algorithm>
#include <set>

namespace hopscotch::refine {

boundary_walk::boundary_walk(const tile_job& job, const tile_box& box, const tiles_around& around)
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

std::vector<std::uint64_t> boundary_walk::first_steps() const {
    std::vector<std::uint64_t> places;
    for (const std::uint64_t at : cells_) {
        if (!is_known_[at] && is_wanted(at)) places.push_back(place_of_[at]);
    }
    return places;
}

std::vector<std::uint64_t> boundary_walk::next_steps(const tile_data& tile,
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

bool boundary_walk::is_wanted(std::uint64_t at) const {
    if (inherited_.differs_at(at)) return true;
    return std::any_of(inherited_.neighbours.begin(), inherited_.neighbours.end(),
                       [&](std::ptrdiff_t distance) {
                           const std::uint64_t other = at + static_cast<std::uint64_t>(distance);
                           return is_known_[other] && classes_[other] != inherited_.classes[at];
                       });
}

}  // namespace hopscotch::refine
