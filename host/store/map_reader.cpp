#include "host/store/map_reader.hpp"

#include "host/map/numbers.hpp"
#include "host/map/rows.hpp"
#include "host/store/group_file.hpp"
#include "host/store/map_file.hpp"
#include "host/store/run_directory.hpp"
#include "host/store/tile_file.hpp"

#include <algorithm>
#include <optional>
#include <set>

namespace hopscotch {

namespace {

/// The cells of a strided range that fall into one tile: where they come from and where they go.
class tile_cells {
public:
    tile_cells(const cell_range& range, const tile_box& box)
        : tile_shape_(box.extent), range_shape_(range.shape()) {
        for (std::size_t i = 0; i < box.extent.size(); ++i) {
            along_.push_back(cells_along(range, box, i));
            extent_.push_back(along_.back().from.size());
        }
    }

    bool is_empty() const { return std::count(extent_.begin(), extent_.end(), 0U) > 0; }

    void copy(number_type type, const std::vector<std::byte>& tile,
              std::vector<double>& result) const {
        const axis_cells& last = along_.back();
        std::vector<std::uint64_t> from(extent_.size());
        std::vector<std::uint64_t> to(extent_.size());
        for_each_row(extent_, [&](const std::vector<std::uint64_t>& position) {
            for (std::size_t i = 0; i + 1 < extent_.size(); ++i) {
                from[i] = along_[i].from[position[i]];
                to[i] = along_[i].to[position[i]];
            }
            const std::uint64_t from_row = offset_in(tile_shape_, from);
            const std::uint64_t to_row = offset_in(range_shape_, to);
            for (std::uint64_t j = 0; j < extent_.back(); ++j) {
                result[to_row + last.to[j]] = number_at(type, tile.data(), from_row + last.from[j]);
            }
        });
    }

private:
    struct axis_cells {
        std::vector<std::uint64_t> from;  // position in the tile
        std::vector<std::uint64_t> to;    // position in the result
    };

    static axis_cells cells_along(const cell_range& range, const tile_box& box, std::size_t axis) {
        const std::uint64_t stride = range.stride[axis];
        const std::uint64_t origin = range.origin[axis];
        const std::uint64_t begin = box.origin[axis];
        const std::uint64_t end = std::min(begin + box.extent[axis], origin + range.extent[axis]);
        axis_cells cells;
        std::uint64_t k = begin <= origin ? 0 : (begin - origin + stride - 1) / stride;
        for (; origin + k * stride < end; ++k) {
            cells.from.push_back(origin + k * stride - begin);
            cells.to.push_back(k);
        }
        return cells;
    }

    std::vector<std::uint64_t> tile_shape_;
    std::vector<std::uint64_t> range_shape_;
    std::vector<axis_cells> along_;
    std::vector<std::uint64_t> extent_;
};

/// Tiles that a range touches, in C order.
std::vector<std::uint64_t> tiles_of(const map_layout& layout, const cell_range& range) {
    const std::vector<std::uint64_t> full = full_tile(layout);
    std::vector<std::uint64_t> first;
    std::vector<std::uint64_t> n;
    for (std::size_t i = 0; i < full.size(); ++i) {
        first.push_back(range.origin[i] / full[i]);
        n.push_back((range.origin[i] + range.extent[i] - 1) / full[i] - first[i] + 1);
    }
    std::vector<std::uint64_t> tiles;
    const std::vector<std::uint64_t> along = layout.tiles_along();
    std::vector<std::uint64_t> at(full.size());
    for_each_row(n, [&](const std::vector<std::uint64_t>& position) {
        for (std::size_t i = 0; i < at.size(); ++i) at[i] = first[i] + position[i];
        const std::uint64_t row = offset_in(along, at);
        for (std::uint64_t j = 0; j < n.back(); ++j) tiles.push_back(row + j);
    });
    return tiles;
}

cell_range validated(const map_layout& layout, cell_range range) {
    const std::size_t rank = layout.axes.size();
    if (range.stride.empty()) range.stride.assign(rank, 1);
    bool is_valid =
        range.origin.size() == rank && range.extent.size() == rank && range.stride.size() == rank;
    for (std::size_t i = 0; is_valid && i < rank; ++i) {
        is_valid = range.extent[i] > 0 && range.stride[i] > 0 &&
                   range.origin[i] < layout.axes[i].size() &&
                   range.extent[i] <= layout.axes[i].size() - range.origin[i];
    }
    if (!is_valid) throw store_error("range of cells", "it does not lie in the map", "");
    return range;
}

}  // namespace

std::vector<std::uint64_t> cell_range::shape() const {
    std::vector<std::uint64_t> result = extent;
    for (std::size_t i = 0; i < stride.size(); ++i) {
        result[i] = (extent[i] + stride[i] - 1) / stride[i];
    }
    return result;
}

struct map_reader::implementation {
    explicit implementation(const std::filesystem::path& path);

    std::string place_of(std::uint64_t tile) const;
    [[noreturn]] void fail(std::uint64_t tile, const std::string& reason) const;
    std::vector<std::byte> layer_of(std::uint64_t tile, std::size_t layer);
    bool has_tile(std::uint64_t tile);
    compressed_tile stored_tile(std::uint64_t tile);

    std::filesystem::path place;    // the file, or the run directory
    std::optional<hdf5_file> file;  // a finished map
    std::filesystem::path tiles;    // folder of the tile files; empty where the file is packed
    map_description map;
    std::string fingerprint;
    std::vector<tile_row> table;      // of a finished map
    std::set<std::uint64_t> damaged;  // tiles already listed as problems
    std::vector<std::string> problems;
};

map_reader::implementation::implementation(const std::filesystem::path& path) : place(path) {
    const hdf5_guard guard;
    if (!std::filesystem::exists(path) && std::filesystem::exists(hopscotch::directory_of(path))) {
        place = hopscotch::directory_of(path);
    }
    if (std::filesystem::is_directory(place)) {
        map = read_run_description(place);
        tiles = place;
    } else {
        file = hdf5_file::open(place);
        map = read_description(*file);
        table = read_tile_table(*file, map.layout);
        if (!map.tile_directory.empty()) tiles = place.parent_path() / map.tile_directory;
    }
    fingerprint = attribute_of(map.attributes, "fingerprint");
}

std::string map_reader::implementation::place_of(std::uint64_t tile) const {
    return tiles.empty() ? place.string() + ": tile " + std::to_string(tile)
                         : tile_path(tiles, tile).string();
}

void map_reader::implementation::fail(std::uint64_t tile, const std::string& reason) const {
    throw store_error(place_of(tile), reason, "compute the map again");
}

bool map_reader::implementation::has_tile(std::uint64_t tile) {
    if (!tiles.empty()) return std::filesystem::exists(tile_path(tiles, tile));
    const tile_box& box = table[tile].box;
    return std::all_of(map.layout.layers.begin(), map.layout.layers.end(),
                       [&](const layer& each) { return file->has_chunk(each.name, box.origin); });
}

/// A tile from its own file. Of a finished map it must still be the one that was joined to it.
compressed_tile map_reader::implementation::stored_tile(std::uint64_t tile) {
    if (!has_tile(tile)) {
        throw store_error(place_of(tile), file ? "missing" : "not computed yet",
                          file ? "run again with --resume" : "");
    }
    compressed_tile stored = read_tile(tiles, map.layout, fingerprint, tile);
    if (file && stored.summary.sums != table[tile].sums) {
        fail(tile, "not the tile that the map was made of");
    }
    return stored;
}

/// The checked numbers of one layer of one tile.
std::vector<std::byte> map_reader::implementation::layer_of(std::uint64_t tile, std::size_t layer) {
    const tile_box box = box_of(map.layout, tile);
    const std::string& name = map.layout.layers[layer].name;
    std::vector<std::byte> chunk;
    layer_sum sum;
    if (tiles.empty()) {
        const hdf5_guard guard;  // decoding needs none: several readers work side by side
        auto stored = file->read_chunk(name, box.origin);
        if (!stored) fail(tile, "missing: layer " + name + " was never written");
        chunk = std::move(*stored);
        sum = table[tile].sums[layer];
    } else {
        compressed_tile stored = stored_tile(tile);
        chunk = std::move(stored.chunks[layer]);
        sum = stored.summary.sums[layer];
    }
    std::vector<std::byte> values;
    try {
        values = decode_chunk(map.layout, box, layer, chunk);
    } catch (const std::runtime_error& error) {
        fail(tile, "damaged: layer " + name + ": " + error.what());
    }
    if (sum_of(map.layout, box, layer, values) != sum) {
        fail(tile, "damaged: layer " + name + " does not agree with its checksum");
    }
    return values;
}

map_reader::map_reader(const std::filesystem::path& path)
    : self_(std::make_unique<implementation>(path)) {}

map_reader::~map_reader() {
    const hdf5_guard guard;
    self_.reset();
}

map_reader::map_reader(map_reader&&) noexcept = default;

map_reader& map_reader::operator=(map_reader&& other) noexcept {
    const hdf5_guard guard;
    self_ = std::move(other.self_);
    return *this;
}

const map_layout& map_reader::layout() const { return self_->map.layout; }

const attribute_list& map_reader::attributes() const { return self_->map.attributes; }

std::string map_reader::attribute(std::string_view name) const {
    return attribute_of(self_->map.attributes, name);
}

const std::vector<attractor_row>& map_reader::attractors() const { return self_->map.attractors; }

const std::vector<std::string>& map_reader::point_columns() const {
    return self_->map.point_columns;
}

std::optional<table_group> map_reader::group(const std::string& name) const {
    const hdf5_guard guard;
    if (!self_->file || !self_->file->has(name)) return std::nullopt;
    return read_group(*self_->file, name);
}

bool map_reader::is_finished_map() const { return self_->file.has_value(); }

const std::filesystem::path& map_reader::tile_directory() const { return self_->tiles; }

double map_reader::compute_seconds() const {
    double seconds = 0.0;
    for (const tile_row& row : self_->table) seconds += row.seconds;
    return seconds;
}

std::vector<std::uint64_t> map_reader::missing_tiles() const {
    const hdf5_guard guard;
    std::vector<std::uint64_t> tiles;
    for (std::uint64_t i = 0; i < layout().n_tiles(); ++i) {
        if (!self_->has_tile(i)) tiles.push_back(i);
    }
    return tiles;
}

tile_data map_reader::tile(std::uint64_t index) const {
    tile_data result{box_of(layout(), index), {}};
    if (!self_->tiles.empty()) {  // all layers at one reading
        return checked_tile(layout(), self_->stored_tile(index), self_->place_of(index));
    }
    for (std::size_t i = 0; i < layout().layers.size(); ++i) {
        result.layers.push_back(self_->layer_of(index, i));
    }
    return result;
}

std::vector<layer_sum> map_reader::stored_sums(std::uint64_t index) const {
    if (self_->file) return self_->table.at(index).sums;
    return read_tile(self_->place, layout(), self_->fingerprint, index).summary.sums;
}

std::vector<double> map_reader::read(std::string_view layer, const cell_range& asked) const {
    const std::size_t index = layer_index(layout(), layer);
    if (index == layout().layers.size()) {
        throw store_error(self_->place.string(), "has no layer " + std::string(layer), "");
    }
    const cell_range range = validated(layout(), asked);
    const std::vector<std::uint64_t> shape = range.shape();
    std::uint64_t n = 1;
    for (const std::uint64_t each : shape) n *= each;
    const struct layer& wanted = layout().layers[index];
    std::vector<double> result(n, wanted.fill);
    for (const std::uint64_t tile : tiles_of(layout(), range)) {
        const tile_cells cells(range, box_of(layout(), tile));
        if (cells.is_empty()) continue;  // the tile lies between the strides
        try {
            cells.copy(wanted.type, self_->layer_of(tile, index), result);
        } catch (const store_error& error) {
            if (self_->damaged.insert(tile).second) self_->problems.push_back(error.what());
        }
    }
    return result;
}

std::vector<double> map_reader::read_all(std::string_view layer) const {
    cell_range all;
    for (const axis& each : layout().axes) {
        all.origin.push_back(0);
        all.extent.push_back(each.size());
    }
    return read(layer, all);
}

const std::vector<std::string>& map_reader::problems() const { return self_->problems; }

}  // namespace hopscotch
