// The first lossless points alpha*_k = tan alpha*_k, each as the nearest double and the rest, with their
// cosines: the section state of nearly every orbit is a distance from one of them. Computed to 100 digits
// by iterating x = k pi + atan x; the test `lossless_table_matches_fifty_digits` repeats that.
#pragma once

#include "kernels/lanes/lookup.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::passive {

inline constexpr int n_tabulated = 64;  // k = 0 ... 63, alpha up to 200

/// alpha*_k = high + low, and cos alpha*_k = (-1)^k / sqrt(1 + alpha*_k^2).
template <class Real>
struct tabulated_point {
    Real high;
    Real low;
    Real cosine;
};

template <class Real>
HOPSCOTCH_DEVICE inline tabulated_point<Real> lossless_from_table(const Real& k) {
    constexpr double high[n_tabulated] = {
        0x0.0p+0, 0x1.1f940543506adp+2, 0x1.ee6a86ae40ba6p+2, 0x1.5cee908bdb46ap+3,
        0x1.c21e42b259c64p+3, 0x1.138836ae15cbcp+4, 0x1.45f0db5f30c50p+4, 0x1.784fad6c5b1dcp+4,
        0x1.aaa82882af643p+4, 0x1.dcfc4f0385bc0p+4, 0x1.07a6af4c0252bp+5, 0x1.20ce130906bf3p+5,
        0x1.39f498f42a463p+5, 0x1.531a726dc6690p+5, 0x1.6c3fc3309f160p+5, 0x1.8564a5bb283fcp+5,
        0x1.9e892e1d422adp+5, 0x1.b7ad6bcf69506p+5, 0x1.d0d16af0d35a4p+5, 0x1.e9f5352385327p+5,
        0x1.018c6913f4571p+6, 0x1.0e1e242674cbdp+6, 0x1.1aafce6112629p+6, 0x1.274169ea8b16cp+6,
        0x1.33d2f88fa3f3bp+6, 0x1.40647bd4d07b8p+6, 0x1.4cf5f503da028p+6, 0x1.598765368be1bp+6,
        0x1.6618cd5f20150p+6, 0x1.72aa2e4ef4f39p+6, 0x1.7f3b88bbf0ccfp+6, 0x1.8bccdd44de9a7p+6,
        0x1.985e2c74fc6dap+6, 0x1.a4ef76c6e6bb4p+6, 0x1.b180bca701a11p+6, 0x1.be11fe7579cccp+6,
        0x1.caa33c87f10a4p+6, 0x1.d734772ae63a4p+6, 0x1.e3c5aea2e52a4p+6, 0x1.f056e32d8841dp+6,
        0x1.fce8150253fffp+6, 0x1.04bca229b95d0p+7, 0x1.0b0538a72aec1p+7, 0x1.114dce0e20690p+7,
        0x1.1796627160b6ap+7, 0x1.1ddef5e20c100p+7, 0x1.2427886fc97d0p+7, 0x1.2a701a28ee88fp+7,
        0x1.30b8ab1aa20edp+7, 0x1.37013b50face1p+7, 0x1.3d49cad71a5c6p+7, 0x1.439259b744f47p+7,
        0x1.49dae7faf68b3p+7, 0x1.502375aaf5888p+7, 0x1.566c02cf636f8p+7, 0x1.5cb48f6fcbba1p+7,
        0x1.62fd1b9331206p+7, 0x1.6945a740197dbp+7, 0x1.6f8e327c987c9p+7, 0x1.75d6bd4e592fcp+7,
        0x1.7c1f47baa6b78p+7, 0x1.8267d1c6740e6p+7, 0x1.88b05b7663171p+7, 0x1.8ef8e4cecafeep+7};
    constexpr double low[n_tabulated] = {
        0x0.0p+0, -0x1.327a11564f89ap-55, 0x1.b623b2c454942p-52, 0x1.e05efed7e105ep-51,
        0x1.8773d22185ac6p-51, -0x1.58ebfbb926094p-50, 0x1.9e7857a0fee04p-50,
        0x1.78e714a91f674p-51, -0x1.e624822be8a0cp-50, 0x1.428fec6998bd9p-51,
        0x1.28f5494360565p-50, 0x1.ea42a77614cb3p-49, -0x1.4f0fc72acd005p-51,
        -0x1.8e6d0bc09ada4p-50, 0x1.741afa48b52a4p-49, 0x1.91ffbdb0296d7p-51,
        0x1.93562304dd56dp-49, 0x1.cafd200a3f771p-50, 0x1.8b84193776844p-49,
        -0x1.c096835a4739cp-49, -0x1.4a01000ea4a16p-48, -0x1.6142d804560bfp-50,
        -0x1.3c28cb6619078p-49, -0x1.39249d41ffbaep-48, -0x1.203dc40c71cc9p-56,
        -0x1.a1dce51f0f095p-48, 0x1.394be7ec84d51p-48, 0x1.ba075a90d3506p-50,
        0x1.77ce14766f702p-49, -0x1.cf095577ca7c6p-49, -0x1.8978211d00c67p-48,
        0x1.19ffc8968517dp-52, 0x1.14f1455d04459p-50, 0x1.a1a40d85d2897p-55, 0x1.dd191846b074dp-49,
        0x1.f31ea190f9b0ep-50, 0x1.cbc9961058d7ap-49, -0x1.f141d5b58918dp-49,
        -0x1.48628894e1be2p-49, 0x1.f088543dc90e1p-49, -0x1.202c5ea96b899p-48,
        0x1.e400e6a96e766p-48, 0x1.4a583707fec2dp-47, -0x1.76861c3b6613bp-48,
        -0x1.37209487e8baep-47, -0x1.96352b39cdf1fp-47, 0x1.13094f55647e4p-50,
        -0x1.15cefe44f8defp-48, 0x1.f0eafedebc8e0p-48, -0x1.49a4df86e05b1p-48,
        0x1.670f4b353e7d0p-47, -0x1.1278c8d796dbfp-48, 0x1.161a3dec80208p-47,
        0x1.614b144c6ae17p-47, 0x1.34cc1ea887856p-51, -0x1.f8bd691984c3fp-49,
        0x1.b52e845adf9d3p-49, -0x1.5e5ad298be593p-49, -0x1.f44c590be9eb6p-48,
        0x1.8ba5f0fd051e7p-47, -0x1.27ed86c21b5efp-50, 0x1.99410d28ee24bp-50,
        -0x1.d44b2b7495415p-47, -0x1.9d3a7621b2cd7p-48};
    constexpr double cosine[n_tabulated] = {
        0x1.0000000000000p+0, -0x1.bce4fc0611a76p-3, 0x1.06e93ce8423a9p-3, -0x1.76116a76cf418p-4,
        0x1.227626d2f9ae2p-4, -0x1.dae7ae65574d6p-5, 0x1.91a692f59eb7ep-5, -0x1.5bfe36b54b637p-5,
        0x1.32fdc3b9d4d95p-5, -0x1.12a34dd0593a0p-5, 0x1.f0e9c3970a0bfp-6, -0x1.c5ab27aac7912p-6,
        0x1.a159ba7da4fa9p-6, -0x1.826af22dec679p-6, 0x1.67c142f25a6d1p-6, -0x1.5088e896ad3b9p-6,
        0x1.3c2183516ca73p-6, -0x1.2a0f645fc198bp-6, 0x1.19f1a0b9df85fp-6, -0x1.0b7b32976d68dp-6,
        0x1.fcdc3c4b16566p-7, -0x1.e52fe307cee95p-7, 0x1.cf9e67c7153bdp-7, -0x1.bbe2f8f8ab65cp-7,
        0x1.a9c402b66ec6dp-7, -0x1.9910fa398f1fbp-7, 0x1.89a0a934b091ep-7, -0x1.7b4fd87fc09adp-7,
        0x1.6e0042a8a73fbp-7, -0x1.6197bd573f91ep-7, 0x1.55ff8cedc880bp-7, -0x1.4b23d901ebef6p-7,
        0x1.40f33a9a7ed77p-7, -0x1.375e5eceffda5p-7, 0x1.2e57b9a5c0c2bp-7, -0x1.25d345fc6acefp-7,
        0x1.1dc64ffa6ad89p-7, -0x1.1627481580403p-7, 0x1.0eed9d1960b6ep-7, -0x1.08119bf43bf6ep-7,
        0x1.018c5448ca867p-7, -0x1.f6af01ef9d98cp-8, 0x1.eadae7f37be5ap-8, -0x1.df920a0018a4dp-8,
        0x1.d4cb04dc4b1d3p-8, -0x1.ca7d489b9320ap-8, 0x1.c0a101e4d1434p-8, -0x1.b72f0617ef2d1p-8,
        0x1.ae20c1e860274p-8, -0x1.a5702a1388619p-8, 0x1.9d17ade8312e9p-8, -0x1.95122b5fd199bp-8,
        0x1.8d5ae49415648p-8, -0x1.85ed7663101bcp-8, 0x1.7ec5d01b3aba9p-8, -0x1.77e02c0df54a7p-8,
        0x1.713908ebfc4a6p-8, -0x1.6acd23d33b274p-8, 0x1.649972f8c2008p-8, -0x1.5e9b20dc7fa49p-8,
        0x1.58cf87f6ceac4p-8, -0x1.53342ed1f78b3p-8, 0x1.4dc6c4838fe8cp-8, -0x1.48851d7b25a04p-8};
    return {lookup(high, k), lookup(low, k), lookup(cosine, k)};
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::passive
