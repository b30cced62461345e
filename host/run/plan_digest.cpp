// Mixes a plan's numbers into one word.
#include "host/run/plan_digest.hpp"

#include <bit>
#include <concepts>

#include <fmt/format.h>

namespace hopscotch {
namespace {

class digest {
public:
    void add(std::integral auto number) {
        word_ ^= static_cast<std::uint64_t>(number) + 0x9e3779b97f4a7c15ull;
        word_ = (word_ ^ (word_ >> 30)) * 0xbf58476d1ce4e5b9ull;  // splitmix64's finaliser
        word_ = (word_ ^ (word_ >> 27)) * 0x94d049bb133111ebull;
        word_ ^= word_ >> 31;
    }
    void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
    void add(const trap_interval& trap) {
        add(trap.lowest);
        add(trap.highest);
        add(trap.label);
    }
    void add(const trap_ellipsoid& trap) {
        add(trap.n_columns);
        add(trap.label);
        const auto n = static_cast<std::size_t>(trap.n_columns);
        for (std::size_t i = 0; i < n; ++i) add(trap.centre[i]);
        for (std::size_t i = 0; i < n * n; ++i) add(trap.shape[i]);
    }
    void add(const chaotic_set& set) {
        add(set.point);
        add(set.label);
        add(set.cover.lowest());
        add(set.cover.highest());
        add(set.cover.boxes_along());
        add(set.cover.box_places());
    }
    void add(const attractor_row& row) {
        add(row.label);
        add(row.period);
        add(row.points);
    }
    template <class List>
    requires requires(const List& list) { list.size(), list.begin(); }
    void add(const List& list) {
        add(list.size());
        for (const auto& each : list) add(each);
    }

    std::uint64_t word() const { return word_; }

private:
    std::uint64_t word_ = 0;
};

}  // namespace

std::string plan_digest(const label_plan& plan) {
    digest all;
    all.add(static_cast<int>(plan.decided_by));
    all.add(plan.died_label);
    all.add(plan.point_axes);
    all.add(plan.n_traps);
    all.add(plan.traps);
    all.add(plan.n_ellipsoids);
    all.add(plan.ellipsoids);
    all.add(plan.chaotic);
    all.add(plan.n_immediate);
    all.add(plan.immediate);
    all.add(plan.conserved);
    all.add(plan.attractors);
    return fmt::format("{:016x}", all.word());
}

}  // namespace hopscotch
