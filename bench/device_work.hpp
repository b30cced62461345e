// What the device benchmark computes: work cut into pieces that any number of threads draw, the
// same for GPUs and processors, and a sample of it whose operations are counted.
#pragma once

#include "bench/counted_kernels.hpp"
#include "host/run/backends.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace hopscotch::bench {

/// Tables and layers of one request; kept alive while it is computed.
struct request_memory {
    std::vector<std::vector<double>> numbers;
    std::vector<std::int16_t> label;
    std::vector<std::uint8_t> outcome;
    std::vector<std::uint32_t> returns;
    std::vector<double> state;
};

struct device_work_item {
    std::string name;
    std::string unit;  // "return" or "cell"
    const model_entry* model = nullptr;
    int variant = 0;
    double planned_in = 0.0;  // seconds, on the processor: a map's attractors
    std::size_t n_pieces = 1;
    /// A piece, with layers in the memory given.
    std::function<ensemble_request(std::size_t piece, request_memory&)> piece;
    /// Some cells of the whole work.
    std::function<ensemble_request(request_memory&)> sample;

    /// Cells, or returns completed.
    double units_of(const ensemble_request& request) const;
};

/// One return of the passive hopper from each of 2^24 starts.
device_work_item hopper_work(double mass_ratio);
/// Ten returns of the relief valve at tolerance 1e-10 from each of 2^22 settled states.
device_work_item valve_work();
/// A square map of a scene, by its first two axes: labels, outcomes and returns.
device_work_item scene_work(const std::string& name, const std::string& scene_file,
                            std::uint64_t cells_per_axis);

struct timed_work {
    double seconds = 0.0;
    double units = 0.0;
    lane_statistics lanes;

    double rate() const { return units / seconds; }
};

/// Wall time of the first n_pieces, drawn by n_threads threads.
timed_work time_work(const device_work_item& work, backend which, std::size_t n_pieces,
                     int n_threads);

/// Operations per unit.
counted_work count_per_unit(const device_work_item& work);

}  // namespace hopscotch::bench
