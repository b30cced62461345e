// The global attributes that a map carries: all that is needed to know what it shows and to compute
// it again. And the way back: the scene of a map on disk.
#pragma once

#include "host/map/layout.hpp"
#include "host/run/backends.hpp"
#include "host/scene/scene.hpp"
#include "host/store/map_reader.hpp"

namespace hopscotch {

/// Known before the run.
attribute_list attributes_of(const scene& scene, const kernel_choice& kernel);

/// The scene that a map was computed from.
/// \error store_error where the map holds none, scene_error where this program reads it differently
scene scene_of(const map_reader& map, std::span<const model_entry* const> models = all_models());
scene scene_of(const attribute_list& attributes,
               std::span<const model_entry* const> models = all_models());

}  // namespace hopscotch
