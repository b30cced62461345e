// Quantiles of the beta distribution, which is what the tails of the binomial one add up to.
#include "host/run/confidence.hpp"

#include <boost/math/special_functions/beta.hpp>

namespace hopscotch {

std::pair<double, double> confidence_of(std::uint64_t hits, std::uint64_t n) {
    if (n == 0) return {0.0, 1.0};
    constexpr double tail = 0.025;  // on either side
    const auto hit = static_cast<double>(hits);
    const auto missed = static_cast<double>(n - hits);
    const double lowest = hits == 0 ? 0.0 : boost::math::ibeta_inv(hit, missed + 1.0, tail);
    const double highest = hits == n ? 1.0 : boost::math::ibetac_inv(hit + 1.0, missed, tail);
    return {lowest, highest};
}

}  // namespace hopscotch
