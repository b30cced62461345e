// The run of a sweep.
#include "host/run/run_sweep.hpp"

#include "host/map/text_hash.hpp"
#include "host/run/attributes.hpp"
#include "host/run/map_draw.hpp"
#include "host/scene/diagram_grid.hpp"
#include "host/run/requests.hpp"
#include "host/run/stop_condition.hpp"
#include "host/run/sweep_table.hpp"
#include "host/run/thread_limit.hpp"
#include "host/scene/grid.hpp"
#include "host/scene/sweep.hpp"
#include "host/store/run_directory.hpp"
#include "host/store/run_lock.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <thread>

#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

namespace hopscotch {
namespace {

namespace fs = std::filesystem;

/// What a pass of a map adds to the sweep's progress, tile by tile.
progress_display in_sweep(std::function<void(const run_tally&)> count, bool is_first_pass) {
    return [count = std::move(count), is_first_pass,
            counted = run_tally{}](const run_tally& so_far) mutable {
        run_tally more = so_far;  // since the last tile
        more.tiles = 0;           // the sweep counts maps
        more.cells = is_first_pass ? so_far.cells - counted.cells : 0;
        more.undecided -= counted.undecided;
        more.busy -= counted.busy;
        more.lanes.issued -= counted.lanes.issued;
        more.lanes.useful -= counted.lanes.useful;
        counted = so_far;
        count(more);
    };
}

/// A map of the sweep is computed by a team of one, whose tiles count in the sweep's progress and
/// whose first pass is open to helpers.
class member_of_sweep : public team_of_one {
public:
    /// \param draw  null where there are no other ranks
    member_of_sweep(std::function<void(const run_tally&)> count, map_draw* draw, std::size_t map)
        : count_(std::move(count)), draw_(draw), map_(map) {}

    std::unique_ptr<tile_queue> open_queue(std::vector<std::uint64_t> tiles,
                                           progress_display) override {
        const bool is_first = ++n_passes_ == 1;
        if (!is_first || draw_ == nullptr) {
            return team_of_one::open_queue(std::move(tiles), in_sweep(count_, is_first));
        }
        return std::make_unique<owner_queue>(*draw_, map_, std::move(tiles),
                                             in_sweep(count_, is_first));
    }
    bool has_helpers() const override {
        return draw_ != nullptr && n_passes_ == 1 && draw_->n_helped(map_) > 0;
    }

private:
    std::function<void(const run_tally&)> count_;
    map_draw* draw_;
    std::size_t map_;
    int n_passes_ = 0;
};

/// One sweep by a team, seen from one rank. The members are called in the order they stand here.
class sweep_run {
public:
    sweep_run(const scene& sweep, const run_choices& choices, const sweep_hooks& hooks, team& ranks)
        : sweep_(sweep),
          choices_(choices),
          hooks_(hooks),
          ranks_(ranks),
          stop_(choices.walltime),
          n_threads_(choices.n_threads > 0 ? choices.n_threads : ranks.default_threads()),
          threads_(n_threads_) {
        report_.file = choices.file.empty() ? sweep.output.file : choices.file;
        report_.directory = sweep_directory_of(report_.file);
        report_.n_cells_per_map = layout().n_cells();
        report_.maps.resize(sweep.sweep.n_points());
        for (std::uint64_t point = 0; point < report_.maps.size(); ++point) {
            report_.maps[point].point = point;
            report_.maps[point].values =
                sweep_values(sweep.sweep, sweep_coordinates(sweep.sweep, point));
        }
    }

    sweep_report run() {
        std::vector<std::uint64_t> missing;
        ranks_.together([&] {
            if (ranks_.is_first()) missing = open();
        });
        missing = ranks_.from_first(std::move(missing));
        if (missing.size() < static_cast<std::size_t>(ranks_.size())) {
            compute_together(missing);
        } else {
            compute_pool(missing);
        }
        ranks_.together([&] {
            if (ranks_.is_first()) finish();
        });
        report_.is_finished = ranks_.from_first({report_.n_missing == 0 ? 1U : 0U})[0] == 1;
        return std::move(report_);
    }

private:
    /// The layout of every map; a finished map's own where there is one.
    map_layout layout() const { return layout_of(map_scene(sweep_, 0)); }

    fs::path map_file(std::uint64_t point) const {
        return sweep_map_path(report_.directory, point);
    }

    bool is_own(std::uint64_t point) const { return choices_.part.owns(point); }

    /// Finished maps and run directories of this sweep, or of this shard of it.
    std::vector<fs::path> own_maps() const {
        std::vector<fs::path> maps;
        std::error_code ignored;
        for (std::uint64_t point = 0; point < report_.maps.size(); ++point) {
            if (!is_own(point)) continue;
            for (const fs::path& path : {map_file(point), map_run::directory_of(map_file(point))}) {
                if (fs::exists(path, ignored)) maps.push_back(path);
            }
        }
        return maps;
    }

    /// Takes the directory and returns the points whose maps are missing.
    std::vector<std::uint64_t> open() {
        std::error_code ignored;
        const bool has_index = fs::exists(report_.file, ignored);
        // shards share the index, not the maps
        const bool is_there = (has_index && choices_.part.is_whole()) || !own_maps().empty();
        if (is_there && choices_.existing == if_exists::refuse) {
            throw store_error(report_.file.string(),
                              "there is already a sweep or a file of that name",
                              "go on with --resume, or choose another name with -o");
        }
        if (has_index && choices_.existing != if_exists::replace) require_same_sweep();
        make_directory(report_.directory);
        lock_ = std::make_unique<run_lock>(report_.directory, choices_.part);
        if (!lock_->note().empty()) report_.notes.push_back(lock_->note());
        if (choices_.existing == if_exists::replace) remove_maps();
        write_index();  // so that the sweep can be looked at while it grows
        std::vector<std::uint64_t> missing;
        for (std::uint64_t point = 0; point < report_.maps.size(); ++point) {
            if (is_own(point) && !is_map_there(point)) missing.push_back(point);
        }
        return missing;
    }

    /// A map that cannot be read is computed again; one of another scene is refused.
    bool is_map_there(std::uint64_t point) {
        const fs::path file = map_file(point);
        std::error_code ignored;
        if (!fs::exists(file, ignored)) return false;
        try {
            const std::string there = map_reader(file).attribute("fingerprint");
            if (there == map_scene(sweep_, point).fingerprint) return true;
        } catch (const store_error& error) {
            report_.notes.push_back(std::string(error.what()) + ": removed, it is computed again");
            remove_file(file);
            return false;
        }
        throw store_error(file.string(), "a map of another scene", "remove it");
    }

    void require_same_sweep() const {
        std::error_code ignored;
        if (!fs::exists(report_.file, ignored)) return;  // every map knows its scene itself
        const std::string there =
            attribute_in(read_sweep_contents(report_.file).attributes, "fingerprint");
        if (there == sweep_.fingerprint) return;
        throw store_error(report_.file.string(),
                          "belongs to another scene: fingerprint " + there + ", this scene's is " +
                              sweep_.fingerprint,
                          "remove it or choose another name with -o");
    }

    static std::string attribute_in(const attribute_list& attributes, std::string_view name) {
        for (const auto& [key, value] : attributes) {
            if (key == name) return value;
        }
        return {};
    }

    void remove_maps() {
        if (choices_.part.is_whole()) remove_file(report_.file);
        for (const fs::path& path : own_maps()) fs::remove_all(path);
    }

    /// Threads that work on maps side by side.
    int n_at_once(std::size_t n_maps) const {
        return static_cast<int>(std::min(n_maps, static_cast<std::size_t>(n_threads_)));
    }

    run_choices choices_of_map(std::uint64_t point) const {
        run_choices choices = choices_;
        choices.file = map_file(point);
        choices.existing = if_exists::resume;
        choices.part = {};
        choices.is_quiet = true;
        choices.n_threads = n_threads_;
        if (choices.walltime) *choices.walltime -= stop_.elapsed();
        return choices;
    }

    /// One map after the other, each by all ranks.
    void compute_together(const std::vector<std::uint64_t>& missing) {
        for (const std::uint64_t point : missing) {
            const bool is_over = ranks_.from_first({stop_.is_due() ? 1U : 0U})[0] == 1;
            if (is_over) return;
            const scene map = map_scene(sweep_, point);
            run_choices choices = choices_of_map(point);
            choices.is_quiet = choices_.is_quiet;
            note(run_map(map, choices, hooks_.of_map(map, choices.file), ranks_));
        }
    }

    void compute_pool(const std::vector<std::uint64_t>& missing) {
        const std::uint64_t n_all = report_.maps.size() * report_.n_cells_per_map;
        progress_line line(n_all, n_all - missing.size() * report_.n_cells_per_map,
                           choices_.is_quiet || !ranks_.is_first());
        const auto queue =
            ranks_.open_queue(missing, [&](const run_tally& tally) { line.show(tally); });
        map_draw draw(ranks_.open_counters(map_draw::n_counters(missing.size())),
                      layout().n_tiles());
        pool all{missing, *queue, draw};
        double end = 0.0;
        ranks_.together([&] {
            try {
                tbb::task_arena(n_threads_).execute([&] { draw_maps(all); });
                if (ranks_.size() > 1) help(all);
            } catch (...) {
                halt(all);
                throw;
            }
            end = stop_.elapsed();
        });
        report_.tally = queue->close();
        report_.n_computed = report_.tally.tiles;
        report_.seconds = stop_.elapsed();
        report_.idle_at_end = idle_share(ranks_.from_all(end));
        if (!ranks_.is_first()) return;
        for (std::size_t i = 0; i < missing.size(); ++i) report_.n_helped += draw.n_helped(i);
    }

    /// The maps to compute, numbered in this order, and where threads and ranks draw them.
    struct pool {
        const std::vector<std::uint64_t>& points;
        tile_queue& maps;
        map_draw& tiles;
        void count(const run_tally& tally) {
            const std::lock_guard guard(mutex);
            maps.count(tally);
        }
        std::mutex mutex{};
    };

    static void halt(pool& all) {
        all.maps.halt();
        all.tiles.halt();
    }

    void draw_maps(pool& all) {
        using tbb::filter_mode;
        tbb::parallel_pipeline(
            static_cast<std::size_t>(n_threads_),
            tbb::make_filter<void, std::uint64_t>(filter_mode::serial_in_order,
                                                  [&](tbb::flow_control& flow) {
                                                      if (stop_condition::is_interrupted())
                                                          halt(all);
                                                      if (!stop_.is_due()) {
                                                          if (const auto point = all.maps.next())
                                                              return *point;
                                                      }
                                                      flow.stop();
                                                      return std::uint64_t{0};
                                                  }) &
                tbb::make_filter<std::uint64_t, void>(
                    filter_mode::parallel, [&](std::uint64_t point) { compute_map(point, all); }));
    }

    void compute_map(std::uint64_t point, pool& all) {
        const auto place = std::lower_bound(all.points.begin(), all.points.end(), point);
        const auto index = static_cast<std::size_t>(place - all.points.begin());
        const scene map = map_scene(sweep_, point);
        // tiles of a diagram depend on each other
        const bool can_be_helped = ranks_.size() > 1 && !is_orbit_diagram(map);
        member_of_sweep alone([&](const run_tally& tally) { all.count(tally); },
                              can_be_helped ? &all.tiles : nullptr, index);
        run_choices choices = choices_of_map(point);
        choices.n_at_once = n_at_once(all.points.size());
        const run_report done = run_map(map, choices, hooks_.of_map(map, choices.file), alone);
        all.tiles.close(index);  // nobody waits for a map that has not been opened, a diagram's
        if (done.is_finished) {
            run_tally one;
            one.tiles = 1;
            all.count(one);
        }
        const std::lock_guard guard(mutex_);
        note(done);
    }

    /// Without a map of its own this rank computes tiles of the others' until there are none. A map
    /// with few tiles left is not worth the search for its attractors.
    void help(pool& all) {
        std::vector<std::size_t> maps(all.points.size());
        std::iota(maps.begin(), maps.end(), std::size_t{0});
        while (!all.tiles.is_halted() && !stop_.is_due()) {
            std::erase_if(maps, [&](std::size_t map) { return all.tiles.is_dry(map); });
            if (maps.empty()) return;
            bool has_helped = false;
            for (const std::size_t map : maps) {
                const auto enough = 2 * static_cast<std::uint64_t>(n_threads_);
                if (all.tiles.n_left(map) <= enough) continue;
                help_with(map, all);
                has_helped = true;
            }
            if (!has_helped) std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
    }

    void help_with(std::size_t index, pool& all) {
        helper_queue queue(all.tiles, index,
                           in_sweep([&](const run_tally& tally) { all.count(tally); }, true));
        const std::optional<std::uint64_t> first = queue.next();
        if (!first) return;
        queue.put_back(*first);  // until it is finished the owner keeps the run open
        const scene map = map_scene(sweep_, all.points[index]);
        const run_choices choices = choices_of_map(all.points[index]);
        help_with_map(map, choices, hooks_.of_map(map, choices.file), queue);
    }

    void note(const run_report& done) {
        report_.notes.insert(report_.notes.end(), done.notes.begin(), done.notes.end());
    }

    /// Reads every map that is there and writes the index anew.
    void finish() {
        tbb::task_arena(n_threads_).execute([&] {
            tbb::parallel_for(std::size_t{0}, report_.maps.size(),
                              [&](std::size_t i) { look_at(report_.maps[i]); });
        });
        std::string hashes;
        for (const swept_map& map : report_.maps) {
            if (!map.is_there && is_own(map.point)) ++report_.n_missing;
            hashes += map.hash + "\n";
        }
        report_.is_part_done = report_.n_missing == 0 && !choices_.part.is_whole();
        if (report_.n_missing == 0 && !report_.is_part_done) report_.hash = text_hash(hashes);
        write_index();
        lock_.reset();
    }

    void look_at(swept_map& map) {
        const thread_limit share(n_threads_, n_at_once(report_.maps.size()));
        const fs::path file = map_file(map.point);
        std::error_code ignored;
        if (!fs::exists(file, ignored)) return;
        try {
            const map_reader reader(file);
            map.hash = reader.attribute("hash");
            map.seconds = reader.compute_seconds();
            map.attractors = reader.attractors();
            map.point_columns = reader.point_columns();
            if (hooks_.facts) map.facts = hooks_.facts(reader);
            map.is_there = reader.problems().empty();
        } catch (const store_error& error) {
            const std::lock_guard guard(mutex_);
            report_.notes.push_back(error.what());
        }
    }

    void write_index() {
        sweep_index index;
        const scene first = map_scene(sweep_, 0);
        index.attributes = attributes_of(sweep_, map_kernel_of(first, choices_.backend).first());
        index.attributes.emplace_back("fingerprint", sweep_.fingerprint);
        if (!report_.hash.empty()) index.attributes.emplace_back("hash", report_.hash);
        index.directory = report_.directory.filename().string();
        index.axes = sweep_dimensions(sweep_);
        index.followers = sweep_followers(sweep_);
        index.layout = layout();
        name_labels(index.layout, report_.maps);
        add_table(index, report_.maps);
        write_sweep_index(report_.file, index);
    }

    const scene& sweep_;
    const run_choices& choices_;
    const sweep_hooks& hooks_;
    team& ranks_;
    stop_condition stop_;
    int n_threads_;
    thread_limit threads_;
    std::unique_ptr<run_lock> lock_;
    std::mutex mutex_;
    sweep_report report_;
};

}  // namespace

std::filesystem::path sweep_directory_of(const std::filesystem::path& index) {
    std::filesystem::path directory = index;
    directory += ".maps";
    return directory;
}

sweep_report run_sweep(const scene& sweep, const run_choices& choices, const sweep_hooks& hooks,
                       team& ranks) {
    check_is_map(sweep);
    std::optional<sweep_run> run;
    ranks.together([&] { run.emplace(sweep, choices, hooks, ranks); });
    return run->run();
}

sweep_report run_sweep(const scene& sweep, const run_choices& choices, const sweep_hooks& hooks) {
    team_of_one alone;
    return run_sweep(sweep, choices, hooks, alone);
}

run_estimate estimate_sweep(const scene& sweep, const run_choices& choices,
                            const sweep_hooks& hooks) {
    const std::uint64_t n_maps = sweep.sweep.n_points();
    std::vector<std::uint64_t> points{0, n_maps / 2, n_maps - 1};
    points.erase(std::unique(points.begin(), points.end()), points.end());
    run_estimate total;
    double seconds = 0.0;
    double undecided = 0.0;
    std::uint64_t n_sampled = 0;
    for (const std::uint64_t point : points) {
        const scene map = map_scene(sweep, point);
        total = estimate(map, choices, hooks.of_map(map, {}));
        seconds += total.seconds;
        undecided += total.undecided;
        n_sampled += total.n_sampled;
    }
    const auto n = static_cast<double>(points.size());
    total.n_maps = n_maps;
    total.n_cells *= n_maps;
    total.n_tiles *= n_maps;
    total.bytes *= n_maps;
    total.memory *= std::min<std::uint64_t>(n_maps, static_cast<std::uint64_t>(total.n_threads));
    total.seconds = seconds / n * static_cast<double>(n_maps);
    total.undecided = undecided / n;
    total.n_sampled = n_sampled;
    return total;
}

}  // namespace hopscotch
