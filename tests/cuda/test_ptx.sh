#!/usr/bin/env bash
# What nvcc makes of one model's kernels: no device heap, no printing, no contraction of products and sums
# (every addition and multiplication is rounded by itself, and fused ones are those written), no
# recursion, and stacks that leave room in 2 GiB of the largest device. Usage: test_ptx.sh NVCC SOURCE_DIR MODEL kernels|tangents FLAG...
set -euo pipefail
nvcc=$1 source=$2 model=$3 kind=$4
shift 4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
sed "s#@model@#$model#g; s#@model_header@#kernels/models/$model.hpp#" \
    "$source/kernels/ensemble/units/cuda_$kind.cu.in" >"$work/unit.cu"
"$nvcc" -std=c++20 -O3 "$@" -arch=compute_90 -DHOPSCOTCH_TARGET=cuda -I"$source" -ptx \
    "$work/unit.cu" -o "$work/unit.ptx"

failures=0
claim() {  # what is claimed, then a command that fails where it does not hold
    local text=$1
    shift
    "$@" || { echo "FAILED: $text"; failures=$((failures + 1)); }
}
has_none_in() { ! grep -nE "$2" "$1" | head -3 | grep .; }
has_none() { has_none_in "$work/unit.ptx" "$1"; }
claim "there are kernels" grep -q '\.entry' "$work/unit.ptx"
claim "double precision arithmetic is there" grep -q 'fma\.rn\.f64' "$work/unit.ptx"
claim "no heap and no printing on the device" has_none '\b(malloc|free|vprintf|__assertfail)\b'
# ptxas may fuse what is not marked with a rounding
claim "every sum and product has its own rounding" has_none '\b(add|sub|mul|mad)\.f64\b'
claim "nothing but round to nearest" has_none '\.(rz|rm|rp)\.f64\b.*(add|sub|mul|fma|div|sqrt)'
claim "division and square root are rounded correctly" has_none '\b(div|sqrt|rcp)\.(approx|full)'
claim "single precision is not used" has_none '\b(add|sub|mul|fma|div|sqrt)\.[a-z.]*f32\b'
# the host's compiler would use the C library where device code calls it
claim "no function of CUDA's mathematical library" has_none '__nv_|__internal_(trig|sin|cos|exp|log|pow)'
# the driver keeps a stack for every thread that the device could hold: 2048 x 132 of an H200, beside 512 MiB of
# tiles and workspace (host/device/device_pool.hpp) and what is left of 2 GiB for the context and code
"$(dirname "$nvcc")/ptxas" -arch=sm_90 -v "$work/unit.ptx" -o "$work/unit.cubin" 2>"$work/log"
stack=$(sed -n 's/^ *\([0-9]*\) bytes stack frame.*/\1/p' "$work/log" | sort -n | tail -1)
claim "every stack's size is known" has_none_in "$work/log" 'cannot be statically determined'
claim "the largest stack, $stack bytes, is at most 4000 (1.08 GB on the device)" [ "$stack" -le 4000 ]
exit $((failures > 0))
