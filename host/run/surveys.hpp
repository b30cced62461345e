// The layers that a single orbit in double has to be watched for: clearances, impact speeds, the
// finite-time exponent. Paid for only where a scene asks for them.
#pragma once

#include "host/map/layout.hpp"
#include "host/scene/layers.hpp"
#include "host/scene/scene.hpp"
#include "kernels/ensemble/request.hpp"

#include <vector>

namespace hopscotch {

/// Does a layer come from watching orbits one by one?
bool is_surveyed(layer_role role);

/// Fills the surveyed layers of the cells of a request that has been computed: outcomes, returns
/// and, where there are labels, labels are read from it. An orbit is watched over its completed
/// returns and, where it fails or comes to rest, on to that end; cells whose start is invalid stay
/// NaN.
void fill_surveys(const scene& scene, const ensemble_request& request,
                  const std::vector<layer_plan>& layers,
                  std::vector<std::vector<std::byte>>& buffers);

}  // namespace hopscotch
