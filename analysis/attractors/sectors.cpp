// Samples rays at geometric and then even distances, all of a ray at once, and bisects its end.
#include "analysis/attractors/sectors.hpp"

#include "analysis/attractors/settle.hpp"
#include "analysis/periodic/periodic_orbit.hpp"

#include <algorithm>
#include <cmath>

namespace hopscotch {
namespace {

constexpr int n_plane_rays = 16;
constexpr int n_near = 40;  // from 1e-8 on, geometric
constexpr int n_far = 400;  // even
constexpr double nearest_distance = 1e-8;
constexpr double near_limit = 1e-2;

std::vector<std::vector<double>> ray_directions(const sector_question& of) {
    const std::size_t n = of.point.size();
    std::vector<std::vector<double>> rays;
    if (of.free.size() == 2) {
        for (int k = 0; k < n_plane_rays; ++k) {
            const double angle = 2.0 * M_PI * k / n_plane_rays;
            std::vector<double> ray(n, 0.0);
            ray[std::size_t(of.free[0])] = std::cos(angle);
            ray[std::size_t(of.free[1])] = std::sin(angle);
            rays.push_back(std::move(ray));
        }
        return rays;
    }
    for (const int column : of.free) {
        for (const double sign : {-1.0, 1.0}) {
            std::vector<double> ray(n, 0.0);
            ray[std::size_t(column)] = sign;
            rays.push_back(std::move(ray));
        }
    }
    return rays;
}

class ray_walk {
public:
    ray_walk(const map_point& map, const sector_question& of, const std::vector<double>& ray)
        : map_(map), of_(of), ray_(ray) {}

    /// Which of the distances lie in the orbit's basin.
    std::vector<bool> attracted(std::span<const double> distances) const {
        const settled_orbits orbits = settle(map_, map_.section, starts(distances), of_.returns,
                                             decision::ellipsoids, of_.traps);
        std::vector<bool> is_attracted(orbits.size());
        for (std::size_t i = 0; i < orbits.size(); ++i) {
            is_attracted[i] = orbits.label[i] == of_.label;
        }
        return is_attracted;
    }

    /// |P^p(x) - x*| and |P^p(x) - x| in the scale, x = x* + d u; NaN where the orbit fails.
    struct moved {
        double from_point = std::nan("");
        double from_start = std::nan("");
    };
    moved image(double d) const {
        const std::vector<double> start = starts(std::span(&d, 1));
        const settled_orbits next =
            settle(map_, map_.section, start, static_cast<std::uint32_t>(of_.period));
        if (next.end_of(0) != outcome::ok) return {};
        return {distance_of(map_, next.state_of(0), of_.point, of_.scale),
                distance_of(map_, next.state_of(0), start, of_.scale)};
    }

    double last_attracted(double inside, double outside) const {
        while (outside - inside > 1e-13 * outside) {
            std::vector<double> between;  // a pack of points at once narrows faster than halving
            constexpr int n = 15;
            for (int i = 1; i <= n; ++i) {
                between.push_back(inside + (outside - inside) * i / (n + 1.0));
            }
            const std::vector<bool> in = attracted(between);
            const auto first_out = std::find(in.begin(), in.end(), false) - in.begin();
            if (first_out < n) outside = between[std::size_t(first_out)];
            if (first_out > 0) inside = between[std::size_t(first_out - 1)];
        }
        return inside;
    }

private:
    std::vector<double> starts(std::span<const double> distances) const {
        std::vector<double> result;
        for (const double d : distances) {
            for (std::size_t c = 0; c < ray_.size(); ++c) {
                result.push_back(of_.point[c] + d * ray_[c] * of_.scale[c]);
            }
        }
        return result;
    }

    const map_point& map_;
    const sector_question& of_;
    const std::vector<double>& ray_;
};

stability_sector walked(const map_point& map, const sector_question& of,
                        const std::vector<double>& ray) {
    const ray_walk walk(map, of, ray);
    std::vector<double> distances;
    for (int i = 0; i < n_near; ++i) {
        distances.push_back(nearest_distance * std::pow(near_limit / nearest_distance,
                                                        static_cast<double>(i) / n_near));
    }
    for (int i = 0; i <= n_far; ++i) {
        distances.push_back(near_limit + (of.farthest - near_limit) * i / n_far);
    }
    const std::vector<bool> in = walk.attracted(distances);
    stability_sector sector{.direction = ray};
    const auto first_out =
        static_cast<std::size_t>(std::find(in.begin(), in.end(), false) - in.begin());
    sector.attracts = first_out >= n_near / 2;
    sector.is_bounded = first_out < in.size();
    if (!sector.is_bounded) {
        sector.extent = of.farthest;
    } else if (first_out > 0) {
        sector.extent = walk.last_attracted(distances[first_out - 1], distances[first_out]);
    }
    constexpr double close = 1e-6;
    constexpr double far = 1e-5;
    const ray_walk::moved near = walk.image(close);
    const ray_walk::moved further = walk.image(far);
    sector.exponent = std::log(further.from_point / near.from_point) / std::log(far / close);
    sector.coefficient = near.from_point / std::pow(close, sector.exponent);
    sector.step_exponent = std::log(further.from_start / near.from_start) / std::log(far / close);
    sector.step_coefficient = near.from_start / std::pow(close, sector.step_exponent);
    const bool stays =
        near.from_start <= neutral_step * close && further.from_start <= neutral_step * far;
    sector.kind = sector.attracts ? side_kind::attracting
                  : stays         ? side_kind::neutral
                                  : side_kind::repelling;
    return sector;
}

}  // namespace

std::vector<stability_sector> sectors_of(const map_point& map, const sector_question& of) {
    std::vector<stability_sector> sectors;
    for (const std::vector<double>& ray : ray_directions(of)) {
        sectors.push_back(walked(map, of, ray));
    }
    return sectors;
}

}  // namespace hopscotch
