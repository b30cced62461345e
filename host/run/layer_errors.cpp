// Differences cell by cell, then medians and maxima.
#include "host/run/layer_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hopscotch {
namespace {

constexpr double no_number = std::numeric_limits<double>::infinity();

/// Extended precision: differences of doubles and numbers next to them keep three digits.
double difference(double stored, const std::string& computed) {
    if (computed.empty()) return std::isnan(stored) ? 0.0 : no_number;
    const long double truth = std::stold(computed);
    if (std::isnan(truth) && std::isnan(stored)) return 0.0;
    if (truth == static_cast<long double>(stored)) return 0.0;  // infinities too
    const auto error = static_cast<double>(std::abs(static_cast<long double>(stored) - truth));
    return std::isnan(error) ? no_number : error;
}

double count_difference(double stored, std::uint64_t computed) {
    return std::abs(stored - static_cast<double>(computed));
}

double turned(const scene& scene, int column, double error, std::span<const double> parameters) {
    if (scene.model->turn == nullptr) return error;
    const int section = scene.start_section().returns_to;
    const double turn = scene.model->turn(section, column, parameters.data());
    return turn > 0.0 && error < turn ? std::min(error, turn - error) : error;
}

bool is_number(const layer_plan& layer, bool is_chaos_map) {
    switch (layer.role) {
        case layer_role::returns:
        case layer_role::events:
        case layer_role::time:
        case layer_role::state:
        case layer_role::extra:
            return !is_chaos_map;  // exponents are judged by another orbit, which has no states
        case layer_role::exponent:
            return true;
        default:
            return false;
    }
}

double median(std::vector<double> numbers) {
    const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
    std::nth_element(numbers.begin(), middle, numbers.end());
    return *middle;
}

}  // namespace

std::vector<layer_plan> numeric_layers(const scene& scene) {
    std::vector<layer_plan> layers;
    for (const layer_plan& layer : chosen_layers(scene)) {
        if (is_number(layer, scene.question.kind == "lyapunov")) layers.push_back(layer);
    }
    return layers;
}

std::vector<double> errors_of(const scene& scene, std::span<const layer_plan> layers,
                              std::span<const double> stored, const orbit_answer& computed,
                              std::span<const double> parameters) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const int index = layers[i].index;
        switch (layers[i].role) {
            case layer_role::returns:
                errors.push_back(count_difference(stored[i], computed.returns));
                break;
            case layer_role::events:
                errors.push_back(count_difference(stored[i], computed.events));
                break;
            case layer_role::time:
                errors.push_back(difference(stored[i], computed.time));
                break;
            case layer_role::state: {
                const double error =
                    difference(stored[i], computed.columns[static_cast<std::size_t>(index)]);
                errors.push_back(turned(scene, index, error, parameters));
                break;
            }
            default:
                errors.push_back(
                    difference(stored[i], computed.extras[static_cast<std::size_t>(index)]));
        }
    }
    return errors;
}

std::vector<double> errors_of(std::span<const layer_plan> layers, std::span<const double> stored,
                              const exponent_answer& computed) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const double truth = computed.exponents[layers[i].index];
        const double error = std::abs(stored[i] - truth);
        const bool is_same = stored[i] == truth || (std::isnan(stored[i]) && std::isnan(truth));
        errors.push_back(is_same ? 0.0 : std::isnan(error) ? no_number : error);
    }
    return errors;
}

std::vector<layer_error> summary_of(std::span<const layer_plan> layers,
                                    std::span<const cell_errors> cells) {
    std::vector<layer_error> result;
    if (cells.empty()) return result;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        layer_error& layer = result.emplace_back();
        layer.layer = layers[i].description.name;
        layer.unit = layers[i].description.unit;
        layer.worst = cells.front().cell;
        std::vector<double> errors;
        std::vector<double> sizes;
        for (const cell_errors& cell : cells) {
            errors.push_back(cell.errors[i]);
            if (!std::isnan(cell.stored[i])) sizes.push_back(std::abs(cell.stored[i]));
            if (!(cell.errors[i] > layer.largest)) continue;
            layer.largest = cell.errors[i];
            layer.worst = cell.cell;
        }
        layer.median = median(errors);
        const double size = sizes.empty() ? 0.0 : median(sizes);
        if (size > 0.0) layer.relative = layer.largest / size;
    }
    return result;
}

}  // namespace hopscotch
