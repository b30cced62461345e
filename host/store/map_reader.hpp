// Reads a map: a finished file (packed or joined from tile files), or the run directory of an
// unfinished one. Every tile is checked
// against its checksum before its numbers are used; what is missing or damaged reads as the fill
// value
// ("not computed") and is listed, never given as data. Memory: one tile at a time. A reader belongs
// to one thread; several readers may work side by side.
#pragma once

#include "host/map/layout.hpp"
#include "host/map/table_group.hpp"
#include "host/store/compressed_tile.hpp"
#include "host/store/store_error.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hopscotch {

/// A rectangle of cells, every stride-th one along each axis (empty stride: every cell).
struct cell_range {
    std::vector<std::uint64_t> origin;
    std::vector<std::uint64_t> extent;  // in cells of the map, before striding
    std::vector<std::uint64_t> stride{};

    std::vector<std::uint64_t> shape() const;  // number of cells read along each axis
};

class map_reader {
public:
    /// \param path  a map file, a run directory, or a map file's name whose run is unfinished
    explicit map_reader(const std::filesystem::path& path);
    ~map_reader();
    map_reader(map_reader&&) noexcept;
    map_reader& operator=(map_reader&&) noexcept;

    const map_layout& layout() const;
    const attribute_list& attributes() const;
    std::string attribute(std::string_view name) const;  // empty where there is none
    const std::vector<attractor_row>& attractors() const;
    const std::vector<std::string>& point_columns() const;

    /// Tables of the file; none where it has no such group. \error store_error where it is damaged
    std::optional<table_group> group(const std::string& name) const;

    /// True for a map file, false for a run directory.
    bool is_finished_map() const;

    /// The folder of the tile files of an unfinished map, or of a finished one that is made of
    /// them.
    const std::filesystem::path& tile_directory() const;

    std::vector<std::uint64_t> missing_tiles() const;

    /// Seconds that threads have spent on the tiles of a finished map.
    double compute_seconds() const;

    /// One checked tile. \error store_error where it is missing or damaged
    tile_data tile(std::uint64_t index) const;

    /// Checksums as stored in the tile table, one per layer. \error store_error where it is missing
    std::vector<layer_sum> stored_sums(std::uint64_t index) const;

    /// Numbers of one layer in C order; missing and damaged tiles read as the layer's fill value
    /// and are added to `problems()`.
    std::vector<double> read(std::string_view layer, const cell_range& range) const;

    /// The whole layer (for maps known to be small).
    std::vector<double> read_all(std::string_view layer) const;

    /// One line per tile that could not be read so far.
    const std::vector<std::string>& problems() const;

private:
    struct implementation;
    std::unique_ptr<implementation> self_;
};

}  // namespace hopscotch
