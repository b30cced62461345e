// Deals devices to ranks.
#include "host/mpi/device_of_rank.hpp"

#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <vector>

namespace hopscotch {
namespace {

/// The node's devices where nothing restricts them: "0,1,2".
std::string all_devices() {
    std::string list;
    std::error_code missing;
    int n = 0;
    for (std::filesystem::directory_iterator each("/proc/driver/nvidia/gpus", missing), end;
         !missing && each != end; each.increment(missing)) {
        if (n > 0) list += ',';
        list += std::to_string(n++);
    }
    return list;
}

}  // namespace

std::string device_of_rank(std::string_view visible, int rank_in_node) {
    std::vector<std::string_view> devices;
    while (!visible.empty()) {
        const std::size_t comma = std::min(visible.find(','), visible.size());
        devices.push_back(visible.substr(0, comma));
        visible.remove_prefix(std::min(comma + 1, visible.size()));
    }
    if (devices.empty()) return {};
    return std::string(devices[static_cast<std::size_t>(rank_in_node) % devices.size()]);
}

void choose_device(int rank_in_node) {
    const char* given = std::getenv("CUDA_VISIBLE_DEVICES");
    const std::string device =
        device_of_rank(given != nullptr ? given : all_devices(), rank_in_node);
    if (!device.empty()) ::setenv("CUDA_VISIBLE_DEVICES", device.c_str(), 1);
}

}  // namespace hopscotch
