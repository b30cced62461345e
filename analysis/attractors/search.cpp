// The search for attractors of one return map.
#include "analysis/attractors/search.hpp"

#include "analysis/attractors/exponents.hpp"
#include "analysis/attractors/settle.hpp"
#include "analysis/periodic/return_equation.hpp"
#include "analysis/traps/checked_trap.hpp"
#include "analysis/traps/proved_trap.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hopscotch {
namespace {

constexpr std::int16_t died = 1;
constexpr double same_orbit = 1e-6;      // of the columns' scale
constexpr double near_return = 0.3;      // of the columns' scale: worth a Newton iteration
constexpr double neutral_margin = 1e-9;  // of a multiplier's modulus from 1

double largest_modulus(const std::vector<std::complex<double>>& multipliers) {
    double largest = 0.0;
    for (const auto& multiplier : multipliers) largest = std::max(largest, std::abs(multiplier));
    return largest;
}

class searcher {
public:
    searcher(const map_point& map, int section, std::span<const double> scale,
             const search_limits& limits, std::vector<found_attractor> known)
        : map_(map),
          section_(section),
          n_(static_cast<std::size_t>(map.n_columns())),
          scale_(scale.begin(), scale.end()),
          limits_(limits) {
        result_.attractors = std::move(known);
        is_late_ = !result_.attractors.empty();
    }

    attractor_search run(std::span<const double> starts) {
        result_.n_starts =
            starts.size() / map_.model->info->sections[std::size_t(section_)].columns.size();
        take_open(settle(map_, section_, starts, limits_.transient, decision::ellipsoids,
                         all_traps(), died));
        choose_free();
        if (limits_.wants_unstable) look_for_low_periods(starts);
        look_for_cycles();
        go_on(limits_.returns);
        look_for_cycles();
        look_for_chaos();
        result_.n_open = open_.size() / n_;
        std::sort(result_.attractors.begin(), result_.attractors.end());
        return std::move(result_);
    }

private:
    using state = std::span<const double>;

    std::vector<trap_ellipsoid> all_traps() const {
        std::vector<trap_ellipsoid> traps;
        for (const found_attractor& attractor : result_.attractors) {
            for (trap_ellipsoid trap : attractor.traps) {
                trap.label = died + 1;
                traps.push_back(trap);
            }
        }
        return traps;
    }

    /// Keeps the states of orbits that went on for all returns and were not caught.
    void take_open(const settled_orbits& orbits) {
        open_.clear();
        for (std::size_t i = 0; i < orbits.size(); ++i) {
            if (orbits.end_of(i) != outcome::budget || orbits.returns[i] == 0) continue;
            const state at = orbits.state_of(i);
            const bool is_finite =
                std::all_of(at.begin(), at.end(), [](double x) { return std::isfinite(x); });
            if (is_finite) open_.insert(open_.end(), at.begin(), at.end());
        }
    }
    void go_on(std::uint32_t returns) {
        if (open_.empty()) return;
        take_open(
            settle(map_, map_.section, open_, returns, decision::ellipsoids, all_traps(), died));
    }
    std::size_t n_open() const { return open_.size() / n_; }
    std::vector<double> open_state(std::size_t i) const {
        return {open_.begin() + std::ptrdiff_t(i * n_),
                open_.begin() + std::ptrdiff_t((i + 1) * n_)};
    }
    bool is_caught(const std::vector<double>& x, std::uint32_t returns) const {
        const std::vector<trap_ellipsoid> traps = all_traps();
        return settle(map_, map_.section, x, returns, decision::ellipsoids, traps, died).label[0] >
               0;
    }

    void choose_free() {
        constexpr std::size_t most = 16;
        const std::size_t n = std::min(n_open(), most);
        const std::vector<int> conserved =
            conserved_everywhere(map_, state(open_).first(n * n_)).value_or(std::vector<int>{});
        for (int c = 0; c < static_cast<int>(n_); ++c) {
            if (std::find(conserved.begin(), conserved.end(), c) == conserved.end())
                free_.push_back(c);
        }
    }

    double distance(state a, state b) const { return distance_of(map_, a, b, scale_); }
    bool is_same(state points, state others) const {
        if (points.size() != others.size()) return false;
        for (std::size_t i = 0; i < others.size(); i += n_) {
            if (distance(points.first(n_), others.subspan(i, n_)) < same_orbit) return true;
        }
        return false;
    }
    bool is_known(const periodic_orbit& orbit) const {
        return std::any_of(result_.attractors.begin(), result_.attractors.end(),
                           [&](const found_attractor& other) {
                               return other.kind == attractor_kind::cycle &&
                                      is_same(orbit.points, other.points);
                           }) ||
               std::any_of(result_.unstable.begin(), result_.unstable.end(),
                           [&](const periodic_orbit& other) {
                               return is_same(orbit.points, other.points);
                           });
    }

    /// Books a periodic orbit; true where it is a new attractor.
    bool book(const periodic_orbit& orbit) {
        if (is_known(orbit)) return false;
        if (!(largest_modulus(orbit.multipliers) < 1.0 - neutral_margin)) {
            result_.unstable.push_back(orbit);
            return false;
        }
        found_attractor found;
        found.period = orbit.period;
        found.points = orbit.points;
        found.multipliers = orbit.multipliers;
        Eigen::VectorXd scale(static_cast<Eigen::Index>(free_.size()));
        for (std::size_t i = 0; i < free_.size(); ++i) {
            scale(static_cast<Eigen::Index>(i)) = scale_[std::size_t(free_[i])];
        }
        for (std::size_t i = 0; i < orbit.points.size(); i += n_) {
            add_trap(found, {state(orbit.points).subspan(i, n_), orbit.period, free_, scale});
        }
        found.is_late = is_late_;
        result_.attractors.push_back(std::move(found));
        return true;
    }

    /// The proved trap of one point of a cycle, or the checked one where there is no proof.
    void add_trap(found_attractor& found, const trap_site& site) const {
        constexpr int longest_proved = 16;
        if (limits_.wants_proofs && site.period <= longest_proved) {
            std::array<bool, most_columns> is_fixed{};
            for (std::size_t c = 0; c < n_; ++c) {
                is_fixed[c] =
                    std::find(free_.begin(), free_.end(), static_cast<int>(c)) == free_.end();
            }
            // a proof's cost grows with the period, and so does the number of proofs
            const trap_search effort = site.period <= 2
                                           ? trap_search{}
                                           : trap_search{.most_pieces = 4, .most_reshapings = 0};
            const auto proved = largest_trap({.map = &map_,
                                              .period = site.period,
                                              .point = site.centre,
                                              .is_fixed = std::span(is_fixed.data(), n_)},
                                             nullptr, effort);
            if (proved) return found.traps.push_back(proved->trap);
        }
        found.is_proved = false;
        if (const auto trap = checked_trap(map_, site, limits_.is_quick))
            found.traps.push_back(*trap);
    }

    /// Fixed points and cycles of period 2 next to the starts and their first images, stable or
    /// not.
    void look_for_low_periods(std::span<const double> starts) {
        constexpr std::size_t most = 48;
        for (const std::uint32_t returns : {1u, 4u}) {
            const settled_orbits orbits = settle(map_, section_, starts, returns);
            std::size_t n_tried = 0;
            for (std::size_t i = 0; i < orbits.size() && n_tried < most; ++i) {
                if (orbits.end_of(i) != outcome::ok) continue;
                ++n_tried;
                for (const int period : {1, 2}) {
                    if (const auto orbit = refine(orbits.state_of(i), period)) book(*orbit);
                }
            }
        }
    }

    /// The periodic orbit next to a state, its smallest point first.
    std::optional<periodic_orbit> refine(state guess, int period) const {
        auto orbit =
            refine_periodic_orbit(map_, guess, period, {.free_columns = free_, .scale = scale_});
        if (!orbit) return orbit;
        int smallest = 0;
        for (int i = 1; i < orbit->period; ++i) {
            if (std::ranges::lexicographical_compare(orbit->point(i), orbit->point(smallest))) {
                smallest = i;
            }
        }
        std::rotate(orbit->points.begin(),
                    orbit->points.begin() + smallest * static_cast<std::ptrdiff_t>(n_),
                    orbit->points.end());
        return orbit;
    }

    /// Periods after which the orbit comes back closer than ever before.
    std::vector<int> candidate_periods(const std::vector<double>& x) const {
        std::vector<int> periods;
        std::vector<double> at = x;
        double closest = near_return;
        for (int p = 1; p <= limits_.longest_period; ++p) {
            const settled_orbits next = settle(map_, map_.section, at, 1);
            if (next.end_of(0) != outcome::ok) break;
            at.assign(next.state.begin(), next.state.end());
            const double d = distance(at, x);
            if (!(d < closest)) continue;
            periods.push_back(p);
            closest = 0.5 * d;
        }
        return periods;
    }

    void look_for_cycles() {
        int n_failed = 0;
        std::size_t next = 0;
        while (next < n_open() && n_failed < limits_.most_attempts) {
            const std::vector<double> x = open_state(next);
            bool is_new = false;
            for (const int period : candidate_periods(x)) {
                const auto orbit = refine(x, period);
                if (!orbit || !book(*orbit)) continue;
                is_new = true;
                if (is_caught(x, limits_.returns)) break;
            }
            if (is_new) {
                go_on(limits_.transient);
                next = 0;
            } else {
                ++next;
                ++n_failed;
            }
        }
    }

    void look_for_chaos() {
        constexpr int most_failures = 16;  // in which neither chaos nor a cycle is found
        int n_failed = 0;
        for (std::size_t i = 0; i < n_open() && n_failed < most_failures; ++i) {
            const std::vector<double> x = open_state(i);
            if (is_covered(x)) continue;
            const int n_blocks = limits_.is_quick ? 16 : 32;
            const int block = limits_.is_quick ? 32 : 64;
            orbit_exponents exponents = exponents_of(map_, x, free_, n_blocks, block);
            const bool is_open = exponents.is_complete && !exponents.is_negative();
            if (is_open && !exponents.is_chaotic()) {  // weak chaos in bands, or shear
                exponents = exponents_of(map_, x, free_, n_blocks, 8 * block);
            }
            if (!exponents.is_chaotic()) {
                ++n_failed;
                continue;
            }
            add_chaotic(exponents);
        }
        std::vector<double> left;
        for (std::size_t i = 0; i < n_open(); ++i) {
            const std::vector<double> x = open_state(i);
            if (!is_covered(x)) left.insert(left.end(), x.begin(), x.end());
        }
        open_ = std::move(left);
    }

    bool is_covered(state x) const {
        return std::any_of(result_.attractors.begin(), result_.attractors.end(),
                           [&](const found_attractor& other) { return other.cover.holds(x); });
    }

    /// Samples the set that an orbit fills, from many of its states at once.
    std::vector<double> samples_from(const orbit_exponents& exponents) const {
        const int n_returns = limits_.is_quick ? 64 : 640;
        std::vector<double> samples;
        std::vector<double> at = exponents.visited;
        for (int i = 0; i < n_returns; ++i) {
            const settled_orbits next = settle(map_, map_.section, at, 1);
            for (std::size_t k = 0; k < next.size(); ++k) {
                if (next.end_of(k) != outcome::ok) return {};
            }
            at = next.state;
            samples.insert(samples.end(), at.begin(), at.end());
        }
        return samples;
    }

    /// Covers the set; one that lies on a set known before is the same, seen for longer.
    void add_chaotic(const orbit_exponents& exponents) {
        std::vector<double> samples = samples_from(exponents);
        if (samples.empty()) return;
        found_attractor found;
        found.kind = attractor_kind::chaotic;
        found.period = 0;
        found.exponent = exponents.mean[0];
        found.exponent_error = exponents.error[0];
        found.is_proved = false;
        found.is_late = is_late_;
        std::erase_if(result_.attractors, [&](const found_attractor& other) {
            if (other.kind != attractor_kind::chaotic || !overlap(other.cover, samples))
                return false;
            samples.insert(samples.end(), other.samples.begin(), other.samples.end());
            found.is_late = found.is_late && other.is_late;
            return true;
        });
        found.cover = state_cover(samples, static_cast<int>(n_));
        found.points.assign(found.cover.lowest().begin(), found.cover.lowest().end());
        found.points.insert(found.points.end(), found.cover.highest().begin(),
                            found.cover.highest().end());
        found.samples = std::move(samples);
        result_.attractors.push_back(std::move(found));
    }

    /// More than one sample in a hundred lies on the cover.
    bool overlap(const state_cover& cover, state samples) const {
        std::size_t n_inside = 0;
        for (std::size_t i = 0; i < samples.size(); i += n_) {
            if (cover.holds(samples.subspan(i, n_))) ++n_inside;
        }
        return 100 * n_inside > samples.size() / n_;
    }

    const map_point& map_;
    int section_;
    std::size_t n_;
    std::vector<double> scale_;
    search_limits limits_;
    bool is_late_ = false;  // this search comes after another one
    std::vector<int> free_;
    std::vector<double> open_;  // [state][column]: not caught yet
    attractor_search result_;
};

}  // namespace

bool found_attractor::operator<(const found_attractor& other) const {
    if (is_late != other.is_late) return other.is_late;
    if (kind != other.kind) return kind == attractor_kind::cycle;
    if (period != other.period) return period < other.period;
    return points < other.points;
}

std::optional<std::vector<int>> conserved_everywhere(const map_point& map,
                                                     std::span<const double> states) {
    const auto n = static_cast<std::size_t>(map.n_columns());
    std::optional<std::vector<int>> conserved;
    for (std::size_t i = 0; i + n <= states.size() && n > 1; i += n) {
        const auto x = states.subspan(i, n);
        if (map.jet(x.data()).end != outcome::ok) continue;
        const std::vector<int> here = conserved_columns(map, x);
        if (!conserved) conserved = here;
        std::erase_if(*conserved, [&](int column) {
            return std::find(here.begin(), here.end(), column) == here.end();
        });
    }
    return conserved;
}

attractor_search search_attractors(const map_point& map, int section,
                                   std::span<const double> starts, std::span<const double> scale,
                                   const search_limits& limits,
                                   std::vector<found_attractor> known) {
    return searcher(map, section, scale, limits, std::move(known)).run(starts);
}

}  // namespace hopscotch
