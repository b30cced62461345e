// The parts of reading a scene, in the order they run: each fills its members of the scene from its
// tables and may rely on the parts before it. Internal to host/scene.
#pragma once

#include "host/scene/scene.hpp"
#include "host/scene/table_reader.hpp"

namespace hopscotch {

void read_model(scene& scene, const table_reader& root, std::span<const model_entry* const> models);
void read_grid(scene& scene, const table_reader& root);
void read_start(scene& scene, const table_reader& root);
void read_question(scene& scene, const table_reader& root);
void read_accuracy(scene& scene, const table_reader& root);
void read_output(scene& scene, const table_reader& root);

/// Asks the model whether it accepts the parameters at every corner of the parameter axes.
void check_refusals(const scene& scene, const table_reader& root);

/// Hash of everything that decides the map's numbers (host/scene/fingerprint.cpp).
std::string fingerprint_of(const scene& scene);

}  // namespace hopscotch
