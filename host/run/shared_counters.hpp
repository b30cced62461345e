// Counters that all processes of a run raise, each operation at once and whole. A sweep keeps in
// them which tiles of which map are drawn and done.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hopscotch {

class shared_counters {
public:
    virtual ~shared_counters() = default;

    /// Raises a counter; its value before. From any thread.
    virtual std::uint64_t add(std::size_t counter, std::uint64_t amount) = 0;

    std::uint64_t read(std::size_t counter) { return add(counter, 0); }
};

/// Those of one process.
class local_counters : public shared_counters {
public:
    explicit local_counters(std::size_t n) : counters_(n) {}
    std::uint64_t add(std::size_t counter, std::uint64_t amount) override {
        return counters_.at(counter).fetch_add(amount);
    }

private:
    std::vector<std::atomic<std::uint64_t>> counters_;
};

}  // namespace hopscotch
