// Requests whose starts or fixed numbers are moved by a few roundings (or tolerances): the second
// look of the layer `uncertain`.
#pragma once

#include "host/run/answers.hpp"
#include "host/scene/scene.hpp"
#include "kernels/ensemble/request.hpp"

#include <cstddef>
#include <vector>

namespace hopscotch {

/// How far a number moves: 16 ulp of the larger of |x| and `scale`, and where a flow is integrated
/// to `tolerance` > 0 at least 100 tolerances of that size, ten times what a return may be off by.
/// The integrator's bound has a floor of 1/4 in the state's units (kernels/integrators/taylor.hpp):
/// state columns move by 100 (1/4 + size) tolerances. Parameters have units of their own; such a
/// floor would move a small one (an inertia of 2e-4) by far more than any error of the flow does.
double displacement_of(axis_kind kind, double x, double scale, double tolerance);

/// The same for a number on an axis. \param tolerance  of `tolerance_of`
double displacement_on(const scene_axis& axis, double x, double tolerance);

/// The tolerance that the scene's flows are integrated to; 0 where its variant integrates none.
double tolerance_of(const scene& scene);

/// How far apart the axis' cells are at x; 0 where all of them stand at one value.
double spacing_at(const scene_axis& axis, double x);

/// A start column or parameter that is no axis of the scene.
struct fixed_number {
    axis_kind kind;
    std::size_t index;
};

/// The fixed numbers that can be moved: not those that are zero, infinite or derived by the model,
/// which switch terms off.
std::vector<fixed_number> movable_numbers(const scene& scene, const ensemble_request& request);

/// A request whose starts are moved in one way, with the tables that it points to. Numbers that
/// would leave what is admissible stay.
class moved_request {
public:
    moved_request(const scene& scene, const ensemble_request& from, double tolerance)
        : scene_(scene), request_(without_results(from)), tolerance_(tolerance) {}

    ensemble_request& request() { return request_; }

    void move_axis(const scene_axis& axis, double sign);

    /// By a share of the distance between the axis' cells.
    void move_between_cells(const scene_axis& axis, double share);

    void move_fixed(const fixed_number& number, double sign);

private:
    column_source& source_of(axis_kind kind, std::size_t index);
    const range& valid_for(axis_kind kind, std::size_t index) const;

    /// \param by  from a number to how far it moves
    template <class Distance>
    void move(column_source& source, const range& valid, Distance by);

    const scene& scene_;
    ensemble_request request_;
    double tolerance_;
    std::vector<std::vector<double>> tables_;
};

}  // namespace hopscotch
