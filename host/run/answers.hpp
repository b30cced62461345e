// What orbits are compared by where the question is whether two of them end alike: label, outcome,
// returns, events and last state, or the motion of a chaos map. For the layer `uncertain`.
#pragma once

#include "host/run/requests.hpp"
#include "host/scene/scene.hpp"
#include "kernels/ensemble/request.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

namespace hopscotch {

/// Answers of a request with its results bound: outcome, returns, events and states; label where
/// the question has labels; motion instead of events and states where it asks for exponents.
struct answer_view {
    explicit answer_view(const ensemble_request& of)
        : label(of.label),
          outcome(of.outcome),
          returns(of.returns),
          events(of.events),
          motion(of.exponents.motion) {
        std::copy(std::begin(of.state), std::end(of.state), state);
    }

    const std::int16_t* label;
    const std::uint8_t* outcome;
    const std::uint32_t* returns;
    const std::uint32_t* events;
    const std::uint8_t* motion;
    const double* state[most_columns];
};

/// Answers with memory of their own.
struct answers {
    explicit answers(std::uint64_t n) : label(n), outcome(n), returns(n), events(n), motion(n) {}

    void bind(ensemble_request& request, const scene& scene) {
        if (scene.question.has_labels) request.label = label.data();
        request.outcome = outcome.data();
        request.returns = returns.data();
        if (is_chaos_map(scene)) {
            request.exponents.motion = motion.data();
        } else {
            request.events = events.data();
            states.resize(scene.end_section().columns.size());
            for (std::size_t c = 0; c < states.size(); ++c) {
                states[c].resize(outcome.size());
                request.state[c] = states[c].data();
            }
        }
    }

    /// Takes the i-th answer of others.
    void take(std::uint64_t place, const answer_view& from, std::uint64_t i) {
        if (from.label != nullptr) label[place] = from.label[i];
        outcome[place] = from.outcome[i];
        returns[place] = from.returns[i];
        if (from.events != nullptr) events[place] = from.events[i];
        if (from.motion != nullptr) motion[place] = from.motion[i];
        states.resize(most_columns);
        for (std::size_t c = 0; c < states.size(); ++c) {
            if (from.state[c] == nullptr) continue;
            states[c].resize(outcome.size());
            states[c][place] = from.state[c][i];
        }
    }

    std::vector<std::int16_t> label;
    std::vector<std::uint8_t> outcome;
    std::vector<std::uint32_t> returns;
    std::vector<std::uint32_t> events;
    std::vector<std::uint8_t> motion;
    std::vector<std::vector<double>> states;  // column by column
};

/// Does the i-th orbit end otherwise than the j-th of another run, as far as the question asks?
inline bool has_other_answer(const scene& scene, const answer_view& a, std::uint64_t i,
                             const answer_view& b, std::uint64_t j) {
    if (a.outcome[i] != b.outcome[j]) return true;
    if (is_chaos_map(scene)) return a.motion[i] != b.motion[j];
    if (scene.question.has_labels) return a.label[i] != b.label[j];
    return scene.question.kind == "steps_to_fall" && a.returns[i] != b.returns[j];
}

/// Have two orbits spent their returns without a label (or without a fall, where that is asked
/// for), and stand apart by more than 2^-10 of their size? A few roundings have then grown so much
/// that nothing is known of the true orbit.
inline bool have_lost_each_other(const scene& scene, const answer_view& a, std::uint64_t i,
                                 const answer_view& b, std::uint64_t j) {
    const bool has_labels = scene.question.has_labels;
    if (!has_labels && scene.question.kind != "steps_to_fall") return false;
    const outcome spent = has_labels ? outcome::budget : outcome::ok;
    if (static_cast<outcome>(a.outcome[i]) != spent ||
        static_cast<outcome>(b.outcome[j]) != spent) {
        return false;
    }
    double apart = 0.0;
    double size = 0.0;
    for (std::size_t c = 0; c < most_columns; ++c) {
        if (a.state[c] == nullptr || b.state[c] == nullptr) continue;
        const double x = a.state[c][i];
        const double y = b.state[c][j];
        apart = std::max(apart, std::abs(x - y));
        size = std::max({size, std::abs(x), std::abs(y)});
    }
    return apart > 0x1p-10 * size;
}

/// Does it end alike, but after another number of returns or events, or undecided elsewhere? In a
/// fractal basin all moved starts may happen to end alike; these numbers give them away.
inline bool has_other_events(const scene& scene, const answer_view& a, std::uint64_t i,
                             const answer_view& b, std::uint64_t j) {
    if (is_chaos_map(scene)) return false;
    return a.returns[i] != b.returns[j] || a.events[i] != b.events[j] ||
           have_lost_each_other(scene, a, i, b, j);
}

/// The same cells, no results wanted.
inline ensemble_request without_results(ensemble_request request) {
    request.label = nullptr;
    request.outcome = nullptr;
    request.returns = request.events = nullptr;
    request.time = nullptr;
    std::fill(std::begin(request.state), std::end(request.state), nullptr);
    std::fill(std::begin(request.extras), std::end(request.extras), nullptr);
    exponent_request& exponents = request.exponents;
    std::fill(std::begin(exponents.exponents), std::end(exponents.exponents), nullptr);
    exponents.rate = exponents.standard_error = nullptr;
    exponents.returns = nullptr;
    exponents.motion = nullptr;
    return request;
}

}  // namespace hopscotch
