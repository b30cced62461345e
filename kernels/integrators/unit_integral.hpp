// Integrals over (0, 1) by the tanh-sinh rule: integrands may have square-root singularities at or
// close to both ends. A table of nodes in double, spacing halved until convergence in wider
// arithmetics.
#pragma once

#include "kernels/elementary/elementary.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::integrals {

/// A node: its distances from both ends, and its weight.
struct unit_node {
    double from_start, from_end, weight;
};

/// Spacing 1/18 in the variable t of x = (1 + tanh(pi/2 sinh t)) / 2; rounded from 40 digits.
/// Weights below 1e-34 are left out: an inverse square root at an end loses 1e-17 to that.
HOPSCOTCH_DEVICE inline const unit_node (&unit_nodes())[141] {
    static constexpr unit_node nodes[] = {
        {0x1.417b821827a6cp-111, 0x1.0000000000000p+0, 0x1.56ce9091d6e12p-109},
        {0x1.3e5af6b7f9114p-105, 0x1.0000000000000p+0, 0x1.412493a0c7be8p-103},
        {0x1.f7f9579ce8e2dp-100, 0x1.0000000000000p+0, 0x1.e0f0962ade6d4p-98},
        {0x1.42bc8266e2a14p-94, 0x1.0000000000000p+0, 0x1.235c1f1cf15bap-92},
        {0x1.5246689750519p-89, 0x1.0000000000000p+0, 0x1.20e7843d7aeedp-87},
        {0x1.25540e1efb80dp-84, 0x1.0000000000000p+0, 0x1.d9fecb63ea02fp-83},
        {0x1.a9314efa8e80dp-80, 0x1.0000000000000p+0, 0x1.45006806f8f80p-78},
        {0x1.0416803c41fa4p-75, 0x1.0000000000000p+0, 0x1.78270f8df4a70p-74},
        {0x1.0f05b4c90d2f3p-71, 0x1.0000000000000p+0, 0x1.72d2f7b7ce5c7p-70},
        {0x1.e54d8ce8da123p-68, 0x1.0000000000000p+0, 0x1.3a1a0b3b3fe4ep-66},
        {0x1.7867259f6c258p-64, 0x1.0000000000000p+0, 0x1.ccf7dcb0b149dp-63},
        {0x1.fdc164cd46b65p-61, 0x1.0000000000000p+0, 0x1.2750f24715ecbp-59},
        {0x1.2f94aca697f6ap-57, 0x1.0000000000000p+0, 0x1.4ccb18ea1303ap-56},
        {0x1.403cdf185a697p-54, 0x1.fffffffffffffp-1, 0x1.4c24e00c36de8p-53},
        {0x1.2d270b32031e1p-51, 0x1.ffffffffffffbp-1, 0x1.2787ffb8278dep-50},
        {0x1.fc1a5768b068ap-49, 0x1.fffffffffffe0p-1, 0x1.d7c86c5e6521ap-48},
        {0x1.82c89ccd8b24cp-46, 0x1.fffffffffff3fp-1, 0x1.53d0f36dd5e3ap-45},
        {0x1.0b2b92892f584p-43, 0x1.ffffffffffbd3p-1, 0x1.bc36e91ac9067p-43},
        {0x1.50b1465bc5118p-41, 0x1.fffffffffeaf5p-1, 0x1.08dcfa6de87d8p-40},
        {0x1.84fe807000006p-39, 0x1.fffffffff9ec0p-1, 0x1.21933c35eee42p-38},
        {0x1.9df86a68c741dp-37, 0x1.ffffffffe6208p-1, 0x1.23a1eb02f930dp-36},
        {0x1.979e648b65187p-35, 0x1.ffffffff9a186p-1, 0x1.0fc33e739d76fp-34},
        {0x1.74efe6d14dd7ap-33, 0x1.fffffffe8b102p-1, 0x1.d6a514756f2adp-33},
        {0x1.3e4fe75d2bba2p-31, 0x1.fffffffb06c06p-1, 0x1.7c36e2f192a78p-31},
        {0x1.fcd79ecb92d41p-30, 0x1.fffffff019431p-1, 0x1.1fa82edbeaaf2p-29},
        {0x1.7e3aafbf01aacp-28, 0x1.ffffffd038aa1p-1, 0x1.991842aeb3c2cp-28},
        {0x1.0ec1e985685c3p-26, 0x1.ffffff789f0b4p-1, 0x1.1257e5d50f18ap-26},
        {0x1.6ae4bb7d48a53p-25, 0x1.fffffe951b448p-1, 0x1.5c22686e4c120p-25},
        {0x1.cd8afe7e798e1p-24, 0x1.fffffc64ea030p-1, 0x1.a3413c1195babp-24},
        {0x1.1751c0a2db624p-22, 0x1.fffff74571fafp-1, 0x1.e08e83709685ep-23},
        {0x1.429eb18a97fd9p-21, 0x1.ffffebd614e75p-1, 0x1.06d989e41d35bp-21},
        {0x1.6483404130640p-20, 0x1.ffffd36f97f7ep-1, 0x1.13242738b6fecp-20},
        {0x1.79d8c55750308p-19, 0x1.ffffa189ceaa3p-1, 0x1.14445467dbfa4p-19},
        {0x1.80f6cec8ecbecp-18, 0x1.ffff3f84989b9p-1, 0x1.0ab624712576cp-18},
        {0x1.79deb8c754ecap-17, 0x1.fffe86214738bp-1, 0x1.f03bd55ac491ep-18},
        {0x1.6615b44cde04ep-16, 0x1.fffd33d497664p-1, 0x1.bdc62e909f0adp-17},
        {0x1.4840544ff7699p-15, 0x1.fffadefeaec02p-1, 0x1.8374d10fdbe8dp-16},
        {0x1.239e47782f6ecp-14, 0x1.fff6e30dc43e8p-1, 0x1.4675ccde70fedp-15},
        {0x1.f70bf31afc9c6p-14, 0x1.fff047a067282p-1, 0x1.0b20029728939p-14},
        {0x1.a5f15428e9ec1p-13, 0x1.ffe5a0eabd716p-1, 0x1.a93f738c12d0fp-14},
        {0x1.58b87cab2b527p-12, 0x1.ffd4e8f06a9a9p-1, 0x1.49cc7e938a352p-13},
        {0x1.12b9bada2485cp-11, 0x1.ffbb51914976ep-1, 0x1.f32cd3897c017p-13},
        {0x1.abc04d7551985p-11, 0x1.ff950feca2abap-1, 0x1.7128a1fd3f430p-12},
        {0x1.45bb947bf2ce4p-10, 0x1.ff5d2235c206ap-1, 0x1.0b2448845e94bp-11},
        {0x1.e5dc9473148a6p-10, 0x1.ff0d11b5c675cp-1, 0x1.7acd9a9cef638p-11},
        {0x1.634ca5de36902p-9, 0x1.fe9cb35a21c97p-1, 0x1.076fd394c8ccbp-10},
        {0x1.fe162fd40429bp-9, 0x1.fe01e9d02bfbdp-1, 0x1.67ccd44e95ebbp-10},
        {0x1.67c99b6c47564p-8, 0x1.fd306cc927715p-1, 0x1.e3070a412c246p-10},
        {0x1.f3333580f8b2ap-8, 0x1.fc199994fe0eap-1, 0x1.3efd0a810663ep-9},
        {0x1.54eb8d7062bb1p-7, 0x1.faac51ca3e751p-1, 0x1.9ed96a245e311p-9},
        {0x1.cac4b57a33d94p-7, 0x1.f8d4ed2a1730ap-1, 0x1.09d0df359bedcp-8},
        {0x1.30577668944fdp-6, 0x1.f67d444cbb5d8p-1, 0x1.4fe3142230750p-8},
        {0x1.8e64c57b0deaep-6, 0x1.f38cd9d42790bp-1, 0x1.a2be349af0fc4p-8},
        {0x1.016d831130a03p-5, 0x1.efe927ceecf60p-1, 0x1.01a63f4dfb661p-7},
        {0x1.489e986e75ebcp-5, 0x1.eb76167918a14p-1, 0x1.3918dc0cacd12p-7},
        {0x1.9e95f801a36fep-5, 0x1.e616a07fe5c90p-1, 0x1.77d9d32e8daebp-7},
        {0x1.0292c68a3856fp-4, 0x1.dfada72eb8f52p-1, 0x1.bdd0f211e896dp-7},
        {0x1.3f084d378658ap-4, 0x1.d81ef6590f34fp-1, 0x1.054fa62097a9fp-6},
        {0x1.857c5d0aafdd9p-4, 0x1.cf50745eaa045p-1, 0x1.2eca807a55bb8p-6},
        {0x1.d6a44d2b12b04p-4, 0x1.c52b765a9daa0p-1, 0x1.5ad4ca9128d5ep-6},
        {0x1.198751818f585p-3, 0x1.b99e2b9f9c29fp-1, 0x1.88bc154d3b68cp-6},
        {0x1.4d8bc620abe11p-3, 0x1.ac9d0e77d507cp-1, 0x1.b7a06dbb29167p-6},
        {0x1.876ef2d8072d5p-3, 0x1.9e244349fe34bp-1, 0x1.e6782a7c14d6dp-6},
        {0x1.c71cd1eb078d9p-3, 0x1.8e38cb853e1cap-1, 0x1.0a0b9b72e5882p-5},
        {0x1.062d204754a00p-2, 0x1.7ce96fdc55b00p-1, 0x1.1f9cf8022708dp-5},
        {0x1.2b6173ac6a17ap-2, 0x1.6a4f4629caf43p-1, 0x1.3349a3f6e52a4p-5},
        {0x1.52e489413aa0fp-2, 0x1.568dbb5f62af9p-1, 0x1.446ebbf377bfcp-5},
        {0x1.7c5bdd6834ea4p-2, 0x1.41d2114be58aep-1, 0x1.5276104a4e41cp-5},
        {0x1.a75b6b23334dfp-2, 0x1.2c524a6e66591p-1, 0x1.5cdf3178bf6b7p-5},
        {0x1.d368eae12504dp-2, 0x1.164b8a8f6d7d9p-1, 0x1.6347a762050ffp-5},
        {0x1.0000000000000p-1, 0x1.0000000000000p-1, 0x1.657184ae74487p-5},
        {0x1.164b8a8f6d7d9p-1, 0x1.d368eae12504dp-2, 0x1.6347a762050ffp-5},
        {0x1.2c524a6e66591p-1, 0x1.a75b6b23334dfp-2, 0x1.5cdf3178bf6b7p-5},
        {0x1.41d2114be58aep-1, 0x1.7c5bdd6834ea4p-2, 0x1.5276104a4e41cp-5},
        {0x1.568dbb5f62af9p-1, 0x1.52e489413aa0fp-2, 0x1.446ebbf377bfcp-5},
        {0x1.6a4f4629caf43p-1, 0x1.2b6173ac6a17ap-2, 0x1.3349a3f6e52a4p-5},
        {0x1.7ce96fdc55b00p-1, 0x1.062d204754a00p-2, 0x1.1f9cf8022708dp-5},
        {0x1.8e38cb853e1cap-1, 0x1.c71cd1eb078d9p-3, 0x1.0a0b9b72e5882p-5},
        {0x1.9e244349fe34bp-1, 0x1.876ef2d8072d5p-3, 0x1.e6782a7c14d6dp-6},
        {0x1.ac9d0e77d507cp-1, 0x1.4d8bc620abe11p-3, 0x1.b7a06dbb29167p-6},
        {0x1.b99e2b9f9c29fp-1, 0x1.198751818f585p-3, 0x1.88bc154d3b68cp-6},
        {0x1.c52b765a9daa0p-1, 0x1.d6a44d2b12b04p-4, 0x1.5ad4ca9128d5ep-6},
        {0x1.cf50745eaa045p-1, 0x1.857c5d0aafdd9p-4, 0x1.2eca807a55bb8p-6},
        {0x1.d81ef6590f34fp-1, 0x1.3f084d378658ap-4, 0x1.054fa62097a9fp-6},
        {0x1.dfada72eb8f52p-1, 0x1.0292c68a3856fp-4, 0x1.bdd0f211e896dp-7},
        {0x1.e616a07fe5c90p-1, 0x1.9e95f801a36fep-5, 0x1.77d9d32e8daebp-7},
        {0x1.eb76167918a14p-1, 0x1.489e986e75ebcp-5, 0x1.3918dc0cacd12p-7},
        {0x1.efe927ceecf60p-1, 0x1.016d831130a03p-5, 0x1.01a63f4dfb661p-7},
        {0x1.f38cd9d42790bp-1, 0x1.8e64c57b0deaep-6, 0x1.a2be349af0fc4p-8},
        {0x1.f67d444cbb5d8p-1, 0x1.30577668944fdp-6, 0x1.4fe3142230750p-8},
        {0x1.f8d4ed2a1730ap-1, 0x1.cac4b57a33d94p-7, 0x1.09d0df359bedcp-8},
        {0x1.faac51ca3e751p-1, 0x1.54eb8d7062bb1p-7, 0x1.9ed96a245e311p-9},
        {0x1.fc199994fe0eap-1, 0x1.f3333580f8b2ap-8, 0x1.3efd0a810663ep-9},
        {0x1.fd306cc927715p-1, 0x1.67c99b6c47564p-8, 0x1.e3070a412c246p-10},
        {0x1.fe01e9d02bfbdp-1, 0x1.fe162fd40429bp-9, 0x1.67ccd44e95ebbp-10},
        {0x1.fe9cb35a21c97p-1, 0x1.634ca5de36902p-9, 0x1.076fd394c8ccbp-10},
        {0x1.ff0d11b5c675cp-1, 0x1.e5dc9473148a6p-10, 0x1.7acd9a9cef638p-11},
        {0x1.ff5d2235c206ap-1, 0x1.45bb947bf2ce4p-10, 0x1.0b2448845e94bp-11},
        {0x1.ff950feca2abap-1, 0x1.abc04d7551985p-11, 0x1.7128a1fd3f430p-12},
        {0x1.ffbb51914976ep-1, 0x1.12b9bada2485cp-11, 0x1.f32cd3897c017p-13},
        {0x1.ffd4e8f06a9a9p-1, 0x1.58b87cab2b527p-12, 0x1.49cc7e938a352p-13},
        {0x1.ffe5a0eabd716p-1, 0x1.a5f15428e9ec1p-13, 0x1.a93f738c12d0fp-14},
        {0x1.fff047a067282p-1, 0x1.f70bf31afc9c6p-14, 0x1.0b20029728939p-14},
        {0x1.fff6e30dc43e8p-1, 0x1.239e47782f6ecp-14, 0x1.4675ccde70fedp-15},
        {0x1.fffadefeaec02p-1, 0x1.4840544ff7699p-15, 0x1.8374d10fdbe8dp-16},
        {0x1.fffd33d497664p-1, 0x1.6615b44cde04ep-16, 0x1.bdc62e909f0adp-17},
        {0x1.fffe86214738bp-1, 0x1.79deb8c754ecap-17, 0x1.f03bd55ac491ep-18},
        {0x1.ffff3f84989b9p-1, 0x1.80f6cec8ecbecp-18, 0x1.0ab624712576cp-18},
        {0x1.ffffa189ceaa3p-1, 0x1.79d8c55750308p-19, 0x1.14445467dbfa4p-19},
        {0x1.ffffd36f97f7ep-1, 0x1.6483404130640p-20, 0x1.13242738b6fecp-20},
        {0x1.ffffebd614e75p-1, 0x1.429eb18a97fd9p-21, 0x1.06d989e41d35bp-21},
        {0x1.fffff74571fafp-1, 0x1.1751c0a2db624p-22, 0x1.e08e83709685ep-23},
        {0x1.fffffc64ea030p-1, 0x1.cd8afe7e798e1p-24, 0x1.a3413c1195babp-24},
        {0x1.fffffe951b448p-1, 0x1.6ae4bb7d48a53p-25, 0x1.5c22686e4c120p-25},
        {0x1.ffffff789f0b4p-1, 0x1.0ec1e985685c3p-26, 0x1.1257e5d50f18ap-26},
        {0x1.ffffffd038aa1p-1, 0x1.7e3aafbf01aacp-28, 0x1.991842aeb3c2cp-28},
        {0x1.fffffff019431p-1, 0x1.fcd79ecb92d41p-30, 0x1.1fa82edbeaaf2p-29},
        {0x1.fffffffb06c06p-1, 0x1.3e4fe75d2bba2p-31, 0x1.7c36e2f192a78p-31},
        {0x1.fffffffe8b102p-1, 0x1.74efe6d14dd7ap-33, 0x1.d6a514756f2adp-33},
        {0x1.ffffffff9a186p-1, 0x1.979e648b65187p-35, 0x1.0fc33e739d76fp-34},
        {0x1.ffffffffe6208p-1, 0x1.9df86a68c741dp-37, 0x1.23a1eb02f930dp-36},
        {0x1.fffffffff9ec0p-1, 0x1.84fe807000006p-39, 0x1.21933c35eee42p-38},
        {0x1.fffffffffeaf5p-1, 0x1.50b1465bc5118p-41, 0x1.08dcfa6de87d8p-40},
        {0x1.ffffffffffbd3p-1, 0x1.0b2b92892f584p-43, 0x1.bc36e91ac9067p-43},
        {0x1.fffffffffff3fp-1, 0x1.82c89ccd8b24cp-46, 0x1.53d0f36dd5e3ap-45},
        {0x1.fffffffffffe0p-1, 0x1.fc1a5768b068ap-49, 0x1.d7c86c5e6521ap-48},
        {0x1.ffffffffffffbp-1, 0x1.2d270b32031e1p-51, 0x1.2787ffb8278dep-50},
        {0x1.fffffffffffffp-1, 0x1.403cdf185a697p-54, 0x1.4c24e00c36de8p-53},
        {0x1.0000000000000p+0, 0x1.2f94aca697f6ap-57, 0x1.4ccb18ea1303ap-56},
        {0x1.0000000000000p+0, 0x1.fdc164cd46b65p-61, 0x1.2750f24715ecbp-59},
        {0x1.0000000000000p+0, 0x1.7867259f6c258p-64, 0x1.ccf7dcb0b149dp-63},
        {0x1.0000000000000p+0, 0x1.e54d8ce8da123p-68, 0x1.3a1a0b3b3fe4ep-66},
        {0x1.0000000000000p+0, 0x1.0f05b4c90d2f3p-71, 0x1.72d2f7b7ce5c7p-70},
        {0x1.0000000000000p+0, 0x1.0416803c41fa4p-75, 0x1.78270f8df4a70p-74},
        {0x1.0000000000000p+0, 0x1.a9314efa8e80dp-80, 0x1.45006806f8f80p-78},
        {0x1.0000000000000p+0, 0x1.25540e1efb80dp-84, 0x1.d9fecb63ea02fp-83},
        {0x1.0000000000000p+0, 0x1.5246689750519p-89, 0x1.20e7843d7aeedp-87},
        {0x1.0000000000000p+0, 0x1.42bc8266e2a14p-94, 0x1.235c1f1cf15bap-92},
        {0x1.0000000000000p+0, 0x1.f7f9579ce8e2dp-100, 0x1.e0f0962ade6d4p-98},
        {0x1.0000000000000p+0, 0x1.3e5af6b7f9114p-105, 0x1.412493a0c7be8p-103},
        {0x1.0000000000000p+0, 0x1.417b821827a6cp-111, 0x1.56ce9091d6e12p-109},
    };
    return nodes;
}

/// Integral of f over (0, 1).
///
/// \param f  (x, 1 - x) -> value; both distances carry full relative accuracy
/// \error  in double some 1e-14 for functions analytic in the open interval and O(1) wide around it
template <class Real, class Function>
HOPSCOTCH_DEVICE inline Real over_unit_interval(const Function& f) {
    if constexpr (lane_traits<Real>::rounding > 0x1p-60) {
        Real sum(0.0);
        for (const unit_node& node : unit_nodes()) {
            sum = fma(Real(node.weight), f(Real(node.from_start), Real(node.from_end)), sum);
        }
        return sum;
    } else {
        using plain = primal_of<Real>;
        constexpr double span = lane_traits<Real>::rounding > 0x1p-110 ? 4.7 : 5.2;
        const plain one(1.0);
        const auto term = [&](const plain& t) {
            const plain inner = exp(t);
            const plain outer = exp(half_pi<plain>() * (inner - one / inner));
            const plain start = outer / (one + outer);
            const plain end = one / (one + outer);
            const plain weight = half_pi<plain>() * (inner + one / inner) * start * end;
            return Real(weight) * f(Real(start), Real(end));
        };
        Real sum = term(plain(0.0));
        const auto add = [&](double first, double distance) {
            for (double t = first; t <= span; t += distance)
                sum = sum + (term(plain(t)) + term(plain(-t)));
        };
        double spacing = 0.125;
        add(spacing, spacing);
        Real result = sum * Real(spacing);
        mask_of<Real> active = primal(result) == primal(result);
        for (int level = 0; level < 6 && any(active); ++level) {
            add(0.5 * spacing, spacing);
            spacing *= 0.5;
            const Real finer = sum * Real(spacing);
            const plain change = abs(primal(finer) - primal(result));
            result = select(active, finer, result);
            active =
                active & !(change <= plain(lane_traits<Real>::root_rounding) * abs(primal(finer)));
        }
        return result;
    }
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::integrals
