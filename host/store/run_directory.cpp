#include "host/store/run_directory.hpp"

#include "host/store/atomic_file.hpp"
#include "host/store/run_lock.hpp"
#include "host/store/tile_file.hpp"

#include <algorithm>
#include <system_error>

namespace hopscotch {

namespace {

/// Calls visit(path) for every file of the directory; the list is made first, so that visit may
/// remove.
template <class Visit>
void for_each_file(const std::filesystem::path& directory, Visit&& visit) {
    std::error_code error;
    std::vector<std::filesystem::path> files;
    for (std::filesystem::directory_iterator each(directory, error), end; !error && each != end;
         each.increment(error)) {
        files.push_back(each->path());
    }
    if (error) throw system_error_at(directory.string(), "cannot be listed", error.value());
    for (const std::filesystem::path& file : files) visit(file);
}

bool is_partial(const std::filesystem::path& file) {
    return file.filename().string().find(partial_mark) != std::string::npos;
}

/// True for the unfinished file of a tile of that shard; a whole run owns every unfinished file.
bool is_partial_of(const std::filesystem::path& file, const shard& part) {
    if (!is_partial(file) || part.is_whole()) return is_partial(file);
    const std::string name = file.filename().string();
    const auto tile = tile_of(name.substr(0, name.find(partial_mark)));
    return tile && part.owns(*tile);
}

constexpr const char* kept_ending = ".kept";

}  // namespace

std::filesystem::path directory_of(const std::filesystem::path& map) {
    std::filesystem::path directory = map;
    directory += ".tiles";
    return directory;
}

std::filesystem::path description_path(const std::filesystem::path& directory) {
    return directory / "run.h5";
}

void make_directory(const std::filesystem::path& directory) {
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (error) throw system_error_at(directory.string(), "cannot be made", error.value());
}

void remove_file(const std::filesystem::path& file) {
    std::error_code error;
    std::filesystem::remove(file, error);
    if (error) throw system_error_at(file.string(), "cannot be removed", error.value());
}

std::vector<std::uint64_t> tiles_present(const std::filesystem::path& directory) {
    std::vector<std::uint64_t> tiles;
    for_each_file(directory, [&](const std::filesystem::path& file) {
        if (const auto tile = tile_of(file)) tiles.push_back(*tile);
    });
    std::sort(tiles.begin(), tiles.end());
    return tiles;
}

std::vector<std::uint64_t> tiles_present(const std::filesystem::path& directory,
                                         const shard& part) {
    std::vector<std::uint64_t> tiles = tiles_present(directory);
    std::erase_if(tiles, [&](std::uint64_t tile) { return !part.owns(tile); });
    return tiles;
}

void remove_partial_files(const std::filesystem::path& directory, const shard& part) {
    for_each_file(directory, [&](const std::filesystem::path& file) {
        if (is_partial_of(file, part)) remove_file(file);
    });
}

void remove_tiles(const std::filesystem::path& directory, const shard& part) {
    for (const std::uint64_t tile : tiles_present(directory, part)) {
        remove_file(tile_path(directory, tile));
    }
}

std::filesystem::path kept_path(const std::filesystem::path& directory, std::string_view name) {
    return directory / (std::string(name) + kept_ending);
}

void remove_kept(const std::filesystem::path& directory) {
    for_each_file(directory, [](const std::filesystem::path& file) {
        if (file.extension() == kept_ending) remove_file(file);
    });
}

void copy_kept(const std::filesystem::path& from, const std::filesystem::path& to) {
    for_each_file(from, [&](const std::filesystem::path& file) {
        if (file.extension() != kept_ending) return;
        const std::filesystem::path copy = to / file.filename();
        std::error_code ignored;
        if (!std::filesystem::exists(copy, ignored)) write_atomically(copy, read_bytes(file));
    });
}

void remove_directory(const std::filesystem::path& directory) {
    remove_tiles(directory);
    remove_kept(directory);
    remove_partial_files(directory);
    for_each_file(directory, [](const std::filesystem::path& file) {
        if (is_shard_lock(file)) remove_file(file);
    });
    remove_file(description_path(directory));
    std::error_code ignored;  // somebody may have put a file of his own there
    std::filesystem::remove(directory, ignored);
}

void write_run_description(const std::filesystem::path& directory, const map_description& map) {
    const std::filesystem::path path = description_path(directory);
    std::vector<std::byte> image;
    {
        const hdf5_guard guard;
        hdf5_file file = hdf5_file::create_in_memory(path.string());
        write_description(file, map);
        image = file.image();
    }
    write_atomically(path, image);
}

map_description read_run_description(const std::filesystem::path& directory) {
    const std::filesystem::path path = description_path(directory);
    const std::vector<std::byte> image = read_bytes(path);
    const hdf5_guard guard;
    hdf5_file file = hdf5_file::open_image(image, path.string());
    return read_description(file);
}

void require_same_scene(const std::filesystem::path& place, const std::string& there,
                        const std::string& fingerprint) {
    if (there == fingerprint) return;
    throw store_error(
        place.string(),
        "belongs to another scene: fingerprint " + there + ", this scene's is " + fingerprint,
        "remove it or choose another name with -o");
}

}  // namespace hopscotch
