// Lanes that never idle: a finished trajectory's lane takes the next cell at once, and starts are
// prepared a full pack at a time. The base of every ensemble loop (loop.hpp, tangent.hpp).
#pragma once

#include "kernels/contract/model.hpp"
#include "kernels/ensemble/request.hpp"
#include "kernels/lanes/lane.hpp"

#include <bit>
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
///                   trajectory. Where it has a State::n_parameter_fields, that many leading
///                   fields follow from the parameters and options alone.
template <class Ensemble, class State, class Real>
class refilled_lanes {
public:
    HOPSCOTCH_DEVICE explicit refilled_lanes(const ensemble_request& request) : request_(request) {}

    /// Computes cells [first, last) and returns how full the lanes were.
    HOPSCOTCH_DEVICE lane_statistics run(std::uint64_t first, std::uint64_t last) {
        next_cell_ = first;
        last_cell_ = last;
        first_moved_ = n_common_fields();
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
        std::uint32_t bits;  // one per lane
        const std::uint64_t* cells;

        HOPSCOTCH_DEVICE lane_list(mask_of<Real> where, const std::uint64_t* cells_of_lanes)
            : bits(lane_bits(where)), cells(cells_of_lanes) {}
        HOPSCOTCH_DEVICE lane_list(const Real& flags, const std::uint64_t* cells_of_lanes)
            : lane_list(flags > Real(0.0), cells_of_lanes) {}

        /// Writes one field of these lanes to a layer; a layer that is null is not wanted.
        template <class Number>
        HOPSCOTCH_DEVICE void put(Number* layer, const Real& field) const {
            if (layer == nullptr) return;
            for (std::uint32_t left = bits; left != 0; left &= left - 1) {
                const int lane = std::countr_zero(left);
                layer[cells[lane]] = static_cast<Number>(lanes_of(field)[lane]);
            }
        }
    };

private:
    static constexpr std::uint32_t all_lanes = (std::uint64_t{1} << width) - 1;
    static constexpr int n_fields = static_cast<int>(sizeof(State) / sizeof(Real));

    std::uint64_t next_cell_ = 0;
    std::uint64_t last_cell_ = 0;
    State now_;
    State fresh_;  // prepared starts, taken lane by lane
    std::uint64_t cells_[width];
    std::uint64_t fresh_cells_[width];
    int first_moved_ = 0;  // the fields before it hold the same numbers in every lane
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
        mask_of<Real> exists;
        set_lanes(exists, (std::uint64_t{1} << n) - 1);
        const Real is_cell = select(exists, Real(1.0), Real(0.0));
        next_cell_ += static_cast<std::uint64_t>(n);

        self().begin(fresh_, fresh_cells_, columns, parameters, is_cell);
        gather_fresh();
        Real* to = reinterpret_cast<Real*>(&now_);
        const Real* from = reinterpret_cast<const Real*>(&fresh_);
        for (int f = 0; f < first_moved_; ++f) to[f] = from[f];
    }

    /// The fields that follow from the parameters, where no parameter varies from cell to cell.
    HOPSCOTCH_DEVICE int n_common_fields() const {
        for (const column_source& parameter : request_.parameters) {
            if (parameter.size > 1) return 0;
        }
        if constexpr (requires { State::n_parameter_fields; }) return State::n_parameter_fields;
        return 0;
    }

    /// Moves the prepared starts that go on to the front of the pack.
    HOPSCOTCH_DEVICE void gather_fresh() {
        int kept = 0;
        for (std::uint32_t left = lane_bits(fresh_.busy > Real(0.0)); left != 0; left &= left - 1) {
            const int lane = std::countr_zero(left);
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
            constexpr auto all = static_cast<std::uint64_t>(width);
            if (within + all <= source[c].stride) {
                columns[c] = Real(source[c].values[index]);
                continue;
            }
            if (source[c].stride == 1 && index + all <= source[c].size) {
                const double* first = source[c].values + index;
                for (int lane = 0; lane < width; ++lane) lanes_of(columns[c])[lane] = first[lane];
                continue;
            }
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
        std::uint32_t chosen = all_lanes & ~lane_bits(now_.busy > Real(0.0));
        std::uint32_t beyond = chosen;  // idle lanes after the first n
        for (int i = 0; i < n && n < wanted; ++i) beyond &= beyond - 1;
        if (n < wanted) chosen &= ~beyond;
        mask_of<Real> where;
        set_lanes(where, chosen);
        fill_lanes(cells_, where, fresh_cells_ + fresh_first_);
        Real* to = reinterpret_cast<Real*>(&now_);
        const Real* from = reinterpret_cast<const Real*>(&fresh_);
        for (int f = first_moved_; f < n_fields; ++f)
            fill_lanes(to[f], where, lanes_of(from[f]) + fresh_first_);
        fresh_first_ += n;
        fresh_left_ -= n;
        return n;
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
