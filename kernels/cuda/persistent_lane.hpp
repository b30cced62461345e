// The ensemble loop of a GPU thread: it draws cells from a counter until none is left. The threads
// of a warp stay together: they step together, and those without a cell wait for a few others
// before new starts are computed. Host code may run it too, with a warp of its own making.
#pragma once

#include "kernels/contract/model.hpp"
#include "kernels/cuda/device_work.hpp"
#include "kernels/cuda/thread_workspace.hpp"
#include "kernels/lanes/scalar.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// What a persistent thread asks of its warp. Every member but `width` is called by all threads of
/// the warp together.
///
///     int width                  threads of the warp
///     int count(bool)            in how many of them it is true
///     std::uint64_t draw(bool)   a number of its own for each thread that wants one; the others
///                                get the next number to be drawn, or an earlier one
///     void book(lane_statistics) adds the warp's statistics to the launch's
template <class Warp>
concept warp = requires(Warp& threads, bool flag, const lane_statistics& statistics) {
    { threads.count(flag) } -> std::same_as<int>;
    { threads.draw(flag) } -> std::same_as<std::uint64_t>;
    threads.book(statistics);
    { Warp::width } -> std::convertible_to<int>;
};

/// Gives a thread its part of the launch's workspace.
template <class Lanes>
HOPSCOTCH_DEVICE inline void open_workspace(const device_work& work, unsigned thread) {
    if constexpr (Lanes::workspace_bytes > 0) {
        using space = thread_workspace<typename Lanes::stored>;
        space::open(work.workspace, Lanes::workspace_bytes, thread);
    }
}

/// One lane without a prepared pack: the base of the ensemble loops where a lane is a thread.
/// Offers what refilled_lanes (ensemble/refill.hpp) offers to the class derived from it.
template <class Ensemble, class State, class Real>
class persistent_lane {
    static_assert(width_of<Real> == 1);

public:
    static constexpr std::size_t workspace_bytes = 0;  // unless the ensemble says otherwise

    HOPSCOTCH_DEVICE explicit persistent_lane(const ensemble_request& request)
        : request_(request) {}

    /// Draws and computes cells first_cell + [0, n_cells) together with all other threads.
    template <warp Warp>
    HOPSCOTCH_DEVICE void run(std::uint64_t first_cell, std::uint64_t n_cells, Warp& threads) {
        // new starts are worth the wait of the others when a quarter of the warp idles
        constexpr int enough_idle = Warp::width < 4 ? 1 : Warp::width / 4;
        lane_statistics statistics;
        now_.busy = Real(0.0);
        bool has_more = true;
        while (true) {
            int n_busy = threads.count(is_busy());
            while (has_more && Warp::width - n_busy >= enough_idle) {
                const bool wants = !is_busy();
                const std::uint64_t number = threads.draw(wants);
                if (wants && number < n_cells) start(first_cell + number);
                n_busy = threads.count(is_busy());
                has_more = threads.count(wants && number >= n_cells) == 0;
            }
            if (n_busy == 0) break;
            statistics.issued += Warp::width;
            statistics.useful += static_cast<std::uint64_t>(n_busy);
            if (is_busy()) self().advance(now_, &cell_, true);
        }
        threads.book(statistics);
    }

protected:
    static constexpr int width = 1;

    const ensemble_request& request_;

    HOPSCOTCH_DEVICE static double* lanes_of(Real& field) { return &field; }
    HOPSCOTCH_DEVICE static const double* lanes_of(const Real& field) { return &field; }

    /// The lane, where its results are to be written.
    struct lane_list {
        bool is_wanted;
        std::uint64_t cell;

        HOPSCOTCH_DEVICE lane_list(bool where, const std::uint64_t* cells)
            : is_wanted(where), cell(*cells) {}
        HOPSCOTCH_DEVICE lane_list(double flag, const std::uint64_t* cells)
            : lane_list(flag > 0.0, cells) {}

        template <class Number>
        HOPSCOTCH_DEVICE void put(Number* layer, double field) const {
            if (layer != nullptr && is_wanted) layer[cell] = static_cast<Number>(field);
        }
    };

private:
    State now_;
    std::uint64_t cell_ = 0;

    HOPSCOTCH_DEVICE Ensemble& self() { return static_cast<Ensemble&>(*this); }
    HOPSCOTCH_DEVICE bool is_busy() const { return now_.busy > Real(0.0); }

    HOPSCOTCH_DEVICE void start(std::uint64_t cell) {
        Real columns[most_columns];
        Real parameters[most_parameters];
        cell_ = cell;
        load(columns, request_.columns, most_columns);
        load(parameters, request_.parameters, most_parameters);
        self().begin(now_, &cell_, columns, parameters, Real(1.0));
    }

    HOPSCOTCH_DEVICE void load(Real* numbers, const column_source* source, int n) const {
        for (int i = 0; i < n; ++i) {
            if (source[i].values == nullptr) break;
            numbers[i] = source[i].size == 1 ? source[i].values[0] : source[i].at(cell_);
        }
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
