// Workers and the pieces they get.
#include "host/device/device_pool.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <utility>

#include <fmt/format.h>

namespace hopscotch {
namespace {

/// The cells of a request that nobody computes yet.
class open_cells_of {
public:
    explicit open_cells_of(std::uint64_t n_cells) : n_cells_(n_cells) {}

    bool is_empty() const { return next_ == n_cells_ && again_.empty(); }

    cell_piece take(std::uint64_t most) {
        if (again_.empty()) {
            const cell_piece piece{next_, std::min(most, n_cells_ - next_)};
            next_ += piece.n;
            return piece;
        }
        cell_piece& left = again_.back();
        const cell_piece piece{left.first, std::min(most, left.n)};
        left.first += piece.n;
        left.n -= piece.n;
        if (left.n == 0) again_.pop_back();
        return piece;
    }
    void put_back(cell_piece piece) { again_.push_back(piece); }

private:
    std::uint64_t n_cells_;
    std::uint64_t next_ = 0;
    std::vector<cell_piece> again_;  // of devices that have failed
};

}  // namespace

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
          piece_(other.piece_),
          is_busy_(other.is_busy_) {}
    lease& operator=(lease&&) = delete;

    explicit operator bool() const { return worker_ != nullptr; }

    /// Sends a piece off, or leaves it to the other devices.
    void begin(const device_kernel& kernel, const device_layout& layout, std::uint64_t wanted,
               open_cells_of& open) {
        piece_ = open.take(std::min(wanted, worker_->most_cells(layout)));
        is_busy_ = true;
        try {
            worker_->begin(kernel, layout, piece_);
        } catch (const device_error& error) {
            fail(error, open);
        }
    }
    /// Its results, or none where the device has failed.
    lane_statistics finish(const device_layout& layout, open_cells_of& open) {
        lane_statistics lanes;
        if (!is_busy_) return lanes;
        try {
            lanes = worker_->finish(layout);
            is_busy_ = false;
        } catch (const device_error& error) {
            fail(error, open);
        }
        return lanes;
    }

private:
    device_pool* pool_;
    device_worker* worker_;
    cell_piece piece_;
    bool is_busy_ = false;

    void fail(const device_error& error, open_cells_of& open) {
        pool_->retire(*worker_, error);
        worker_->abandon();
        is_busy_ = false;
        open.put_back(piece_);
    }
};

device_pool::device_pool(device_runtime& runtime, const device_limits& limits)
    : limits_(limits), devices_(static_cast<std::size_t>(runtime.n_devices())) {
    if (devices_.empty()) throw device_error("there is no CUDA device");
    for (std::size_t i = 0; i < devices_.size(); ++i) {
        try {
            open(runtime, static_cast<int>(i));
        } catch (const device_error& error) {
            devices_[i].workers.clear();
            devices_[i].failure = error.what();
        }
    }
    if (n_working() == 0) throw device_error(failures_so_far());
    // handed out from the back: the first requests go to different devices
    for (std::size_t i = 0; i < static_cast<std::size_t>(limits.workers_per_device); ++i) {
        for (device& each : devices_) {
            if (each.failure.empty()) free_.push_back(each.workers[i].get());
        }
    }
}

void device_pool::open(device_runtime& runtime, int number) {
    device& opened = devices_[static_cast<std::size_t>(number)];
    const device_description description = runtime.describe(number);
    opened.name = description.name;
    // half of what is free: the stacks of the kernels' threads take some as well
    const auto n = static_cast<std::size_t>(limits_.workers_per_device);
    const device_share share{
        .bytes = std::min(limits_.most_bytes, description.free_bytes / 2) / n,
        .workspace_bytes = std::min(limits_.most_workspace_bytes, description.free_bytes / 8) / n,
        .of_workers = n};
    for (std::size_t i = 0; i < n; ++i) {
        opened.workers.push_back(std::make_unique<device_worker>(runtime, number, share));
    }
}

/// A worker of a device that works; nullptr where none is free and the caller does not wait.
device_worker* device_pool::take(bool waits) {
    std::unique_lock lock(mutex_);
    if (waits) is_free_.wait(lock, [&] { return !free_.empty() || n_working() == 0; });
    if (waits && free_.empty()) throw device_error(failures_so_far());
    if (free_.empty()) return nullptr;
    device_worker* const worker = free_.back();
    free_.pop_back();
    return worker;
}

void device_pool::give_back(device_worker* worker) {
    {
        const std::lock_guard lock(mutex_);
        if (!devices_[static_cast<std::size_t>(worker->device())].failure.empty()) return;
        free_.insert(free_.begin(), worker);
    }
    is_free_.notify_one();
}

/// No worker of this one's device is handed out any more.
void device_pool::retire(const device_worker& worker, const device_error& error) {
    {
        const std::lock_guard lock(mutex_);
        std::string& failure = devices_[static_cast<std::size_t>(worker.device())].failure;
        if (failure.empty()) failure = error.what();  // the later ones follow from it
        std::erase_if(free_,
                      [&](const device_worker* each) { return each->device() == worker.device(); });
    }
    is_free_.notify_all();
}

std::size_t device_pool::n_working() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(devices_, [](const device& each) { return each.failure.empty(); }));
}

lane_statistics device_pool::run(const device_kernel& kernel, const ensemble_request& request) {
    const device_layout layout(request);
    const auto n_workers = static_cast<std::uint64_t>(limits_.workers_per_device) * devices_.size();
    const std::uint64_t wanted =
        std::max(request.n_cells / (2 * n_workers) + 1, limits_.least_cells);
    lane_statistics lanes;
    open_cells_of open(request.n_cells);
    std::deque<lease> at_work;
    while (!open.is_empty() || !at_work.empty()) {
        while (!open.is_empty()) {
            lease worker(*this, take(at_work.empty()));
            if (!worker) break;
            worker.begin(kernel, layout, wanted, open);
            at_work.push_back(std::move(worker));
        }
        lanes += at_work.front().finish(layout, open);
        at_work.pop_front();
    }
    return lanes;
}

std::string device_pool::names() const {
    std::map<std::string, int> counts;
    for (const device& each : devices_) {
        if (!each.name.empty()) ++counts[each.name];
    }
    std::string text;
    for (const auto& [name, n] : counts) {
        if (!text.empty()) text += ", ";
        text += n > 1 ? fmt::format("{} x {}", n, name) : name;
    }
    return text;
}

std::string device_pool::failures() const {
    const std::lock_guard lock(mutex_);
    return failures_so_far();
}

std::string device_pool::failures_so_far() const {
    std::string text;
    for (std::size_t i = 0; i < devices_.size(); ++i) {
        if (devices_[i].failure.empty()) continue;
        if (!text.empty()) text += ", ";
        text += fmt::format("device {}: {}", i, devices_[i].failure);
    }
    return text;
}

}  // namespace hopscotch
