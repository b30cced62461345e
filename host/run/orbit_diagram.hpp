// An orbit diagram: over the grid's first axis (a parameter, or a conserved state column), the
// states that orbits settle on, from every start of the other axes and along sweeps up and down.
// Says which tiles belong together and computes them; the run itself is that of any map.
#pragma once

#include "host/run/stop_condition.hpp"
#include "host/run/tile_pipeline.hpp"
#include "host/run/tiles.hpp"
#include "host/scene/diagram_grid.hpp"
#include "host/store/map_run.hpp"

#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

namespace hopscotch {

/// The missing tiles of a diagram, in pieces of work that depend on nothing but finished tiles:
/// starts that are followed together, and what is missing of a sweep, tile after tile. A resumed
/// sweep goes on from the last state stored before its first missing tile, or begins anew where the
/// map does not store every column of the state (or a shard has not got that tile).
class orbit_diagram {
public:
    /// \param run      that holds the finished tiles
    /// \param missing  of the run, rising; the same on every rank
    /// \param backend  that the user has asked for; one orbit alone is fastest by scalar kernels,
    ///                 which `auto` therefore means for sweeps
    orbit_diagram(const tile_job& job, const map_run& run, const stop_condition& stop,
                  const shard& part, std::string_view backend, std::vector<std::uint64_t> missing);

    /// One missing tile for every piece of work, the sweeps, which take longest, first.
    const std::vector<std::uint64_t>& heads() const { return heads_; }

    /// Computes the piece of work with this head and stores its missing tiles. A sweep ends early
    /// where the run has to stop. Thread safe. \error device_error, store_error
    void compute(const tile_box& head, const tile_sink& store);

private:
    /// States are columns of the section that returns end on; empty: begin at the first start.
    using state = std::vector<double>;

    std::vector<std::uint64_t> sweep_tiles(std::uint64_t orbit) const;
    void add_sweep(std::uint64_t orbit, const shard& part);
    void add_starts();
    void compute_starts(const std::vector<std::uint64_t>& tiles, const tile_sink& store) const;
    void compute_sweep(const std::vector<std::uint64_t>& tiles, const tile_sink& store);
    tile_result sweep_through(const tile_box& box, state& carried);
    state state_before(const std::vector<std::uint64_t>& tiles) const;
    bool is_missing(std::uint64_t tile) const;

    const tile_job& job_;
    const map_run& run_;
    const stop_condition& stop_;
    kernel_in_use one_orbit_;  // the kernel of sweeps
    std::vector<std::uint64_t> missing_;
    std::vector<std::size_t> state_layers_;  // of each column; empty unless all are stored
    std::vector<std::uint64_t> heads_;
    std::map<std::uint64_t, std::vector<std::uint64_t>> pieces_;  // by head, in order of computing
};

}  // namespace hopscotch
