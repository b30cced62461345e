// Watches the orbits of a tile, one after the other.
#include "host/run/surveys.hpp"

#include "analysis/orbit/finite_time_exponent.hpp"
#include "analysis/orbit/orbit_functions.hpp"
#include "host/run/requests.hpp"

#include <algorithm>
#include <limits>

namespace hopscotch {
namespace {

bool is_of_contact(layer_role role) {
    return role == layer_role::clearance || role == layer_role::hop_height ||
           role == layer_role::impact_speed;
}

/// The orbit goes on after its last completed return and ends by itself.
bool has_last_stretch(const ensemble_request& request, std::uint64_t cell) {
    const auto end = static_cast<outcome>(request.outcome[cell]);
    if (end == outcome::ok) return false;
    if (end == outcome::budget) return request.returns[cell] < request.max_returns;
    if (end != outcome::attracted) return true;
    const std::int16_t label = request.label == nullptr ? std::int16_t{0} : request.label[cell];
    return request.died_label > 0 && label == request.died_label;
}

class cell_survey {
public:
    cell_survey(const scene& scene, const ensemble_request& request)
        : scene_(scene), request_(request) {
        query_.section = scene.section;
        query_.options = scene.options.data();
        query_.variant = variant_of(scene);
        query_.columns = columns_;
        query_.parameters = parameters_;
        query_.max_steps = static_cast<double>(scene.accuracy.max_events);
        query_.tolerance = scene.accuracy.tolerance;
    }

    void move_to(std::uint64_t cell) {
        const std::size_t n_columns = scene_.start_section().columns.size();
        for (std::size_t c = 0; c < n_columns; ++c) columns_[c] = request_.columns[c].at(cell);
        for (std::size_t p = 0; p < scene_.info().parameters.size(); ++p) {
            parameters_[p] = request_.parameters[p].at(cell);
        }
        query_.returns = request_.returns[cell];
    }

    orbit_survey at_contact(std::uint64_t cell) {
        jet_query all = query_;
        if (has_last_stretch(request_, cell)) ++all.returns;
        return all.returns == 0 ? orbit_survey{} : scene_.model->orbits().survey(all);
    }

    double exponent() const {
        return finite_time_exponent(scene_.model->orbits(), query_,
                                    scene_.start_section().returns_to,
                                    static_cast<int>(scene_.start_section().columns.size()),
                                    static_cast<int>(scene_.end_section().columns.size()));
    }

private:
    const scene& scene_;
    const ensemble_request& request_;
    jet_query query_;
    double columns_[most_columns] = {};
    double parameters_[most_parameters] = {};
};

double number_of(const orbit_survey& survey, layer_role role) {
    switch (role) {
        case layer_role::clearance:
            return survey.clearance;
        case layer_role::hop_height:
            return survey.hop_height;
        default:
            return survey.impact_speed;
    }
}

}  // namespace

bool is_surveyed(layer_role role) {
    return is_of_contact(role) || role == layer_role::finite_exponent;
}

void fill_surveys(const scene& scene, const ensemble_request& request,
                  const std::vector<layer_plan>& layers,
                  std::vector<std::vector<std::byte>>& buffers) {
    const auto wants = [&](auto test) {
        return std::any_of(layers.begin(), layers.end(),
                           [&](const layer_plan& layer) { return test(layer.role); });
    };
    if (!wants(is_surveyed)) return;
    const bool wants_contact = wants(is_of_contact);
    cell_survey survey(scene, request);
    for (std::uint64_t cell = 0; cell < request.n_cells; ++cell) {
        const bool has_orbit = request.outcome[cell] != int(outcome::invalid_start);
        if (has_orbit) survey.move_to(cell);
        const orbit_survey met =
            has_orbit && wants_contact ? survey.at_contact(cell) : orbit_survey{};
        for (std::size_t i = 0; i < layers.size(); ++i) {
            if (!is_surveyed(layers[i].role)) continue;
            double& number = reinterpret_cast<double*>(buffers[i].data())[cell];
            if (is_of_contact(layers[i].role)) {
                number = number_of(met, layers[i].role);
            } else {
                number = has_orbit ? survey.exponent() : std::numeric_limits<double>::quiet_NaN();
            }
        }
    }
}

}  // namespace hopscotch
