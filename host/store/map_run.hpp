// A map while it is computed: a run directory `<map>.tiles` with one small HDF5 file per finished
// tile, packed into the single map file at the end or joined there by virtual datasets. `kill -9`
// at any moment loses only the tiles in flight.
//
//     map_run run(layout, {.map = "basin.h5", .fingerprint = ..., .attributes = ..., .existing =
//     ...}); for (tile : run.missing_tiles())            // any order, any thread
//         run.put(compress(layout, compute(tile), 4, seconds));
//     run.finish({.attributes = ..., .attractors = ...});
//
// All members may be called from any thread. Every failure is a store_error; finished tiles stay.
#pragma once

#include "host/map/layout.hpp"
#include "host/map/shard.hpp"
#include "host/map/table_group.hpp"
#include "host/store/compressed_tile.hpp"
#include "host/store/store_error.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hopscotch {

/// What to do where the map file or its run directory is already there.
enum class if_exists : std::uint8_t {
    refuse,   // store_error that says what is there
    resume,   // go on with the finished tiles of the same scene; a finished map is complete() at
              // once
    replace,  // drop unfinished tiles; an old map file is replaced when the new one is finished
};

/// Who else works in the run directory.
enum class run_role : std::uint8_t {
    owner,   // the one process that opens, locks, finishes
    helper,  // another process (MPI rank) that only puts tiles into a run its owner has opened
};

struct run_options {
    std::filesystem::path map;    // the finished file
    std::string fingerprint{};    // of the scene: only its own scene resumes a run
    attribute_list attributes{};  // known before the run: scene text, version, backend ...
    if_exists existing = if_exists::refuse;
    run_role role = run_role::owner;
    shard part{};                                  // the tiles this run is about
    std::vector<std::filesystem::path> adopted{};  // run directories whose tiles are taken over
    bool keeps_tiles = false;  // the map file refers to the tile files instead of holding them
};

/// What is known only after the last tile.
struct map_summary {
    attribute_list attributes{};  // added to, or replacing, those of the run
    std::vector<attractor_row> attractors{};
    std::vector<std::string> point_columns{};  // names of the columns of attractor_row::points
    std::vector<table_group> groups{};
};

/// Name under which a run keeps what its labels depend on; tiles of runs that differ in it do not
/// belong together.
inline constexpr const char* kept_plan = "plan";

class map_run {
public:
    /// Opens the run: makes the directory, takes its lock, reads and checks the tiles of an earlier
    /// run.
    map_run(const map_layout& layout, const run_options& options);
    ~map_run();  // gives the lock back; unfinished tiles stay for --resume
    map_run(map_run&&) noexcept;
    map_run& operator=(map_run&&) noexcept;

    /// True where the finished map file of this scene is already there (if_exists::resume only).
    bool complete() const;

    /// What opening met and the user should read: damaged tiles dropped, a dead run's lock taken
    /// over.
    const std::vector<std::string>& notes() const;

    std::vector<std::uint64_t> finished_tiles() const;
    std::vector<std::uint64_t> missing_tiles() const;  // of those the run is about

    /// \error store_error that names missing tiles, and shards that lack them
    void require_all_tiles() const;

    /// Writes one finished tile: temporary name, then rename. A tile put twice is replaced.
    void put(const compressed_tile& tile);

    /// The numbers of a finished tile, until `finish` has packed it.
    tile_data read(std::uint64_t tile) const;

    /// Seconds that computing a finished tile took.
    double seconds_of(std::uint64_t tile) const;

    /// How often each value of an integer layer (int8, int16) occurs in the finished tiles.
    value_counts counts(std::string_view layer) const;

    /// The hash over the finished tiles (the map's hash once none is missing).
    std::string hash() const;

    /// Keeps a text with the run until it is finished: what a resumed run must not decide anew.
    /// \error store_error
    void keep(const std::string& name, const std::string& text);

    /// What this run or the one it resumes has kept; empty where it has not.
    std::string kept(std::string_view name) const;

    /// Reads these tiles again, which helpers may have put or replaced since; for the owner.
    void rescan(const std::vector<std::uint64_t>& tiles);

    /// Seconds spent on a tile that is known here, else 0.
    double seconds(std::uint64_t tile) const;

    /// Packs all tiles into the map file (raw chunks, one tile in memory), renames it into place,
    /// removes the run directory. Where tiles are kept, the map file's layers are virtual datasets
    /// over the tile files and the directory stays beside it. A layer `label` without flags takes
    /// those of the attractors. Attributes `Conventions`, `fingerprint` and `hash` are added.
    /// \error  store_error where tiles are missing or the disk is full; the tiles stay
    void finish(const map_summary& summary);

    /// The run directory of a map file.
    static std::filesystem::path directory_of(const std::filesystem::path& map);

private:
    struct implementation;
    std::unique_ptr<implementation> self_;
};

}  // namespace hopscotch
