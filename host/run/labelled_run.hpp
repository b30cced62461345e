// One kernel call with everything that decides labels: the kernel's own certificates and traps,
// then the chaotic sets, which are told by the last states.
#pragma once

#include "host/run/label_plan.hpp"
#include "host/scene/scene.hpp"
#include "kernels/ensemble/request.hpp"

#include <functional>

namespace hopscotch {

/// A kernel as its callers see it, whatever backend stands behind it.
using kernel_run = std::function<lane_statistics(const ensemble_request&)>;

/// Runs the request. Where the plan has chaotic sets, its label, outcome and returns must be
/// wanted.
lane_statistics run_labelled(const scene& scene, const label_plan& plan, const kernel_run& run,
                             const ensemble_request& request);

}  // namespace hopscotch
