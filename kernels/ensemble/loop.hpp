// The ensemble loop: advances trajectories until they are decided and writes out their results;
// refill.hpp keeps the lanes full. The same functions, over cuda/persistent_lane.hpp, are what a
// GPU thread runs.
#pragma once

#include "kernels/ensemble/refill.hpp"
#include "kernels/ensemble/traps.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// A trajectory and what the loop itself keeps of it. Only Real members, so that a lane is a column
/// of doubles in memory.
template <class Model, int Variant, class Real>
struct trajectory {
    lane_of<Model, Variant, Real> motion;
    Real returns;  // completed
    Real steps;    // of work since the last return
    Real busy;     // 1 while the lane holds an unfinished trajectory

    static constexpr int n_parameter_fields = parameter_fields_of<Model>;
};

/// \tparam Lanes  who keeps the lanes full, see refill.hpp
template <class Model, int Variant, class Real,
          template <class, class, class> class Lanes = refilled_lanes>
class ensemble
    : public Lanes<ensemble<Model, Variant, Real, Lanes>, trajectory<Model, Variant, Real>, Real> {
    using state = trajectory<Model, Variant, Real>;
    using lanes = Lanes<ensemble, state, Real>;

public:
    using lanes::lanes;

private:
    friend lanes;
    using lanes::lanes_of;
    using lanes::request_;
    using lanes::width;

    HOPSCOTCH_DEVICE void begin(state& at, const std::uint64_t* cells, const Real* columns,
                                const Real* parameters, const Real& is_cell) {
        unwatched watch;
        at.returns = at.steps = Real(0.0);
        at.busy = is_cell;
        take_tolerance<Model, Variant, Real>(at.motion, request_.tolerance);
        const progress<Real> done = Model::template begin<Variant>(
            at.motion, request_.section, columns, parameters, request_.options, watch);
        settle(at, cells, done, is_cell > Real(0.0));
    }

    HOPSCOTCH_DEVICE void advance(state& at, const std::uint64_t* cells, mask_of<Real> active) {
        unwatched watch;
        const progress<Real> done = Model::template step<Variant>(at.motion, active, watch);
        settle(at, cells, done, active);
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
        if (request_.decided_by == decision::returns && request_.died_label == 0) {
            finish(at, cells, zero, ended, active & (full | !(ended == zero)));
            return;
        }
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
        finish(at, cells, label, ended, finished);
    }

    HOPSCOTCH_DEVICE void finish(state& at, const std::uint64_t* cells, const Real& label,
                                 const Real& ended, mask_of<Real> finished) {
        if (!any(finished)) return;
        write(at, label, ended, cells, finished);
        at.busy = select(finished, Real(0.0), at.busy);
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
            const auto point = static_cast<std::uint64_t>(request_.trap_point.at(0));
            const trap_ellipsoid* traps =
                request_.ellipsoids + point * static_cast<std::uint64_t>(request_.n_ellipsoids);
            for (int i = request_.n_ellipsoids; i-- > 0;) {
                const trap_ellipsoid& trap = traps[i];
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
                                const std::uint64_t* cells, mask_of<Real> where) const {
        const ensemble_request& to = request_;
        const typename lanes::lane_list finished(where, cells);
        finished.put(to.label, label);
        finished.put(to.outcome, ended);
        finished.put(to.returns, at.returns);
        finished.put(to.events, at.motion.events);
        finished.put(to.time, at.motion.time);
        if (is_wanted(to.state)) {
            Real columns[most_columns];
            Model::read_state(at.motion, to.end_section, columns);
            for (int c = 0; c < most_columns; ++c) finished.put(to.state[c], columns[c]);
        }
        if (is_wanted(to.extras)) {
            Real extras[most_extras];
            Model::read_extras(at.motion, extras);
            for (int e = 0; e < most_extras; ++e) finished.put(to.extras[e], extras[e]);
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
