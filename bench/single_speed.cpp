// Plain loops of a few models over AVX-512 packs of doubles and of floats.
#include "bench/single_speed.hpp"

#include "bench/single_pack.hpp"
#include "kernels/contract/model.hpp"
#include "kernels/models/mirror_planar.hpp"
#include "kernels/models/passive_hopper.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {
namespace {

template <class Real>
double sum_of(const Real& x) {
    double sum = 0.0;
    if constexpr (sizeof(Real) == sizeof(double) * static_cast<std::size_t>(width_of<Real>)) {
        for (int i = 0; i < width_of<Real>; ++i) sum += reinterpret_cast<const double*>(&x)[i];
    } else {
        for (int i = 0; i < width_of<Real>; ++i) sum += reinterpret_cast<const float*>(&x)[i];
    }
    return sum;
}

template <class Real>
Real loaded(const double* from) {
    using number = std::conditional_t<
        sizeof(Real) == sizeof(double) * static_cast<std::size_t>(width_of<Real>), double, float>;
    Real x;
    for (int i = 0; i < width_of<Real>; ++i)
        reinterpret_cast<number*>(&x)[i] = static_cast<number>(from[i]);
    return x;
}

template <class Model, class Real>
double all_returns(const double* const* columns, const double* numbers, std::size_t n) {
    constexpr int options[most_options] = {1};  // the planar juggler's solvable law
    double sum = 0.0;
    for (std::size_t first = 0; first < n; first += static_cast<std::size_t>(width_of<Real>)) {
        unwatched watch;
        Real start[most_columns];
        Real parameters[most_parameters];
        for (int c = 0; columns[c] != nullptr; ++c) start[c] = loaded<Real>(columns[c] + first);
        for (std::size_t p = 0; p < Model::info.parameters.size(); ++p)
            parameters[p] = Real(numbers[p]);
        lane_of<Model, 0, Real> lane;
        progress<Real> done = Model::template begin<0>(lane, 0, start, parameters, options, watch);
        mask_of<Real> open = !done.returned & (done.ended == Real(0.0));
        for (int step = 0; step < 64 && any(open); ++step) {
            done = Model::template step<0>(lane, open, watch);
            open = open & !done.returned & (done.ended == Real(0.0));
        }
        Real state[most_columns];
        Model::read_state(lane, 0, state);
        sum += sum_of(state[0]);
    }
    return sum;
}

template <class Model>
bench::plain_loop loops() {
    return {&all_returns<Model, pack<3>>, &all_returns<Model, single_pack<3>>};
}

}  // namespace
}  // namespace hopscotch::inline HOPSCOTCH_TARGET

namespace hopscotch::bench {

plain_loop plain_loop_of(std::string_view model) {
    if (model == "passive_hopper") return loops<passive_hopper>();
    if (model == "mirror_planar") return loops<mirror_planar>();
    return {};
}

}  // namespace hopscotch::bench
