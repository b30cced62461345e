// The kernel of a run. Where the user has left the choice open, a GPU comes first, and when it
// fails the processor goes on: the bits are the same, and the map says so.
#pragma once

#include "host/run/backends.hpp"

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace hopscotch {

class kernel_in_use {
public:
    /// \param behind  takes over for good when the first one throws a device_error
    explicit kernel_in_use(kernel_choice first, std::optional<kernel_choice> behind = std::nullopt);

    /// Thread safe. \error device_error where nothing stands behind
    lane_statistics run(const ensemble_request& request);

    const kernel_choice& first() const { return first_; }

    /// "avx512", or "cuda, avx512" after a failure.
    std::string backends() const;
    /// What the runtime of a device has said that has failed; empty where all is well.
    std::string failure() const;
    /// Who has gone on after it: "the processor", or "the other devices".
    std::string_view successor() const;

private:
    kernel_choice first_;
    std::optional<kernel_choice> behind_;
    std::atomic<bool> has_failed_ = false;
    mutable std::mutex mutex_;
    std::string failure_;
};

/// The kernel for a whole map: with `auto` a GPU, where this machine has one and the model is built
/// for it, and the processor behind it. \error device_error as choose_kernel
kernel_in_use choose_kernel_for_map(const model_entry& model, int variant, std::string_view wanted,
                                    kernel_kind kind);

}  // namespace hopscotch
