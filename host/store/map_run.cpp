#include "host/store/map_run.hpp"

#include "host/store/adopt_tiles.hpp"
#include "host/store/atomic_file.hpp"
#include "host/store/map_file.hpp"
#include "host/store/run_directory.hpp"
#include "host/store/run_lock.hpp"
#include "host/store/shard_record.hpp"
#include "host/store/tile_file.hpp"
#include "host/store/verify.hpp"

#include <algorithm>
#include <csignal>
#include <mutex>
#include <optional>
#include <span>
#include <stdexcept>
#include <system_error>

namespace hopscotch {

namespace {

std::string plural(std::uint64_t n, const std::string& noun) {
    return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

}  // namespace

struct map_run::implementation {
    implementation(const map_layout& map, const run_options& asked)
        : layout(map), options(asked), directory(hopscotch::directory_of(asked.map)) {
        finished.resize(layout.n_tiles());
    }

    void open();
    void open_as_helper();
    bool is_map_there();
    bool are_tiles_there();
    void clear_or_refuse();
    void join_earlier_run();
    void describe();
    void load(std::uint64_t tile);
    void scan();
    std::vector<layer_sum> sums() const;
    map_description description(const map_summary& summary) const;
    std::uint64_t bytes_of_tiles() const;
    void pack(const std::filesystem::path& partial, const map_description& map);
    void leave(bool is_done) noexcept;

    map_layout layout;
    run_options options;
    std::filesystem::path directory;
    std::unique_ptr<run_lock> lock;
    std::vector<std::string> notes;
    std::vector<std::optional<tile_summary>> finished;  // one per tile
    bool is_complete = false;
    bool is_virtual = false;  // the map that is there already
    std::mutex mutex;
};

/// The finished map: refused, accepted as the answer, or left to be replaced.
bool map_run::implementation::is_map_there() {
    std::error_code ignored;
    if (!std::filesystem::exists(options.map, ignored)) return false;
    if (std::filesystem::is_directory(options.map, ignored)) {
        throw store_error(options.map.string(), "is a folder, not a file",
                          "choose another name with -o");
    }
    if (options.existing == if_exists::replace) {
        // a virtual map would show the new run's tiles as its own
        if (std::filesystem::exists(directory, ignored)) remove_file(options.map);
        return false;
    }
    if (options.existing == if_exists::refuse) {
        throw store_error(options.map.string(), "there is already a file of that name",
                          "remove it or choose another name with -o");
    }
    const hdf5_guard guard;
    const hdf5_file file = hdf5_file::open(options.map);
    const bool has_one = file.has_attribute("/", "fingerprint");
    require_same_scene(options.map, has_one ? file.attribute_text("/", "fingerprint") : "missing",
                       options.fingerprint);
    is_virtual = file.has_attribute("/tiles", "directory");
    return !is_virtual || are_tiles_there();
}

/// A virtual map is finished as long as its tiles are; those missing or damaged are computed again.
bool map_run::implementation::are_tiles_there() {
    std::uint64_t n_wrong = 0;
    for (const map_problem& problem : verify_file(options.map)) {
        notes.push_back(problem.text);
        ++n_wrong;
    }
    return n_wrong == 0;
}

/// What an earlier run left: kept to go on with, removed, or refused.
void map_run::implementation::clear_or_refuse() {
    const shard& part = options.part;
    remove_partial_files(directory, part);
    const std::vector<std::uint64_t> present = tiles_present(directory, part);
    if (options.existing == if_exists::replace) {
        remove_tiles(directory, part);
        if (tiles_present(directory).empty()) remove_kept(directory);
    } else if (options.existing == if_exists::refuse && !present.empty()) {
        throw store_error(directory.string(),
                          "an unfinished run with " + plural(present.size(), "tile") + " of " +
                              std::to_string(part.n_tiles(layout.n_tiles())),
                          "go on with --resume or remove the folder");
    }
    if (!tiles_present(directory).empty()) join_earlier_run();
}

/// \error store_error where the tiles that lie there are those of another map
void map_run::implementation::join_earlier_run() {
    try {
        require_same_run(directory, layout, options.fingerprint);
    } catch (const store_error& error) {
        if (error.place() != description_path(directory).string()) throw;
        // unreadable: the tiles know their scene themselves
        notes.push_back(std::string(error.what()) + ": written anew");
    }
}

/// Shards that begin together may all write the description; it is the same one.
void map_run::implementation::describe() {
    map_description map{layout, options.attributes, {}, {}};
    set_attribute(map.attributes, "fingerprint", options.fingerprint);
    write_run_description(directory, completed(std::move(map), options.map.string()));
    if (!options.part.is_whole()) record_shard(directory, options.part);
}

void map_run::implementation::open() {
    std::signal(SIGXFSZ, SIG_IGN);  // a limit on file sizes is an error, not a death
    if (options.role == run_role::helper) return open_as_helper();
    is_complete = is_map_there();
    if (is_complete) return;
    make_directory(directory);
    lock = std::make_unique<run_lock>(directory, options.part);
    if (!lock->note().empty()) notes.push_back(lock->note());
    clear_or_refuse();
    for (const std::filesystem::path& other : options.adopted) {
        const auto taken = adopt_tiles(directory, other, layout, options.fingerprint);
        notes.insert(notes.end(), taken.begin(), taken.end());
    }
    scan();  // before anything of an earlier run is overwritten
    describe();
}

void map_run::implementation::open_as_helper() {
    const map_description map = read_run_description(directory);
    require_same_scene(directory, attribute_of(map.attributes, "fingerprint"), options.fingerprint);
    for (const std::uint64_t tile : tiles_present(directory)) {
        if (tile < finished.size()) finished[tile].emplace();  // its owner has checked it
    }
}

/// Takes a tile that lies in the directory, or removes it where it is damaged.
void map_run::implementation::load(std::uint64_t tile) {
    const std::string place = tile_path(directory, tile).string();
    try {
        const compressed_tile stored = read_tile(directory, layout, options.fingerprint, tile);
        tile_summary summary = summarise(layout, checked_tile(layout, stored, place));
        summary.seconds = stored.summary.seconds;
        finished[tile] = std::move(summary);
    } catch (const store_error& error) {
        if (error.reason() == another_scene) throw;
        remove_file(place);
        notes.push_back(place + " (" + error.reason() + "): removed, it is computed again");
    }
}

void map_run::implementation::scan() {
    for (const std::uint64_t tile : tiles_present(directory, options.part)) {
        if (tile < finished.size() && !finished[tile]) load(tile);
    }
}

std::vector<layer_sum> map_run::implementation::sums() const {
    std::vector<layer_sum> total(layout.layers.size());
    for (const auto& tile : finished) {
        for (std::size_t i = 0; tile && i < tile->sums.size(); ++i) total[i] += tile->sums[i];
    }
    return total;
}

map_description map_run::implementation::description(const map_summary& summary) const {
    map_description map{layout, options.attributes, summary.attractors, summary.point_columns,
                        summary.groups};
    if (options.keeps_tiles) map.tile_directory = directory.filename().string();
    for (const auto& [name, value] : summary.attributes) set_attribute(map.attributes, name, value);
    set_attribute(map.attributes, "fingerprint", options.fingerprint);
    set_attribute(map.attributes, "hash", map_hash(layout, sums()));
    return completed(std::move(map), options.map.string());
}

/// At least what the packed map needs: tile files hold the same chunks and more around them.
std::uint64_t map_run::implementation::bytes_of_tiles() const {
    std::uint64_t bytes = 0;
    for (std::uint64_t tile = 0; tile < finished.size(); ++tile) {
        std::error_code missing;  // reading the tile will say so
        const std::uint64_t size = std::filesystem::file_size(tile_path(directory, tile), missing);
        if (!missing) bytes += size;
    }
    return bytes;
}

void map_run::implementation::pack(const std::filesystem::path& partial,
                                   const map_description& map) {
    const hdf5_guard guard;
    const bool is_joined = !map.tile_directory.empty();
    hdf5_file file = is_joined ? hdf5_file::create_virtual(partial) : hdf5_file::create(partial);
    write_description(file, map);
    std::vector<tile_row> rows;
    for (std::uint64_t index = 0; index < finished.size(); ++index) {
        const compressed_tile tile = read_tile(directory, layout, options.fingerprint, index);
        if (tile.summary.sums != finished[index]->sums) {
            throw store_error(tile_path(directory, index).string(),
                              "the tile changed since it was finished", "run again with --resume");
        }
        for (std::size_t i = 0; !is_joined && i < layout.layers.size(); ++i) {
            file.write_chunk(layout.layers[i].name, tile.box.origin, tile.chunks[i]);
        }
        rows.push_back({tile.box, tile.summary.sums, tile.summary.seconds});
    }
    write_tile_table(file, map, rows);
    file.close();
}

void map_run::implementation::leave(bool is_done) noexcept {
    if (!lock) return;
    if (!options.part.is_whole()) return lock.reset();  // the folder is the other shards' too
    try {
        if (is_done || tiles_present(directory).empty()) remove_directory(directory);
    } catch (const std::exception&) {
        // Left-over files do no harm: the next run finds and removes them.
    }
    lock.reset();
    std::error_code ignored;  // gone only where it is empty
    std::filesystem::remove(directory, ignored);
}

map_run::map_run(const map_layout& layout, const run_options& options)
    : self_(std::make_unique<implementation>(layout, options)) {
    self_->open();
}

map_run::~map_run() {
    if (self_) self_->leave(false);
}

map_run::map_run(map_run&&) noexcept = default;
map_run& map_run::operator=(map_run&&) noexcept = default;

bool map_run::complete() const { return self_->is_complete; }

const std::vector<std::string>& map_run::notes() const { return self_->notes; }

std::vector<std::uint64_t> map_run::finished_tiles() const {
    const std::lock_guard guard(self_->mutex);
    std::vector<std::uint64_t> tiles;
    for (std::uint64_t i = 0; i < self_->finished.size(); ++i) {
        if (self_->is_complete || self_->finished[i]) tiles.push_back(i);
    }
    return tiles;
}

std::vector<std::uint64_t> map_run::missing_tiles() const {
    const std::lock_guard guard(self_->mutex);
    std::vector<std::uint64_t> tiles;
    for (std::uint64_t i = 0; i < self_->finished.size(); ++i) {
        const bool is_wanted = !self_->is_complete && self_->options.part.owns(i);
        if (is_wanted && !self_->finished[i]) tiles.push_back(i);
    }
    return tiles;
}

void map_run::require_all_tiles() const {
    const std::vector<std::uint64_t> missing = missing_tiles();
    if (missing.empty()) return;
    std::string reason = missing_words(self_->directory, missing, self_->finished.size());
    for (const std::string& note : self_->notes) reason += ": " + note;  // e.g. damaged ones
    throw store_error(self_->directory.string(), reason, missing_remedy(self_->directory, missing));
}

void map_run::put(const compressed_tile& tile) {
    const tile_box box = box_of(self_->layout, tile.box.index);
    if (box.origin != tile.box.origin || box.extent != tile.box.extent) {
        throw std::invalid_argument("tile " + std::to_string(box.index) +
                                    " does not lie where the map has it");
    }
    write_tile(self_->directory, self_->layout, self_->options.fingerprint, tile);
    const std::lock_guard guard(self_->mutex);
    self_->finished[box.index] = tile.summary;
    if (self_->lock) self_->lock->touch();
}

tile_data map_run::read(std::uint64_t tile) const {
    const compressed_tile stored =
        read_tile(self_->directory, self_->layout, self_->options.fingerprint, tile);
    return checked_tile(self_->layout, stored, tile_path(self_->directory, tile).string());
}

double map_run::seconds_of(std::uint64_t tile) const {
    const std::lock_guard guard(self_->mutex);
    return self_->finished.at(tile)->seconds;
}

value_counts map_run::counts(std::string_view layer) const {
    const std::lock_guard guard(self_->mutex);
    const std::size_t index = layer_index(self_->layout, layer);
    value_counts total;
    for (const auto& tile : self_->finished) {
        if (!tile || index >= tile->counts.size()) continue;
        for (const auto& [value, n] : tile->counts[index]) total[value] += n;
    }
    return total;
}

std::string map_run::hash() const {
    const std::lock_guard guard(self_->mutex);
    return map_hash(self_->layout, self_->sums());
}

void map_run::keep(const std::string& name, const std::string& text) {
    write_atomically(kept_path(self_->directory, name), std::as_bytes(std::span(text)));
}

std::string map_run::kept(std::string_view name) const {
    const std::filesystem::path path = kept_path(self_->directory, name);
    if (self_->is_complete || !std::filesystem::exists(path)) return {};
    const std::vector<std::byte> bytes = read_bytes(path);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void map_run::rescan(const std::vector<std::uint64_t>& tiles) {
    const std::lock_guard guard(self_->mutex);
    for (const std::uint64_t tile : tiles) {
        self_->finished.at(tile).reset();
        if (std::filesystem::exists(tile_path(self_->directory, tile))) self_->load(tile);
    }
}

double map_run::seconds(std::uint64_t tile) const {
    const std::lock_guard guard(self_->mutex);
    return self_->finished.at(tile) ? self_->finished[tile]->seconds : 0.0;
}

void map_run::finish(const map_summary& summary) {
    require_all_tiles();
    const std::lock_guard guard(self_->mutex);
    if (self_->is_complete) return;
    const std::filesystem::path partial = partial_name(self_->directory / "map.h5");
    try {
        if (!self_->options.keeps_tiles) require_room(partial, self_->bytes_of_tiles());
        self_->pack(partial, self_->description(summary));
        flush_to_disk(partial);
        rename_into_place(partial, self_->options.map);
    } catch (...) {
        std::error_code ignored;
        std::filesystem::remove(partial, ignored);
        throw;
    }
    self_->is_complete = true;
    if (self_->options.keeps_tiles) remove_kept(self_->directory);
    self_->leave(!self_->options.keeps_tiles);
}

std::filesystem::path map_run::directory_of(const std::filesystem::path& map) {
    return hopscotch::directory_of(map);
}

}  // namespace hopscotch
