// Lanes that never idle: a finished trajectory's lane takes the next cell at once, and starts are
// prepared a full pack at a time. The base of every ensemble loop (loop.hpp, tangent.hpp).
#pragma once

#include "kernels/contract/model.hpp"
#include "kernels/ensemble/request.hpp"
#include "kernels/lanes/lane.hpp"

#include <type_traits>

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// \tparam Ensemble  the loop derived from this one. It offers
///                   begin(State&, const std::uint64_t* cells, const Real* columns,
///                         const Real* parameters, const Real& is_cell)
///                     starts the lanes where is_cell is 1, and settles those that end at once;
///                   advance(State&, const std::uint64_t* cells, mask active)
///                     a step of the active lanes, then results of those that are finished.
/// \tparam State     one lane's trajectory: only members made of Real, so that a lane is a column
///                   of doubles in memory. State::busy is 1 while a lane holds an unfinished
///                   trajectory.
template <class Ensemble, class State, class Real>
class refilled_lanes {
public:
    HOPSCOTCH_DEVICE explicit refilled_lanes(const ensemble_request& request) : request_(request) {}

    /// Computes cells [first, last) and returns how full the lanes were.
    HOPSCOTCH_DEVICE lane_statistics run(std::uint64_t first, std::uint64_t last) {
        next_cell_ = first;
        last_cell_ = last;
        lane_statistics statistics;
        now_.busy = Real(0.0);
        int n_busy = refill(0);
        while (n_busy > 0) {
            const mask_of<Real> active = now_.busy > Real(0.0);
            statistics.issued += width;
            statistics.useful += static_cast<std::uint64_t>(n_busy);
            self().advance(now_, cells_, active);
            n_busy = count(now_.busy > Real(0.0));
            if (n_busy < width) n_busy = refill(n_busy);
        }
        return statistics;
    }

protected:
    static constexpr int width = width_of<Real>;

    const ensemble_request& request_;

    HOPSCOTCH_DEVICE static double* lanes_of(Real& field) {
        return reinterpret_cast<double*>(&field);
    }
    HOPSCOTCH_DEVICE static const double* lanes_of(const Real& field) {
        return reinterpret_cast<const double*>(&field);
    }

    /// The lanes whose results are to be written.
    struct lane_list {
        int lanes[width];
        int n = 0;
        const std::uint64_t* cells;

        HOPSCOTCH_DEVICE lane_list(const Real& flags, const std::uint64_t* cells_of_lanes)
            : cells(cells_of_lanes) {
            for (int lane = 0; lane < width; ++lane) {
                lanes[n] = lane;
                n += lanes_of(flags)[lane] > 0.0 ? 1 : 0;
            }
        }
        /// Writes one field of these lanes to a layer; a layer that is null is not wanted.
        template <class Number>
        HOPSCOTCH_DEVICE void put(Number* layer, const Real& field) const {
            if (layer == nullptr) return;
            for (int i = 0; i < n; ++i) {
                layer[cells[lanes[i]]] = static_cast<Number>(lanes_of(field)[lanes[i]]);
            }
        }
    };

private:
    static constexpr int n_fields = static_cast<int>(sizeof(State) / sizeof(Real));

    std::uint64_t next_cell_ = 0;
    std::uint64_t last_cell_ = 0;
    State now_;
    State fresh_;  // prepared starts, taken lane by lane
    std::uint64_t cells_[width];
    std::uint64_t fresh_cells_[width];
    int fresh_first_ = 0;  // the next lane of fresh_ to take
    int fresh_left_ = 0;   // lanes of fresh_ not yet taken

    HOPSCOTCH_DEVICE Ensemble& self() { return static_cast<Ensemble&>(*this); }

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

        self().begin(fresh_, fresh_cells_, columns, parameters, is_cell);
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
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
