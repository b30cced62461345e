// Workers and the pieces they get.
#include "host/device/device_pool.hpp"

#include "host/run/device_error.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <utility>

#include <fmt/format.h>

namespace hopscotch {

/// A worker that nobody else has; it comes back idle, whatever happens.
class device_pool::lease {
public:
    lease(device_pool& pool, device_worker* worker) : pool_(&pool), worker_(worker) {}
    ~lease() {
        if (worker_ == nullptr) return;
        if (is_busy_) worker_->abandon();
        pool_->give_back(worker_);
    }
    lease(lease&& other) noexcept
        : pool_(other.pool_),
          worker_(std::exchange(other.worker_, nullptr)),
          is_busy_(other.is_busy_) {}
    lease& operator=(lease&&) = delete;

    explicit operator bool() const { return worker_ != nullptr; }
    std::uint64_t most_cells(const device_layout& layout) const {
        return worker_->most_cells(layout);
    }
    void begin(const device_kernel& kernel, const device_layout& layout, cell_piece piece) {
        is_busy_ = true;
        worker_->begin(kernel, layout, piece);
    }
    lane_statistics finish(const device_layout& layout) {
        const lane_statistics lanes = worker_->finish(layout);
        is_busy_ = false;
        return lanes;
    }

private:
    device_pool* pool_;
    device_worker* worker_;
    bool is_busy_ = false;
};

device_pool::device_pool(device_runtime& runtime, const device_limits& limits) : limits_(limits) {
    const int n_devices = runtime.n_devices();
    if (n_devices == 0) throw device_error("there is no CUDA device");
    for (int device = 0; device < n_devices; ++device) {
        const device_description description = runtime.describe(device);
        names_.push_back(description.name);
        // half of what is free: the stacks of the kernels' threads take some as well
        const auto n = static_cast<std::size_t>(limits.workers_per_device);
        const device_share share{
            .bytes = std::min(limits.most_bytes, description.free_bytes / 2) / n,
            .workspace_bytes =
                std::min(limits.most_workspace_bytes, description.free_bytes / 8) / n,
            .of_workers = n};
        for (std::size_t i = 0; i < n; ++i) {
            workers_.push_back(std::make_unique<device_worker>(runtime, device, share));
        }
    }
    // handed out from the back: the first requests go to different devices
    const auto per_device = static_cast<std::size_t>(limits.workers_per_device);
    for (std::size_t i = 0; i < per_device; ++i) {
        for (std::size_t w = i; w < workers_.size(); w += per_device) {
            free_.push_back(workers_[w].get());
        }
    }
}

device_worker* device_pool::take(bool waits) {
    std::unique_lock lock(mutex_);
    if (waits) is_free_.wait(lock, [&] { return !free_.empty(); });
    if (free_.empty()) return nullptr;
    device_worker* const worker = free_.back();
    free_.pop_back();
    return worker;
}

void device_pool::give_back(device_worker* worker) {
    {
        const std::lock_guard lock(mutex_);
        free_.insert(free_.begin(), worker);
    }
    is_free_.notify_one();
}

lane_statistics device_pool::run(const device_kernel& kernel, const ensemble_request& request) {
    const device_layout layout(request);
    const std::uint64_t fair = request.n_cells / (2 * workers_.size()) + 1;
    const std::uint64_t wanted = std::max(fair, limits_.least_cells);
    lane_statistics lanes;
    std::uint64_t next = 0;
    std::deque<lease> at_work;
    const auto send = [&](lease& worker) {
        const std::uint64_t n =
            std::min({wanted, worker.most_cells(layout), request.n_cells - next});
        worker.begin(kernel, layout, {next, n});
        next += n;
    };
    while (next < request.n_cells || !at_work.empty()) {
        while (next < request.n_cells) {
            lease worker(*this, take(at_work.empty()));
            if (!worker) break;
            at_work.push_back(std::move(worker));
            send(at_work.back());
        }
        lanes += at_work.front().finish(layout);
        if (next < request.n_cells) {
            at_work.push_back(std::move(at_work.front()));
            at_work.pop_front();
            send(at_work.back());
        } else {
            at_work.pop_front();
        }
    }
    return lanes;
}

std::string device_pool::names() const {
    std::map<std::string, int> counts;
    for (const std::string& name : names_) ++counts[name];
    std::string text;
    for (const auto& [name, n] : counts) {
        if (!text.empty()) text += ", ";
        text += n > 1 ? fmt::format("{} x {}", n, name) : name;
    }
    return text;
}

}  // namespace hopscotch
