// A set of states known by samples (a chaotic attractor) as the boxes that the samples fill and
// their neighbours. Tells of a state whether it lies on the set, to a box's width.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace hopscotch {

class state_cover {
public:
    state_cover() = default;
    /// \param samples  [sample][column]; columns that hold one value only are not looked at
    state_cover(std::span<const double> samples, int n_columns);

    /// From what the accessors below have told.
    state_cover(std::span<const double> lowest, std::span<const double> highest,
                std::uint64_t boxes_along, std::span<const double> box_places);

    bool holds(std::span<const double> state) const;
    bool is_empty() const { return boxes_.empty(); }

    /// Lower and upper corner of the samples' hull.
    std::span<const double> lowest() const { return lowest_; }
    std::span<const double> highest() const { return highest_; }

    std::uint64_t boxes_along() const { return boxes_along_; }
    std::size_t n_boxes() const { return boxes_.size(); }
    /// Every box by its place along each column, [box][column]; whole numbers from 0, boxes rising.
    std::vector<double> box_places() const;

private:
    std::uint64_t places_along() const;
    std::uint64_t box_of(std::span<const double> state, std::span<const int> shift) const;

    int n_columns_ = 0;
    std::uint64_t boxes_along_ = 1;
    std::vector<double> lowest_;
    std::vector<double> highest_;
    std::vector<std::uint64_t> boxes_;  // rising, without repeats
};

}  // namespace hopscotch
