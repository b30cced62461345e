// Checks and copies tiles.
#include "host/store/adopt_tiles.hpp"

#include "host/store/atomic_file.hpp"
#include "host/store/map_run.hpp"
#include "host/store/run_directory.hpp"
#include "host/store/tile_file.hpp"

#include <algorithm>
#include <system_error>

namespace hopscotch {

namespace {

bool is_same(const axis& a, const axis& b) { return a.name == b.name && a.values == b.values; }

bool is_same(const layer& a, const layer& b) { return a.name == b.name && a.type == b.type; }

/// True where tiles of one layout fit the other.
bool is_same(const map_layout& a, const map_layout& b) {
    const auto same = [](const auto& x, const auto& y) { return is_same(x, y); };
    return std::equal(a.axes.begin(), a.axes.end(), b.axes.begin(), b.axes.end(), same) &&
           std::equal(a.layers.begin(), a.layers.end(), b.layers.begin(), b.layers.end(), same) &&
           full_tile(a) == full_tile(b);
}

/// Labels found by different searches are different labels.
void require_same_plan(const std::filesystem::path& directory, const std::filesystem::path& other) {
    std::error_code ignored;
    const std::filesystem::path ours = kept_path(directory, kept_plan);
    const std::filesystem::path theirs = kept_path(other, kept_plan);
    if (!std::filesystem::exists(ours, ignored) || !std::filesystem::exists(theirs, ignored))
        return;
    if (read_bytes(ours) == read_bytes(theirs)) return;
    throw store_error(other.string(),
                      "its labels stand for other attractors than those of " + directory.string(),
                      "compute all shards with one version on processors of one kind");
}

}  // namespace

void require_same_run(const std::filesystem::path& directory, const map_layout& layout,
                      const std::string& fingerprint) {
    const map_description before = read_run_description(directory);
    require_same_scene(directory, attribute_of(before.attributes, "fingerprint"), fingerprint);
    if (!is_same(before.layout, layout)) {
        throw store_error(directory.string(), "an unfinished run with another grid or tiles",
                          "remove the folder");
    }
}

std::vector<std::string> adopt_tiles(const std::filesystem::path& directory,
                                     const std::filesystem::path& other, const map_layout& layout,
                                     const std::string& fingerprint) {
    require_same_run(other, layout, fingerprint);
    require_same_plan(directory, other);
    std::vector<std::string> notes;
    const std::vector<std::uint64_t> own = tiles_present(directory);
    for (const std::uint64_t tile : tiles_present(other)) {
        if (tile >= layout.n_tiles() || std::binary_search(own.begin(), own.end(), tile)) continue;
        const std::filesystem::path place = tile_path(other, tile);
        try {
            const compressed_tile stored = read_tile(other, layout, fingerprint, tile);
            checked_tile(layout, stored, place.string());
        } catch (const store_error& error) {
            notes.push_back(place.string() + " (" + error.reason() + "): not taken");
            continue;
        }
        write_atomically(tile_path(directory, tile), read_bytes(place));
    }
    copy_kept(other, directory);
    return notes;
}

}  // namespace hopscotch
