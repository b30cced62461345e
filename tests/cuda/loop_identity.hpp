// One body for emulated and for real devices: a model's ensemble loops as device code against one
// double after the other, bit for bit, for every section, choice of options and variant.
#pragma once

#include "tests/models/every_model.hpp"

#include <gtest/gtest.h>

#include <set>

namespace hopscotch::loop_identity {

using namespace every_model;

/// Every variant that these rows may be computed by: the ones that serve them all, with times and
/// without.
inline std::set<int> variants_of(const rows& of) {
    return {variant_of(of, true), variant_of(of, false)};
}

/// Returns under every decision that needs no traps.
inline void expect_same_returns(const model_entry& model, std::size_t n_rows) {
    for (int section = 0; section < static_cast<int>(model.info->sections.size()); ++section) {
        std::uint64_t seed = 4000;
        for (const std::vector<int>& options : all_options(*model.info)) {
            rows of = random_rows(model, section, options, n_rows, ++seed);
            for (const int variant : variants_of(of)) {
                for (const decision by : {decision::returns, decision::certificate}) {
                    if (by == decision::certificate && model.certificate_covers == nullptr)
                        continue;
                    of.decided_by = by;
                    const answers want = run(of, backend::scalar, variant);
                    const answers got = run(of, backend::cuda, variant);
                    for (std::size_t i = 0; i < of.size(); ++i) {
                        ASSERT_EQ(got.bits(i), want.bits(i))
                            << "variant " << variant << ", " << describe(of, i);
                    }
                }
            }
        }
    }
}

/// Exponents and ends of rows.
struct exponents {
    std::vector<std::vector<double>> layers;
    std::vector<std::uint8_t> motion, end;

    std::vector<std::uint64_t> bits(std::size_t i) const {
        std::vector<std::uint64_t> all{motion[i], end[i]};
        for (const auto& layer : layers) {
            all.push_back(
                std::bit_cast<std::uint64_t>(layer[i] == layer[i] ? layer[i] : not_given));
        }
        return all;
    }
};

inline exponents exponents_of(const rows& of, backend which) {
    const std::size_t n = of.size();
    exponents result;
    result.layers.assign(of.ends_on().columns.size() + 2, std::vector<double>(n));
    result.motion.resize(n), result.end.resize(n);
    ensemble_request request;
    request.n_cells = n;
    request.section = of.section;
    for (std::size_t c = 0; c < of.columns.size(); ++c) {
        request.columns[c] = {of.columns[c].data(), 1, n};
    }
    for (std::size_t p = 0; p < of.parameters.size(); ++p) {
        request.parameters[p] = {of.parameters[p].data(), 1, n};
    }
    for (std::size_t o = 0; o < of.options.size(); ++o) request.options[o] = of.options[o];
    request.max_returns = 40;
    request.max_steps = 400.0;
    request.exponents.transient = 5;
    request.exponents.block = 5;
    request.exponents.least_blocks = 3;
    request.exponents.error = 1e-3;
    std::size_t k = 0;
    for (; k < of.ends_on().columns.size(); ++k) {
        request.exponents.exponents[k] = result.layers[k].data();
    }
    request.exponents.rate = result.layers[k++].data();
    request.exponents.standard_error = result.layers[k].data();
    request.exponents.motion = result.motion.data();
    request.outcome = result.end.data();
    of.model->tangent(which, variant_of(of))(request);
    return result;
}

inline void expect_same_exponents(const model_entry& model, std::size_t n_rows) {
    std::uint64_t seed = 5000;
    for (const std::vector<int>& options : all_options(*model.info)) {
        const rows of = random_rows(model, 0, options, n_rows, ++seed);
        const exponents want = exponents_of(of, backend::scalar);
        const exponents got = exponents_of(of, backend::cuda);
        for (std::size_t i = 0; i < of.size(); ++i) {
            ASSERT_EQ(got.bits(i), want.bits(i)) << describe(of, i);
        }
    }
}

}  // namespace hopscotch::loop_identity
