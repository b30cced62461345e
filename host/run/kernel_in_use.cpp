// From the device to the processor.
#include "host/run/kernel_in_use.hpp"

#include <string>
#include <utility>

namespace hopscotch {

kernel_in_use::kernel_in_use(kernel_choice first, std::optional<kernel_choice> behind)
    : first_(std::move(first)), behind_(std::move(behind)) {}

lane_statistics kernel_in_use::run(const ensemble_request& request) {
    if (!has_failed_) {
        try {
            return first_.run(request);
        } catch (const device_error& error) {
            if (!behind_) throw device_error(std::string(error.what()) + "; --backend auto?");
            const std::lock_guard lock(mutex_);
            if (failure_.empty()) failure_ = error.what();  // the later ones follow from it
            has_failed_ = true;
        }
    }
    return behind_->run(request);
}

std::string kernel_in_use::backends() const {
    std::string names(name_of(first_.which));
    if (has_failed_) names += ", " + std::string(name_of(behind_->which));
    return names;
}

std::string kernel_in_use::failure() const {
    {
        const std::lock_guard lock(mutex_);
        if (!failure_.empty()) return failure_;
    }
    return first_.failures != nullptr ? first_.failures() : "";
}

std::string_view kernel_in_use::successor() const {
    return has_failed_ ? "the processor" : "the other devices";
}

kernel_in_use choose_kernel_for_map(const model_entry& model, int variant, std::string_view wanted,
                                    kernel_kind kind) {
    kernel_choice first = choose_kernel(model, variant, wanted, kind);
    const bool is_open = wanted.empty() || wanted == "auto";
    if (!is_open || !reason_against(model, backend::cuda, kind).empty())
        return kernel_in_use(std::move(first));
    return kernel_in_use(choose_kernel(model, variant, name_of(backend::cuda), kind),
                         std::move(first));
}

}  // namespace hopscotch
