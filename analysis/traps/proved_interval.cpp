// Adaptive subdivision of an interval, each part enclosed in mean-value form.
#include "analysis/traps/proved_interval.hpp"

#include "analysis/truth/interval.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hopscotch {
namespace {

constexpr double coarse = 0x1p-5;  // wider parts are cut while that may say more of their slopes
constexpr double narrowest = 0x1p-42;  // parts, relative to their place
constexpr double most_uncovered = 1e-10;

/// What the map does with a part of the interval.
struct image_of_part {
    enclosed_end end;
    interval values;
    interval slope;
    interval gain;  // f(x) - x
};

class interval_prover {
public:
    interval_prover(const map_point& map, double lowest, double highest, int most_pieces)
        : map_(map), low_(lowest), high_(highest), most_pieces_(most_pieces) {}

    std::optional<proved_interval> run() {
        if (!(low_ < high_) || map_.n_columns() != 1) return std::nullopt;
        why = contraction_verdict::not_contracting;
        if (!move_low() || !move_high()) return std::nullopt;
        result_ = {low_, high_, true, true, true, 0.0, 0};
        if (!cover()) return std::nullopt;
        result_.pieces = pieces_;
        return result_;
    }

    contraction_verdict why = contraction_verdict::not_supported;

private:
    const map_point& map_;
    double low_;
    double high_;
    int most_pieces_;
    int pieces_ = 0;
    proved_interval result_;

    image_of_part image(double from, double to) {
        ++pieces_;
        const double middle = from + 0.5 * (to - from);
        enclosed_query query{.section = map_.section,
                             .options = map_.options.data(),
                             .variant = map_.variant,
                             .parameters = map_.parameters};
        query.starts.n_columns = query.starts.n_directions = 1;
        query.starts.centre[0] = middle;
        query.starts.frame[0] = 1.0;
        query.starts.radius = from < to ? just_above(std::max(to - middle, middle - from)) : 0.0;
        const enclosed_returns returns = map_.model->orbits().enclose(query);
        image_of_part part{returns.end,
                           {returns.low[0], returns.high[0]},
                           {returns.slope_low[0], returns.slope_high[0]},
                           {}};
        const interval x = interval::point(middle);
        const interval reach{-query.starts.radius, query.starts.radius};
        const interval by_slope = interval{returns.centre_low[0], returns.centre_high[0]} - x +
                                  product_of_slopes(reach, part.slope - interval::point(1.0));
        const interval by_range = part.values - (x + reach);
        part.gain = {std::max(by_slope.low, by_range.low), std::min(by_slope.high, by_range.high)};
        return part;
    }

    /// Moves an end inward, by more every time, until `holds` of its image.
    template <class Condition>
    bool move(double& end, double inward, const Condition& holds) {
        const double start = end;
        const double length = high_ - low_;
        const double least = 0x1p-52 * std::max(std::abs(low_), std::abs(high_));
        for (double step = 0.0; step < 1e-3 * length; step = step == 0.0 ? least : 2.0 * step) {
            end = start + inward * step;
            const image_of_part at = image(end, end);
            if (at.end == enclosed_end::not_supported) {
                why = contraction_verdict::not_supported;
                return false;
            }
            if (at.end == enclosed_end::returned && holds(at.values, end)) return true;
        }
        return false;
    }
    bool move_low() {
        return move(low_, 1.0, [](const interval& values, double end) { return values.low > end; });
    }
    bool move_high() {
        return move(high_, -1.0, [this](const interval& values, double end) {
            return values.low > low_ && values.high < end;
        });
    }

    bool cover() {
        struct part {
            double from, to;
        };
        std::vector<part> parts{{low_, high_}};
        while (!parts.empty()) {
            const part now = parts.back();
            parts.pop_back();
            if (pieces_ >= most_pieces_) return false;
            const image_of_part at = image(now.from, now.to);
            if (at.end == enclosed_end::returned) {
                const bool stays = at.values.low >= low_ && at.values.high <= high_;
                const bool is_coarse = now.to - now.from > coarse * (high_ - low_);
                if (stays && (!is_coarse || tells_all(at))) {
                    note(at);
                    continue;
                }
                if (at.values.low > high_ || at.values.high < low_) return false;
                why = contraction_verdict::not_contracting;
            } else {
                why = at.end == enclosed_end::event_not_unique
                          ? contraction_verdict::event_not_unique
                          : contraction_verdict::undecided_comparison;
                if (at.end == enclosed_end::ended || at.end == enclosed_end::not_supported)
                    return false;
            }
            if (now.to - now.from <= narrowest * std::max(std::abs(now.from), std::abs(now.to))) {
                // an order of events begins or ends here; the parts beside it say where it leads
                if (at.end != enclosed_end::undecided_comparison) return false;
                result_.uncovered += now.to - now.from;
                if (result_.uncovered > most_uncovered * (high_ - low_)) return false;
                result_.is_monotone = result_.contracts = result_.only_falls = false;
                continue;
            }
            const double middle = now.from + 0.5 * (now.to - now.from);
            parts.push_back({middle, now.to});
            parts.push_back({now.from, middle});
        }
        return true;
    }

    /// Would a finer part only repeat what this one says?
    static bool tells_all(const image_of_part& at) {
        return at.slope.low > 0.0 && at.slope.high < 1.0 && at.gain.high <= 0.0;
    }
    void note(const image_of_part& at) {
        result_.is_monotone = result_.is_monotone && at.slope.low > 0.0;
        result_.contracts = result_.contracts && at.slope.size() < 1.0;
        result_.only_falls = result_.only_falls && at.gain.high <= 0.0;
    }
};

}  // namespace

std::optional<proved_interval> prove_interval_trap(const map_point& map, double lowest,
                                                   double highest, contraction_verdict* why,
                                                   int most_pieces) {
    interval_prover prover(map, lowest, highest, most_pieces);
    auto proved = prover.run();
    if (why != nullptr) *why = proved ? contraction_verdict::proved : prover.why;
    return proved;
}

}  // namespace hopscotch
