#!/usr/bin/env bash
# Which registers, stack and spills does every GPU kernel need? Compiles all units (no GPU is needed) and
# writes one JSON line per kernel, with nvcc's processor time per unit, to bench/results/kernel_resources.jsonl, in
# the place of those of that architecture and model.
# Usage: kernel_resources.sh [ARCH (sm_90)] [MODEL ...]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
arch=${1:-sm_90}
[ $# -gt 0 ] && shift
[ $# -gt 0 ] || set -- $(cd "$root/kernels/models" && ls | sed 's/\.hpp$//')
version=$(nvcc --version | sed -n 's/.*release .*, V//p')
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
: >"$work/lines"
TIMEFORMAT='%U %S'

measure() {  # model, kind
    sed "s#@model@#$1#g; s#@model_header@#kernels/models/$1.hpp#" \
        "$root/kernels/ensemble/units/cuda_$2.cu.in" >"$work/unit.cu"
    { time nvcc -std=c++20 -O3 -fmad=false -prec-div=true -prec-sqrt=true --expt-relaxed-constexpr \
        -diag-suppress=1675 -arch="$arch" -DHOPSCOTCH_TARGET=cuda -I"$root" -Xptxas -v \
        -c "$work/unit.cu" -o "$work/unit.o" >"$work/log" 2>&1; } 2>"$work/time" ||
        { cat "$work/log" >&2; exit 1; }
    local seconds
    seconds=$(awk '{print $1 + $2}' "$work/time")
    # "Compiling entry function" opens a kernel, "Function properties" of it gives its stack
    awk -v model="$1" -v kind="$2" -v arch="$arch" -v nvcc="$version" -v seconds="$seconds" '
        /Compiling entry function/ { entry = $0; sub(/.*function ./, "", entry); sub(/. for.*/, "", entry) }
        /Function properties for/ { of = $NF }
        /bytes stack frame/ && of == entry { stack = $1; spill = $5 }
        /Used [0-9]+ registers/ {
            variant = entry; sub(/.*Li/, "", variant); sub(/E.*/, "", variant)
            match($0, /Used [0-9]+/)
            printf "{\"benchmark\": \"kernel_resources\", \"nvcc\": \"%s\", \"arch\": \"%s\", \"model\": \"%s\", \"kind\": \"%s\", \"variant\": %s, \"registers\": %s, \"stack_bytes\": %s, \"spill_store_bytes\": %s, \"unit_nvcc_seconds\": %s}\n",
                nvcc, arch, model, kind, variant, substr($0, RSTART + 5, RLENGTH - 5), stack, spill, seconds
        }' "$work/log" | sort -t: -k7 | tee -a "$work/lines"
}

for model in "$@"; do
    for kind in kernels tangents; do measure "$model" "$kind"; done
done
results=$root/bench/results/kernel_resources.jsonl
cp "$results" "$work/others"
for model in "$@"; do sed -i "/\"arch\": \"$arch\", \"model\": \"$model\"/d" "$work/others"; done
cat "$work/others" "$work/lines" >"$results"
