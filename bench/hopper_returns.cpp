// Returns of the passive hopper through the kernels' public entry.
#include "bench/hopper_returns.hpp"

#include "analysis/orbit/orbit_functions.hpp"
#include "analysis/truth/real50.hpp"
#include "host/run/backends.hpp"

#include <array>
#include <cmath>
#include <random>
#include <stdexcept>

#include <fmt/format.h>

namespace hopscotch::bench {
namespace {

const model_entry& hopper() {
    const model_entry* found = find_model("passive_hopper");
    if (found == nullptr) throw std::runtime_error("the model passive_hopper is not built in");
    return *found;
}

std::vector<double> parameters_with(double mass_ratio) {
    std::vector<double> values;
    for (const parameter_info& parameter : hopper().info->parameters) {
        values.push_back(parameter.name == "mass_ratio" ? mass_ratio : parameter.standard);
    }
    return values;
}

int variant_with(const std::vector<double>& parameters, bool is_timed) {
    const int options[most_options] = {};
    return hopper().variant({parameters.data(), parameters.data(), options, is_timed});
}

double number_in(const std::string& decimal) { return std::strtod(decimal.c_str(), nullptr); }

}  // namespace

hopper_returns::hopper_returns(double mass, std::vector<double> speeds_at_lift_off)
    : mass_ratio(mass),
      starts(std::move(speeds_at_lift_off)),
      speeds(starts.size()),
      times(starts.size()),
      bounces(starts.size()),
      ends(starts.size()) {}

lane_statistics hopper_returns::run(backend which, bool is_timed, bool wants_bounces) {
    const std::vector<double> parameters = parameters_with(mass_ratio);
    ensemble_request request;
    request.n_cells = size();
    request.columns[0] = {starts.data(), 1, size()};
    for (std::size_t p = 0; p < parameters.size(); ++p)
        request.parameters[p] = {&parameters[p], 1, 1};
    request.state[0] = speeds.data();
    request.outcome = ends.data();
    if (is_timed) request.time = times.data();
    if (wants_bounces) request.extras[0] = bounces.data();
    return hopper().kernel(which, variant_with(parameters, is_timed))(request);
}

void hopper_returns::compute(backend which, bool is_timed) { run(which, is_timed, false); }

double hopper_returns::count_flights() {
    run(cpu_backends().front(), false, true);
    double flights = 0.0;
    for (const double n : bounces) flights += n + 1.0;
    return flights;
}

std::vector<double> uniform_starts(std::size_t n) {
    std::mt19937_64 bits(2002);
    std::vector<double> starts(n);
    for (double& alpha : starts) {
        alpha = 15.0 * (std::ldexp(static_cast<double>(bits() >> 12), -52) + 0x1p-53);
    }
    return starts;
}

std::vector<backend> cpu_backends() {
    std::vector<backend> usable;
    for (const backend which : {backend::avx512, backend::avx2, backend::scalar}) {
        if (hopper().has(which) && reason_against(which).empty()) usable.push_back(which);
    }
    return usable;
}

true_return truth_of(double start, double mass_ratio) {
    const std::vector<double> numbers = parameters_with(mass_ratio);
    std::vector<std::string> parameters;
    for (const double x : numbers) parameters.push_back(fmt::format("{:.17g}", x));
    const std::array columns{fmt::format("{:.17g}", start)};
    const int options[most_options] = {};
    orbit_row row;
    row.options = options;
    row.variant = variant_with(numbers, true);
    row.columns = columns;
    row.parameters = parameters;
    const orbit_answer answer = hopper().orbits().run_mp50(row);
    row.derivative = true;
    const orbit_answer with_slope = hopper().orbits().run_dd(row);

    true_return truth;
    truth.returns = answer.end == outcome::ok;
    truth.time = number_in(answer.time);
    truth.bounces = number_in(answer.extras[0]);
    if (!truth.returns) return truth;
    const real50 speed(answer.columns[0]);
    truth.speed = to_double(speed);
    truth.speed_rest = to_double(speed - real50(truth.speed));
    const bool has_slope = !with_slope.derivative.empty() && !with_slope.derivative[0].empty();
    truth.slope = has_slope ? number_in(with_slope.derivative[0]) : 0.0;
    return truth;
}

double ulp(double x) {
    const double size = std::abs(x);
    return std::nextafter(size, HUGE_VAL) - size;
}

return_error error_of(double speed, double start, const true_return& truth) {
    const double error = std::abs((speed - truth.speed) - truth.speed_rest);
    const double slope = std::abs(truth.slope);
    return {error / std::fmax(std::abs(truth.speed), slope * start),
            error / std::fmax(ulp(truth.speed), slope * ulp(start)), error};
}

}  // namespace hopscotch::bench
