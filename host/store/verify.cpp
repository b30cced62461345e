#include "host/store/verify.hpp"

#include "host/map/hash.hpp"
#include "host/store/map_reader.hpp"

#include <exception>

namespace hopscotch {

namespace {

map_problem hash_problem(const std::filesystem::path& path, const std::string& reason) {
    return {map_problem::kind::wrong_hash, 0, store_error(path.string(), reason).what()};
}

}  // namespace

std::vector<map_problem> verify_file(const std::filesystem::path& path) {
    std::vector<map_problem> problems;
    try {
        const map_reader map(path);
        std::vector<layer_sum> sums(map.layout().layers.size());
        const std::vector<std::uint64_t> missing = map.missing_tiles();
        auto next_missing = missing.begin();
        for (std::uint64_t tile = 0; tile < map.layout().n_tiles(); ++tile) {
            const bool is_missing = next_missing != missing.end() && *next_missing == tile;
            if (is_missing) ++next_missing;
            try {
                map.tile(tile);
                const std::vector<layer_sum> stored = map.stored_sums(tile);
                for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += stored[i];
            } catch (const store_error& error) {
                problems.push_back(
                    {is_missing ? map_problem::kind::missing_tile : map_problem::kind::damaged_tile,
                     tile, error.what()});
            }
        }
        if (map.is_finished_map() && problems.empty()) {
            const std::string stored = map.attribute("hash");
            const std::string computed = map_hash(map.layout(), sums);
            if (stored != computed) {
                problems.push_back(hash_problem(
                    path, "its hash says " + stored + ", its numbers give " + computed));
            }
        }
    } catch (const std::exception& error) {
        problems.push_back({map_problem::kind::unreadable_file, 0, error.what()});
    }
    return problems;
}

}  // namespace hopscotch
