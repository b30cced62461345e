// How sure a counted share is. Used wherever random cells are looked at: the audit, `verify`.
#pragma once

#include <cstdint>
#include <utility>

namespace hopscotch {

/// 95 % confidence interval of a share of which `hits` of `n` random draws were hit (Clopper and
/// Pearson 1934, Biometrika 26): covers the true share with at least that probability, whatever it
/// is. For cells drawn without repetition it errs on the wide side.
///
/// \return  lowest and highest share; 0 and 1 where nothing was drawn
std::pair<double, double> confidence_of(std::uint64_t hits, std::uint64_t n);

}  // namespace hopscotch
