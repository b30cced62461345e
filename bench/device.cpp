// How fast is a GPU, which share of its double-precision rate is that, and how many times the
// processors of the same machine? Passive hopper's returns, the quickstart's cells (computed, not
// written), relief valve at tolerance 1e-10, a 16384 x 16384 map of the runner with gravity in
// stance. Operations are counted everywhere; without a device nothing is timed. Usage: device
// SCENE_DIR
#include "bench/device_work.hpp"
#include "bench/report.hpp"

#include <algorithm>
#include <thread>

#include <fmt/format.h>

#ifdef HOPSCOTCH_HAS_CUDA
#include "host/device/devices.hpp"
#endif

namespace hopscotch::bench {
namespace {

constexpr int exit_skipped = 77;

/// \param cells  per axis of the maps
std::vector<device_work_item> all_work(const std::string& scenes, std::uint64_t cells) {
    return {hopper_work(1.0), hopper_work(20.0), valve_work(),
            scene_work("quickstart", scenes + "/quickstart.toml", cells),
            scene_work("slip with gravity in stance",
                       scenes + "/ghigliazza2005_gravity_basins.toml", cells)};
}

void show_counts(const device_work_item& work, const counted_work& each) {
    fmt::print(
        "{:<30} per {}: {:.1f} fused, {:.1f} sums, products and comparisons, {:.2f} divisions, "
        "{:.2f} square roots: {:.0f} instructions\n",
        work.name, work.unit, each.fused, each.plain, each.divisions, each.square_roots,
        each.slots());
}

/// Fused multiply-adds per second of all devices.
double peak_rate() {
    double rate = 0.0;
#ifdef HOPSCOTCH_HAS_CUDA
    device_runtime& runtime = cuda_devices();
    for (int device = 0; device < runtime.n_devices(); ++device) {
        const device_description is = runtime.describe(device);
        rate += is.clock_hertz * is.n_multiprocessors * is.binary64_per_multiprocessor;
    }
#endif
    return rate;
}

std::string name_of_devices() {
#ifdef HOPSCOTCH_HAS_CUDA
    return device_names();
#else
    return "";
#endif
}

/// The widest processor backend that the model is built for.
backend best_of_processor(const model_entry& model) {
    return choose_kernel(model, 0, "auto").which;
}

/// Pieces that take the processors a few seconds, at least one.
std::size_t fair_share(const device_work_item& work, backend which, int n_threads) {
    const timed_work one = time_work(work, which, 1, 1);
    const double wanted = 4.0 * n_threads / one.seconds;
    return std::clamp<std::size_t>(static_cast<std::size_t>(wanted), 1, work.n_pieces);
}

void measure(const device_work_item& work, const counted_work& each) {
    constexpr int device_threads = 4;  // one more than a device has workers
    const int n_threads = static_cast<int>(std::thread::hardware_concurrency());
    time_work(work, backend::cuda, std::min<std::size_t>(work.n_pieces, 8), device_threads);
    std::vector<double> rates, seconds;
    timed_work on_device;
    for (int round = 0; round < 3; ++round) {
        on_device = time_work(work, backend::cuda, work.n_pieces, device_threads);
        rates.push_back(on_device.rate());
        seconds.push_back(on_device.seconds);
    }
    const backend processor = best_of_processor(*work.model);
    const std::size_t share = fair_share(work, processor, n_threads);
    const double processor_rate = time_work(work, processor, share, n_threads).rate();
    const double rate = median(rates);
    const double of_peak = rate * each.slots() / peak_rate();
    fmt::print(
        "{:<30} {:.3g} {}s per second, {:.2f} s, {:.0f} % of the double-precision rate, warps "
        "{:.0f} % full, {:.0f} times {} on {} threads\n",
        work.name, rate, work.unit, median(seconds), 100.0 * of_peak,
        100.0 * on_device.lanes.efficiency(), rate / processor_rate, name_of(processor), n_threads);
    json_line("device")
        .add("device", name_of_devices())
        .add("work", work.name)
        .add("unit", work.unit)
        .add("units_per_second", rate)
        .add("seconds", median(seconds))
        .add("seconds_planning", work.planned_in)
        .add("units", on_device.units)
        .add("instructions_per_unit", each.slots())
        .add("flops_per_unit", each.flops())
        .add("share_of_binary64_rate", of_peak)
        .add("warp_efficiency", on_device.lanes.efficiency())
        .add("processor_backend", name_of(processor))
        .add("processor_threads", static_cast<double>(n_threads))
        .add("processor_units_per_second", processor_rate)
        .add("ratio", rate / processor_rate)
        .print();
}

int run(const std::string& scenes) {
    const std::string reason = reason_against(backend::cuda);
    for (const device_work_item& work : all_work(scenes, reason.empty() ? 16384 : 256)) {
        const counted_work each = count_per_unit(work);
        show_counts(work, each);
        if (reason.empty()) measure(work, each);
    }
    if (reason.empty()) return 0;
    fmt::print("device: nothing is timed ({})\n", reason);
    return exit_skipped;
}

}  // namespace
}  // namespace hopscotch::bench

int main(int argc, char** argv) {
    if (argc != 2) {
        fmt::print(stderr, "usage: device SCENE_DIR\n");
        return 2;
    }
    return hopscotch::bench::run(argv[1]);
}
