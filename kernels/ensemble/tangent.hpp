// The tangent ensemble: orbits with their tangent maps, exact through events because every lane is
// made of dual numbers, and from them Lyapunov exponents. Lanes are refilled as in the plain
// ensemble.
#pragma once

#include "kernels/ensemble/exponent_estimate.hpp"
#include "kernels/ensemble/refill.hpp"
#include "kernels/integrators/taylor.hpp"

#include <iterator>

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// Directions that a model's orbits carry: the most columns of any section that returns end on.
template <class Model>
constexpr int n_directions() {
    std::size_t most = 1;
    for (const section_info& section : Model::info.sections) {
        const auto& end = Model::info.sections[static_cast<std::size_t>(section.returns_to)];
        if (end.columns.size() > most) most = end.columns.size();
    }
    return static_cast<int>(most);
}

/// Columns of each section of a model: device code cannot read the description itself.
template <class Model>
struct section_sizes {
    int n_columns[Model::info.sections.size()] = {};

    constexpr section_sizes() {
        for (std::size_t s = 0; s < std::size(n_columns); ++s)
            n_columns[s] = static_cast<int>(Model::info.sections[s].columns.size());
    }
};

template <class Model, int Variant, class Real>
struct tangent_trajectory {
    static constexpr int n = n_directions<Model>();
    lane_of<Model, Variant, dual<Real, n>> motion;
    Real parameters[Model::info.parameters.size()];
    exponent_estimate<Real, n> estimate;
    Real returns;  // completed
    Real steps;    // of work since the last return
    Real busy;     // 1 while the lane holds an unfinished trajectory
};

/// \tparam Lanes  who keeps the lanes full, see refill.hpp
template <class Model, int Variant, class Real,
          template <class, class, class> class Lanes = refilled_lanes>
class tangent_ensemble : public Lanes<tangent_ensemble<Model, Variant, Real, Lanes>,
                                      tangent_trajectory<Model, Variant, Real>, Real> {
    using state = tangent_trajectory<Model, Variant, Real>;
    using lanes = Lanes<tangent_ensemble, state, Real>;
    static constexpr int n = state::n;
    using number = dual<Real, n>;
    using space = tangent_space<Model, Variant, Real, n>;

    /// Threads carry one direction at a time where series would fill their memory.
    static constexpr bool in_series = lanes_are_threads && integrates<Model, Variant, number>;

public:
    using lanes::lanes;

    /// What a thread keeps outside of its stack, and how much of it.
    using stored = dual<Real, 1>;
    static constexpr std::size_t workspace_bytes = in_series ? taylor::workspace_bytes<stored> : 0;

private:
    friend lanes;
    using lanes::lanes_of;
    using lanes::request_;

    /// One direction is looked after this often, in steps of the pack.
    static constexpr std::uint64_t steps_in_range = 8;
    std::uint64_t n_steps_ = 0;

    /// Every column starts a direction. A section that only starts orbits may have more columns
    /// than directions: they take turns.
    HOPSCOTCH_DEVICE void begin(state& at, const std::uint64_t* cells, const Real* columns,
                                const Real* parameters, const Real& is_cell) {
        const Real zero(0.0);
        number numbers[most_columns];
        for (int c = 0; c < most_columns; ++c) {
            numbers[c] = number(request_.columns[c].values != nullptr ? columns[c] : zero);
        }
        space::seed(numbers, request_.exponents, zero == zero);
        for (std::size_t p = 0; p < std::size(at.parameters); ++p) at.parameters[p] = parameters[p];
        at.returns = at.steps = zero;
        at.busy = is_cell;
        at.estimate.begin(request_.exponents);
        const progress<number> done =
            place(at.motion, request_.section, numbers, at.parameters, request_.options);
        settle(at, cells, done, is_cell > zero);
    }

    /// Two callers, one copy of the model's code.
    [[gnu::noinline]] HOPSCOTCH_DEVICE progress<number> place(
        typename space::lane& at, int section, const number (&columns)[most_columns],
        const Real (&parameters)[Model::info.parameters.size()], const int* options) const {
        take_tolerance<Model, Variant, number>(at, request_.tolerance);
        number constants[most_parameters];
        for (std::size_t p = 0; p < std::size(parameters); ++p)
            constants[p] = number(parameters[p]);
        unwatched watch;
        return Model::template begin<Variant>(at, section, columns, constants, options, watch);
    }

    HOPSCOTCH_DEVICE void advance(state& at, const std::uint64_t* cells, mask_of<Real> active) {
        if constexpr (in_series && n > 1) {
            settle(at, cells, space::step_one_by_one(at.motion, active), active);
        } else {
            unwatched watch;
            settle(at, cells, Model::template step<Variant>(at.motion, active, watch), active);
        }
    }

    /// One direction of a cheap map costs little beside calls: what every step does becomes one
    /// stretch of code (bench/lyapunov: twice as fast), what few steps do is called. Compilers take
    /// minutes over that where the map integrates or has many cases.
    [[gnu::flatten]] HOPSCOTCH_DEVICE void advance(
        state& at, const std::uint64_t* cells,
        mask_of<Real> active) requires(n == 1 && Variant < cheap_variants_of<Model>) {
        unwatched watch;
        settle(at, cells, Model::template step<Variant>(at.motion, active, watch), active);
    }

    HOPSCOTCH_DEVICE void settle(state& at, const std::uint64_t* cells,
                                 const progress<number>& done, mask_of<Real> active) {
        const Real zero(0.0);
        const Real one(1.0);
        const mask_of<Real> returned = active & done.returned;
        at.returns = select(returned, at.returns + one, at.returns);
        at.steps = select(returned, zero, at.steps + one);
        exponent_estimate<Real, n>& estimate = at.estimate;
        estimate.until_boundary =
            select(returned, estimate.until_boundary - one, estimate.until_boundary);
        const mask_of<Real> boundary = returned & (estimate.until_boundary == zero);
        mask_of<Real> precise = boundary;
        if constexpr (n == 1) {
            if (++n_steps_ % steps_in_range == 0) keep_in_range(at);
            if (any(boundary)) precise = book_growth(at, boundary);
        } else {
            if (any(returned)) precise = book_growth(at, returned, boundary);
        }
        const mask_of<Real> spent = active & (at.steps >= Real(request_.max_steps));
        const mask_of<Real> full =
            active & (at.returns >= Real(static_cast<double>(request_.max_returns)));
        Real ended = select(active, primal(done.ended), zero);
        const mask_of<Real> finished = full | precise | spent | !(ended == zero);
        if (!any(finished)) return;
        ended = select(spent & (ended == zero), code_of<Real>(outcome::budget), ended);
        write(at, ended, cells, select(finished, one, zero));
        at.busy = select(finished, zero, at.busy);
    }

    [[gnu::noinline]] HOPSCOTCH_DEVICE void keep_in_range(state& at) const requires(n == 1) {
        space::keep_in_range(at.motion, request_.end_section, at.estimate.doublings[0]);
    }

    /// Books the blocks that end; gives the lanes whose estimate is done.
    [[gnu::noinline]] HOPSCOTCH_DEVICE mask_of<Real> book_growth(
        state& at, const mask_of<Real>& boundary) requires(n == 1) {
        Real sizes[n];
        sizes[0] = space::size_of(at.motion, request_.end_section);
        const mask_of<Real> vanished =
            boundary & !(at.estimate.has_begun > Real(0.0)) & (sizes[0] == Real(0.0));
        if (any(vanished)) {
            number columns[most_columns];
            space::read(at.motion, request_.end_section, columns);
            sow(at, vanished, columns, sizes);
            renew(at, vanished, columns);
        }
        at.estimate.book(request_.exponents, boundary, sizes, primal(at.motion.time));
        return boundary & at.estimate.is_precise(request_.exponents);
    }

    /// The same for several directions, which are kept apart at every return.
    [[gnu::noinline]] HOPSCOTCH_DEVICE mask_of<Real> book_growth(
        state& at, const mask_of<Real>& returned, const mask_of<Real>& boundary) requires(n > 1) {
        Real sizes[n];
        number columns[most_columns];
        space::read(at.motion, request_.end_section, columns);
        space::keep_free(columns, request_.exponents);
        space::orthogonalise(columns, returned, at.estimate.doublings, sizes);
        const mask_of<Real> first = boundary & !(at.estimate.has_begun > Real(0.0));
        if (any(first)) sow(at, first & has_vanished(sizes), columns, sizes);
        renew(at, returned, columns);
        if (!any(boundary)) return boundary;
        at.estimate.book(request_.exponents, boundary, sizes, primal(at.motion.time));
        return boundary & at.estimate.is_precise(request_.exponents);
    }

    /// Has a direction of the section been lost on the way (at a critical point, say)?
    HOPSCOTCH_DEVICE mask_of<Real> has_vanished(const Real (&sizes)[n]) const {
        constexpr section_sizes<Model> of;
        const int n_columns = of.n_columns[request_.end_section];
        mask_of<Real> vanished = sizes[0] == Real(0.0);
        for (int k = 1; k < n && k < n_columns; ++k) {
            vanished = vanished | (sizes[k] == Real(0.0));
        }
        return vanished;
    }

    /// New directions along the columns.
    HOPSCOTCH_DEVICE void sow(state& at, const mask_of<Real>& where,
                              number (&columns)[most_columns], Real (&sizes)[n]) const {
        space::seed(columns, request_.exponents, where);
        for (int k = 0; k < n; ++k) {
            sizes[k] = select(where, Real(1.0), sizes[k]);
            at.estimate.doublings[k] = select(where, Real(0.0), at.estimate.doublings[k]);
        }
    }

    /// Gives the lane the slopes of its columns.
    HOPSCOTCH_DEVICE void renew(state& at, const mask_of<Real>& where,
                                const number (&columns)[most_columns]) const {
        typename space::lane begun;
        const progress<number> done =
            place(begun, request_.end_section, columns, at.parameters, request_.options);
        space::take_slopes(at.motion, begun, where, !(primal(done.ended) == Real(0.0)));
    }

    [[gnu::noinline]] HOPSCOTCH_DEVICE void write(const state& at, const Real& ended,
                                                  const std::uint64_t* cells,
                                                  const Real& flags) const {
        const Real nan = not_a_number<Real>();
        const typename lanes::lane_list finished(flags, cells);
        finished.put(request_.outcome, ended);
        finished.put(request_.returns, at.returns);
        finished.put(request_.events, primal(at.motion.events));
        finished.put(request_.time, primal(at.motion.time));

        const exponent_request& to = request_.exponents;
        const exponent_result<Real, n> result = at.estimate.conclude(to);
        const mask_of<Real> goes_on = ended == Real(0.0);  // to the end of what was asked
        const auto put = [&](double* layer, const Real& value) {
            finished.put(layer, select(goes_on, value, nan));
        };
        for (int k = 0; k < n; ++k) put(to.exponents[k], result.exponents[k]);
        put(to.rate, result.rate);
        put(to.standard_error, result.standard_error);
        finished.put(to.returns, select(goes_on, result.returns, Real(0.0)));
        finished.put(to.motion, select(goes_on, result.motion, at.estimate.code(motion::ended)));

        number columns[most_columns];
        space::read(at.motion, request_.end_section, columns);
        for (int c = 0; c < most_columns; ++c) finished.put(request_.state[c], columns[c].value);
        number extras[most_extras];
        for (number& extra : extras) extra = number(0.0);
        Model::read_extras(at.motion, extras);
        for (int e = 0; e < most_extras; ++e) finished.put(request_.extras[e], extras[e].value);
    }
};

/// The tangent ensemble of one model variant: what a backend's table points to.
template <class Model, int Variant, class Real>
requires model < Model, dual < Real, n_directions<Model>()
>> lane_statistics run_tangent_ensemble(const ensemble_request& request) {
    ensemble_request complete = request;
    complete.end_section =
        Model::info.sections[static_cast<std::size_t>(request.section)].returns_to;
    tangent_ensemble<Model, Variant, Real> lanes(complete);
    return lanes.run(0, request.n_cells);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
