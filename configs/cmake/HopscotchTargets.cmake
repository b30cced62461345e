# The instruction sets a kernel is compiled for, with their flags and registers per pack.
set(HOPSCOTCH_TARGETS scalar avx2 avx512)
set(HOPSCOTCH_FLAGS_scalar -O3)
set(HOPSCOTCH_FLAGS_avx2 -O3 -mavx2 -mfma)
set(HOPSCOTCH_FLAGS_avx512
    -O3 -mavx512f -mavx512dq -mavx512bw -mavx512vl -mfma -mprefer-vector-width=512)
# registers per pack: how many instruction streams are in flight (0: plain double)
set(HOPSCOTCH_REGISTERS_scalar 0)
set(HOPSCOTCH_REGISTERS_avx2 2)
set(HOPSCOTCH_REGISTERS_avx512 3)
