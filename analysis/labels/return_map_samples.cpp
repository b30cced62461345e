// Evaluates return maps through the kernels' public entry points.
#include "analysis/labels/return_map_samples.hpp"

#include <algorithm>

namespace hopscotch {

return_map_samples::return_map_samples(const scene& scene, std::vector<double> parameters)
    : scene_(scene), parameters_(std::move(parameters)) {
    variant_ =
        scene.model->variant({parameters_.data(), parameters_.data(), scene.options.data(), false});
}

std::vector<double> return_map_samples::at(std::span<const double> x, std::uint32_t returns) const {
    std::vector<double> image(x.size());
    std::vector<std::uint8_t> ended(x.size());
    ensemble_request request;
    request.n_cells = x.size();
    request.columns[0] = {x.data(), 1, x.size()};
    for (std::size_t i = 0; i < parameters_.size(); ++i)
        request.parameters[i].values = &parameters_[i];
    std::copy(scene_.options.begin(), scene_.options.end(), request.options);
    request.max_returns = returns;
    request.max_steps = static_cast<double>(scene_.accuracy.max_events);
    request.outcome = ended.data();
    request.state[0] = image.data();
    scene_.model->kernel(backend::scalar, variant_)(request);
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (static_cast<outcome>(ended[i]) != outcome::ok) {
            image[i] = std::numeric_limits<double>::quiet_NaN();
        }
    }
    return image;
}

double return_map_samples::at(double x, std::uint32_t returns) const {
    return at(std::span<const double>(&x, 1), returns).front();
}

}  // namespace hopscotch
