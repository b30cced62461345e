// The parts of reading a scene, in the order they run: each fills its members of the scene from its
// tables and may rely on the parts before it. Internal to host/scene.
#pragma once

#include "host/scene/scene.hpp"
#include "host/scene/table_reader.hpp"

namespace hopscotch {

void read_model(scene& scene, const table_reader& root, std::span<const model_entry* const> models);
void read_grid(scene& scene, const table_reader& root);
void read_sweep(scene& scene, const table_reader& root);
void read_start(scene& scene, const table_reader& root);
void read_question(scene& scene, const table_reader& root);
void read_accuracy(scene& scene, const table_reader& root);
void read_output(scene& scene, const table_reader& root);

/// Asks the model whether it accepts the parameters at every corner of the parameter axes.
void check_refusals(const scene& scene, const table_reader& root);

/// Why the model refuses the parameters at a corner of the parameter axes; empty where it does not.
/// `where` gets the parameters of that corner.
std::string_view refusal_of(const scene& scene, std::vector<double>* where = nullptr);

/// Sets the swept parameters and starts to these values, one per axis of the sweep.
void set_sweep_values(scene& scene, const std::vector<double>& values);

/// Hash of everything that decides the map's numbers (host/scene/fingerprint.cpp).
std::string fingerprint_of(const scene& scene);

}  // namespace hopscotch
