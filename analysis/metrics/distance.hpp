// Exact Euclidean distances from every cell of a map to the nearest marked cell, on axes with any
// spacing, given out slab by slab: no array of distances is ever held.
#pragma once

#include "analysis/metrics/class_grid.hpp"

#include <functional>
#include <span>

namespace hopscotch::metrics {

/// The distance transform of one set of cells. A slab is all cells with one index along the first
/// axis; along that axis the nearest marked cell is stored (4 bytes per cell), along the others the
/// lower envelope of parabolas is built when a slab is asked for.
/// Source: Felzenszwalb, Huttenlocher, Theory of Computing 8, 415 (2012), with uneven spacing.
class distance_transform {
public:
    /// Says for every cell of slab i whether it is marked (1) or not (0); called once per slab, by
    /// several threads.
    using marking = std::function<void(std::uint64_t i, std::span<std::uint8_t> marks)>;

    distance_transform(const class_grid& grid, length_unit unit, const marking& marked);

    std::uint64_t n_slabs() const { return along_first_.size(); }
    std::uint64_t slab_size() const { return slab_size_; }

    /// Squared distances of one slab's cells, infinite where no cell at all is marked. Threads may
    /// ask for different slabs at the same time.
    void squared(std::uint64_t i, std::span<double> result) const;

private:
    void sweep(std::uint64_t begin, std::uint64_t end);

    std::vector<double> along_first_;         // positions along the first axis
    std::vector<std::vector<double>> along_;  // and along the others
    std::uint64_t slab_size_ = 1;
    std::vector<std::uint32_t> nearest_;  // index along the first axis; none where there is none
};

}  // namespace hopscotch::metrics
