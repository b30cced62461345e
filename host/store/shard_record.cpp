// Kept texts `shard_I_of_N`, one per shard that has begun.
#include "host/store/shard_record.hpp"

#include "host/store/atomic_file.hpp"
#include "host/store/lock_holder.hpp"
#include "host/store/run_directory.hpp"

#include <algorithm>
#include <cstdio>
#include <span>
#include <system_error>

namespace hopscotch {

namespace {

std::string name_of(const shard& part) {
    return "shard_" + std::to_string(part.index + 1) + "_of_" + std::to_string(part.count);
}

std::string option_of(const shard& part) {
    return std::to_string(part.index + 1) + "/" + std::to_string(part.count);
}

/// Into how many shards the run was cut; 1 where it was not, the largest number where there are
/// several.
std::uint64_t n_shards(const std::filesystem::path& directory) {
    std::uint64_t count = 1;
    std::error_code error;
    for (std::filesystem::directory_iterator each(directory, error), end; !error && each != end;
         each.increment(error)) {
        unsigned long long index = 0;
        unsigned long long of = 0;
        const std::string name = each->path().filename().string();
        if (std::sscanf(name.c_str(), "shard_%llu_of_%llu.kept", &index, &of) == 2) {
            count = std::max<std::uint64_t>(count, of);
        }
    }
    return count;
}

std::string beginning_of(const std::filesystem::path& directory, const shard& part) {
    const std::filesystem::path file = kept_path(directory, name_of(part));
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return "never begun here";
    const std::vector<std::byte> bytes = read_bytes(file);
    return "begun by " + std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

/// The shards that lack tiles, and how many each lacks.
std::vector<std::pair<shard, std::uint64_t>> incomplete(const std::vector<std::uint64_t>& missing,
                                                        std::uint64_t count) {
    std::vector<std::uint64_t> lacks(count);
    for (const std::uint64_t tile : missing) ++lacks[tile % count];
    std::vector<std::pair<shard, std::uint64_t>> result;
    for (std::uint64_t i = 0; i < count; ++i) {
        if (lacks[i] > 0) result.push_back({{i, count}, lacks[i]});
    }
    return result;
}

}  // namespace

void record_shard(const std::filesystem::path& directory, const shard& part) {
    const lock_holder me = lock_holder::this_process();
    const std::string text = "process " + std::to_string(me.process) + " on " + me.host +
                             (me.job == "-" ? "" : " (job " + me.job + ")") + " at " + me.since;
    write_atomically(kept_path(directory, name_of(part)), std::as_bytes(std::span(text)));
}

std::string missing_words(const std::filesystem::path& directory,
                          const std::vector<std::uint64_t>& missing, std::uint64_t n_tiles) {
    constexpr std::size_t most_named = 4;
    const std::string noun = missing.size() == 1 ? " tile of " : " tiles of ";
    std::string text = std::to_string(missing.size()) + noun + std::to_string(n_tiles) +
                       " missing, the first one is " + std::to_string(missing.front());
    const std::uint64_t count = n_shards(directory);
    if (count == 1) return text;
    const auto parts = incomplete(missing, count);
    for (std::size_t i = 0; i < std::min(parts.size(), most_named); ++i) {
        const auto& [part, n] = parts[i];
        text += ": shard " + option_of(part) + " lacks " + std::to_string(n) + " of " +
                std::to_string(part.n_tiles(n_tiles)) + ", " + beginning_of(directory, part);
    }
    if (parts.size() > most_named) {
        text += ": and " + std::to_string(parts.size() - most_named) + " more shards";
    }
    return text;
}

std::string missing_remedy(const std::filesystem::path& directory,
                           const std::vector<std::uint64_t>& missing) {
    const std::uint64_t count = n_shards(directory);
    if (count == 1) return "go on with --resume";
    return "go on with --resume --shard " + option_of(incomplete(missing, count).front().first) +
           " and merge again";
}

}  // namespace hopscotch
