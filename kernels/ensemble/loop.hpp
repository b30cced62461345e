// The ensemble loop: lanes that never idle. A finished trajectory is written out and its lane takes
// the next cell at once; starts are prepared a full pack at a time. The same functions, with one
// lane, are what a CUDA thread runs.
#pragma once

#include "kernels/contract/model.hpp"
#include "kernels/ensemble/request.hpp"
#include "kernels/ensemble/traps.hpp"
#include "kernels/lanes/lane.hpp"

#include <type_traits>

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// A trajectory and what the loop itself keeps of it. Only Real members, so that a lane is a column
/// of doubles in memory.
template <class Model, class Real>
struct trajectory {
    typename Model::template lane<Real> motion;
    Real returns;  // completed
    Real steps;    // of work since the last return
    Real busy;     // 1 while the lane holds an unfinished trajectory
};

template <class Model, int Variant, class Real>
class ensemble {
public:
    HOPSCOTCH_DEVICE explicit ensemble(const ensemble_request& request) : request_(request) {}

    /// Computes cells [first, last) and returns how full the lanes were.
    HOPSCOTCH_DEVICE lane_statistics run(std::uint64_t first, std::uint64_t last) {
        next_cell_ = first;
        last_cell_ = last;
        lane_statistics statistics;
        now_.busy = Real(0.0);
        int n_busy = refill(0);
        while (n_busy > 0) {
            const mask_of<Real> active = now_.busy > Real(0.0);
            unwatched watch;
            const progress<Real> done = Model::template step<Variant>(now_.motion, active, watch);
            statistics.issued += width;
            statistics.useful += static_cast<std::uint64_t>(n_busy);
            settle(now_, cells_, done, active);
            n_busy = count(now_.busy > Real(0.0));
            if (n_busy < width) n_busy = refill(n_busy);
        }
        return statistics;
    }

private:
    static constexpr int width = width_of<Real>;
    static constexpr int n_fields =
        static_cast<int>(sizeof(trajectory<Model, Real>) / sizeof(Real));
    using state = trajectory<Model, Real>;

    const ensemble_request& request_;
    std::uint64_t next_cell_ = 0;
    std::uint64_t last_cell_ = 0;
    state now_;
    state fresh_;  // prepared starts, taken lane by lane
    std::uint64_t cells_[width];
    std::uint64_t fresh_cells_[width];
    int fresh_first_ = 0;  // the next lane of fresh_ to take
    int fresh_left_ = 0;   // lanes of fresh_ not yet taken

    HOPSCOTCH_DEVICE static double* lanes_of(Real& field) {
        return reinterpret_cast<double*>(&field);
    }
    HOPSCOTCH_DEVICE static const double* lanes_of(const Real& field) {
        return reinterpret_cast<const double*>(&field);
    }

    /// Starts a full pack of cells and keeps, at its front, those that do not end at once.
    HOPSCOTCH_DEVICE void prepare() {
        const std::uint64_t left = last_cell_ - next_cell_;
        const int n = left < static_cast<std::uint64_t>(width) ? static_cast<int>(left) : width;
        Real columns[most_columns];
        Real parameters[most_parameters];
        for (int lane = 0; lane < width; ++lane) {
            fresh_cells_[lane] =
                next_cell_ + static_cast<std::uint64_t>(lane);  // beyond n: not written
        }
        load(columns, request_.columns, most_columns);
        load(parameters, request_.parameters, most_parameters);
        Real is_cell(0.0);
        for (int lane = 0; lane < n; ++lane) lanes_of(is_cell)[lane] = 1.0;
        next_cell_ += static_cast<std::uint64_t>(n);

        unwatched watch;
        fresh_.returns = fresh_.steps = Real(0.0);
        fresh_.busy = is_cell;
        const progress<Real> done = Model::template begin<Variant>(
            fresh_.motion, request_.section, columns, parameters, request_.options, watch);
        settle(fresh_, fresh_cells_, done, is_cell > Real(0.0));
        gather_fresh();
    }

    /// Moves the prepared starts that go on to the front of the pack.
    HOPSCOTCH_DEVICE void gather_fresh() {
        int kept = 0;
        for (int lane = 0; lane < width; ++lane) {
            if (!(lanes_of(fresh_.busy)[lane] > 0.0)) continue;
            if (kept < lane) {
                double* fields = reinterpret_cast<double*>(&fresh_);
                for (int f = 0; f < n_fields; ++f)
                    fields[f * width + kept] = fields[f * width + lane];
                fresh_cells_[kept] = fresh_cells_[lane];
            }
            ++kept;
        }
        fresh_first_ = 0;
        fresh_left_ = kept;
    }

    HOPSCOTCH_DEVICE void load(Real* columns, const column_source* source, int n) const {
        for (int c = 0; c < n; ++c) {
            if (source[c].values == nullptr) break;
            if (source[c].size == 1) {
                columns[c] = Real(source[c].values[0]);
                continue;
            }
            // the cells of a pack follow each other: one division for all of them
            std::uint64_t index = source[c].index(fresh_cells_[0]);
            std::uint64_t within = fresh_cells_[0] % source[c].stride;
            for (int lane = 0; lane < width; ++lane) {
                lanes_of(columns[c])[lane] = source[c].values[index];
                if (++within < source[c].stride) continue;
                within = 0;
                if (++index == source[c].size) index = 0;
            }
        }
    }

    /// Fills idle lanes; returns the number of busy ones.
    HOPSCOTCH_DEVICE int refill(int n_busy) {
        while (n_busy < width) {
            if (fresh_left_ == 0) {
                if (next_cell_ == last_cell_) break;
                prepare();
                continue;
            }
            n_busy += take_fresh(width - n_busy);
        }
        return n_busy;
    }

    /// Moves up to `wanted` prepared starts into idle lanes; returns how many.
    HOPSCOTCH_DEVICE int take_fresh(int wanted) {
        const int n = wanted < fresh_left_ ? wanted : fresh_left_;
        Real chosen(0.0);  // the first n idle lanes
        for (int lane = 0, taken = 0; taken < n; ++lane) {
            if (lanes_of(now_.busy)[lane] > 0.0) continue;
            lanes_of(chosen)[lane] = 1.0;
            cells_[lane] = fresh_cells_[fresh_first_ + taken++];
        }
        const mask_of<Real> where = chosen > Real(0.0);
        Real* to = reinterpret_cast<Real*>(&now_);
        const Real* from = reinterpret_cast<const Real*>(&fresh_);
        for (int f = 0; f < n_fields; ++f)
            fill_lanes(to[f], where, lanes_of(from[f]) + fresh_first_);
        fresh_first_ += n;
        fresh_left_ -= n;
        return n;
    }

    /// Books what a step achieved, decides orbits, and writes out those that are finished.
    HOPSCOTCH_DEVICE void settle(state& at, const std::uint64_t* cells, const progress<Real>& done,
                                 mask_of<Real> active) {
        const Real zero(0.0);
        const Real one(1.0);
        const mask_of<Real> returned = active & done.returned;
        at.returns = select(returned, at.returns + one, at.returns);
        at.steps = select(returned, zero, at.steps + one);
        const mask_of<Real> spent = active & (at.steps >= Real(request_.max_steps));
        const mask_of<Real> full = at.returns >= Real(static_cast<double>(request_.max_returns));
        Real ended = select(active, done.ended, zero);
        if (request_.decided_by == decision::returns && !any(full | spent | !(ended == zero)))
            return;

        ended = select(spent & (ended == zero), code_of<Real>(outcome::budget), ended);
        Real label = zero;
        const bool asks_model = request_.decided_by == decision::certificate ||
                                request_.decided_by == decision::ellipsoids;
        if (asks_model) {
            if constexpr (certifies<Model, Real>) {
                label = select(active & (ended == zero),
                               Model::template certificate<Variant>(at.motion), zero);
            }
        }
        if (request_.decided_by == decision::intervals) {
            find_intervals(at, cells, active & (ended == zero), label);
        } else if (request_.decided_by == decision::ellipsoids) {
            find_ellipsoids(at, cells, returned & (ended == zero) & (label == zero), label);
        }
        const mask_of<Real> dies =
            (ended == code_of<Real>(outcome::stuck)) | (ended == code_of<Real>(outcome::rest));
        label = select(active & dies, Real(static_cast<double>(request_.died_label)), label);

        const mask_of<Real> labelled = label > zero;
        const Real at_limit =
            request_.decided_by == decision::returns ? zero : code_of<Real>(outcome::budget);
        const mask_of<Real> finished = active & (labelled | full | !(ended == zero));
        ended = select(labelled, code_of<Real>(outcome::attracted),
                       select(full & (ended == zero), at_limit, ended));
        if (any(finished)) {
            write(at, label, ended, cells, select(finished, one, zero));
            at.busy = select(finished, zero, at.busy);
        }
    }

    HOPSCOTCH_DEVICE void find_intervals(const state& at, const std::uint64_t* cells,
                                         mask_of<Real> wanted, Real& label) {
        Real columns[most_columns];
        Model::read_state(at.motion, request_.end_section, columns);
        const Real flags = select(wanted, Real(1.0), Real(0.0));
        for (int lane = 0; lane < width; ++lane) {
            if (!(lanes_of(flags)[lane] > 0.0)) continue;
            const double x = lanes_of(columns[0])[lane];
            const auto point = static_cast<std::uint64_t>(request_.trap_point.at(cells[lane]));
            const trap_interval* trap =
                request_.traps + point * static_cast<std::uint64_t>(request_.n_traps);
            for (int i = 0; i < request_.n_traps; ++i) {
                if (x >= trap[i].lowest && x <= trap[i].highest) {
                    lanes_of(label)[lane] = static_cast<double>(trap[i].label);
                    break;
                }
            }
        }
    }

    HOPSCOTCH_DEVICE void find_ellipsoids(const state& at, const std::uint64_t* cells,
                                          mask_of<Real> wanted, Real& label) {
        if (!any(wanted)) return;
        Real columns[most_columns];
        Model::read_state(at.motion, request_.end_section, columns);
        if (request_.trap_point.size == 1) {  // the same traps for every lane
            for (int i = request_.n_ellipsoids; i-- > 0;) {
                const trap_ellipsoid& trap = request_.ellipsoids[i];
                label = select(wanted & holds(trap, columns), Real(static_cast<double>(trap.label)),
                               label);
            }
            return;
        }
        const Real flags = select(wanted, Real(1.0), Real(0.0));
        for (int lane = 0; lane < width; ++lane) {
            if (!(lanes_of(flags)[lane] > 0.0)) continue;
            double x[most_columns];
            for (int c = 0; c < most_columns; ++c) x[c] = lanes_of(columns[c])[lane];
            const auto point = static_cast<std::uint64_t>(request_.trap_point.at(cells[lane]));
            const trap_ellipsoid* trap =
                request_.ellipsoids + point * static_cast<std::uint64_t>(request_.n_ellipsoids);
            for (int i = 0; i < request_.n_ellipsoids; ++i) {
                if (!holds(trap[i], x)) continue;
                lanes_of(label)[lane] = static_cast<double>(trap[i].label);
                break;
            }
        }
    }

    template <int Size>
    HOPSCOTCH_DEVICE static bool is_wanted(double* const (&layers)[Size]) {
        for (const double* layer : layers) {
            if (layer != nullptr) return true;
        }
        return false;
    }

    /// Writes the results of the lanes flagged, layer by layer.
    HOPSCOTCH_DEVICE void write(const state& at, const Real& label, const Real& ended,
                                const std::uint64_t* cells, const Real& flags) const {
        const ensemble_request& to = request_;
        int lanes[width];
        int n = 0;
        for (int lane = 0; lane < width; ++lane) {
            lanes[n] = lane;
            n += lanes_of(flags)[lane] > 0.0 ? 1 : 0;
        }
        const auto put = [&](auto* layer, const Real& field) {
            if (layer == nullptr) return;
            using number = std::remove_reference_t<decltype(*layer)>;
            for (int i = 0; i < n; ++i) {
                layer[cells[lanes[i]]] = static_cast<number>(lanes_of(field)[lanes[i]]);
            }
        };
        put(to.label, label);
        put(to.outcome, ended);
        put(to.returns, at.returns);
        put(to.events, at.motion.events);
        put(to.time, at.motion.time);
        if (is_wanted(to.state)) {
            Real columns[most_columns];
            Model::read_state(at.motion, to.end_section, columns);
            for (int c = 0; c < most_columns; ++c) put(to.state[c], columns[c]);
        }
        if (is_wanted(to.extras)) {
            Real extras[most_extras];
            Model::read_extras(at.motion, extras);
            for (int e = 0; e < most_extras; ++e) put(to.extras[e], extras[e]);
        }
    }
};

/// The ensemble function of one model variant in one arithmetic: what a backend's table points to.
template <class Model, int Variant, class Real>
requires model<Model, Real> lane_statistics run_ensemble(const ensemble_request& request) {
    ensemble_request complete = request;
    complete.end_section =
        Model::info.sections[static_cast<std::size_t>(request.section)].returns_to;
    ensemble<Model, Variant, Real> lanes(complete);
    return lanes.run(0, request.n_cells);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
