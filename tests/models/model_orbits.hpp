// A model's single orbits in every arithmetic, those of the library: a test that asks for them compiles no
// kernel of its own.
#pragma once

#include "analysis/orbit/orbit_functions.hpp"
#include "analysis/truth/decimal.hpp"
#include "analysis/truth/real50.hpp"
#include "kernels/contract/entry.hpp"

namespace hopscotch::testing_models {

template <class Model>
const orbit_functions& orbits_of() {
    return find_model(Model::info.name)->orbits();
}

}  // namespace hopscotch::testing_models
