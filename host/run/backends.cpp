// Backends by name and by processor.
#include "host/run/backends.hpp"

#include <fmt/format.h>

#ifdef HOPSCOTCH_HAS_CUDA
#include "host/device/devices.hpp"
#endif

namespace hopscotch {
namespace {

bool runs_avx2() {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
           __builtin_cpu_supports("bmi2");
}

bool runs_avx512() {
    return runs_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
}

std::string reason_against_gpu() {
#ifdef HOPSCOTCH_HAS_CUDA
    return reason_against_devices();
#else
    return "this program is built without CUDA";
#endif
}

/// Where a backend tells of devices that it has lost.
std::string (*failures_of(backend which))() {
#ifdef HOPSCOTCH_HAS_CUDA
    if (which == backend::cuda) return &device_failures;
#endif
    static_cast<void>(which);
    return nullptr;
}

bool is_built(const model_entry& model, backend which, kernel_kind kind) {
    return kind == kernel_kind::plain ? model.has(which) : model.has_tangent(which);
}

}  // namespace

std::string reason_against(const model_entry& model, backend which, kernel_kind kind) {
    if (std::string reason = reason_against(which); !reason.empty()) return reason;
    if (is_built(model, which, kind)) return "";
    return fmt::format("{} is not built for it", model.info->name);
}

std::string reason_against(backend which) {
    switch (which) {
        case backend::scalar:
            return "";
        case backend::avx2:
            return runs_avx2() ? "" : "this processor has no AVX2";
        case backend::avx512:
            return runs_avx512() ? "" : "this processor has no AVX-512";
        case backend::cuda:
            return reason_against_gpu();
    }
    return "no such backend";
}

attribute_list attributes_of(backend which) {
    attribute_list attributes{{"backend", std::string(name_of(which))}};
#ifdef HOPSCOTCH_HAS_CUDA
    if (which == backend::cuda) {
        attributes.emplace_back("device", device_names());
        attributes.emplace_back("device_arithmetic", std::string(device_arithmetic()));
    }
#endif
    return attributes;
}

kernel_choice choose_kernel(const model_entry& model, int variant, std::string_view wanted,
                            kernel_kind kind) {
    const bool is_auto = wanted == "auto" || wanted.empty();
    for (const backend which : {backend::avx512, backend::avx2, backend::scalar, backend::cuda}) {
        if (is_auto ? which == backend::cuda : name_of(which) != wanted) continue;
        const std::string reason = reason_against(model, which, kind);
        if (reason.empty()) {
            return {which, variant,
                    kind == kernel_kind::plain ? model.kernel(which, variant)
                                               : model.tangent(which, variant),
                    failures_of(which)};
        }
        if (!is_auto) {
            throw device_error(fmt::format("--backend {} ({}); --backend auto?", wanted, reason));
        }
    }
    throw device_error(
        fmt::format("--backend {} (no kernel of {} for it); auto?", wanted, model.info->name));
}

}  // namespace hopscotch
