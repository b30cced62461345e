// Where the numbers of a request lie in a device's memory: its tables, copied once, and the layers
// of one piece of its cells.
#pragma once

#include "kernels/ensemble/request.hpp"

#include <cstddef>
#include <cstdint>

namespace hopscotch {

/// Consecutive cells of a request.
struct cell_piece {
    std::uint64_t first = 0;
    std::uint64_t n = 0;
};

/// The layout of one request; borrows it.
class device_layout {
public:
    explicit device_layout(const ensemble_request& request);

    /// Tables of starts, parameters, points and traps. Of the traps only those of the points that
    /// the request's cells have.
    std::size_t table_bytes() const { return table_bytes_; }
    void put_tables(std::byte* to) const;

    /// Of all layers that are wanted.
    std::size_t layer_bytes(std::uint64_t n_cells) const;
    /// The most cells whose layers fit; 0 where none does.
    std::uint64_t cells_within(std::size_t bytes) const;

    /// The request with pointers into the device's memory.
    ///
    /// \param tables  where the tables lie
    /// \param layers  where the layers of the piece lie. A layer's pointer is where cell 0 of the
    ///                request would be
    ensemble_request on_device(std::byte* tables, std::byte* layers, cell_piece piece) const;

    /// Copies the piece's results to the request's layers.
    void take_layers(const std::byte* layers, cell_piece piece) const;

private:
    const ensemble_request& request_;
    std::uint64_t first_point_ = 0;
    std::uint64_t n_points_ = 1;
    std::size_t table_bytes_ = 0;
};

}  // namespace hopscotch
