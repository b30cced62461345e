// Which layers a scene's map can have: results every model gives, the section's state, the model's
// extras. Names them, types them and describes them for the file.
#pragma once

#include "host/map/layout.hpp"
#include "host/scene/scene.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hopscotch {

/// What a layer shows, and so which result of the kernel fills it.
enum class layer_role : std::uint8_t {
    label,
    outcome,
    returns,
    events,
    time,
    period,
    immediate,
    state,
    extra,
    exponent,
    exponent_rate,
    exponent_error,
    exponent_returns,
    motion,
    uncertain,
    level,
    clearance,  // the roles from here on belong to one orbit watched in double
    hop_height,
    impact_speed,
    finite_exponent,
    failing_distance,  // follows from the finished map
};

struct layer_plan {
    layer description;
    layer_role role = layer_role::outcome;
    int index = 0;      // of the state column or extra
    std::string alias;  // the column's own name where the dataset's had to differ from an axis
};

/// Every layer that this scene can store.
std::vector<layer_plan> available_layers(const scene& scene);

/// The scene's own layers, in its order.
std::vector<layer_plan> chosen_layers(const scene& scene);

}  // namespace hopscotch
