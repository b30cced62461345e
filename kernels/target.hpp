// Names the instruction set a translation unit is compiled for. Every kernel header lives in
// `namespace hopscotch::inline HOPSCOTCH_TARGET`, so that objects built with different machine
// flags never share a symbol. CMake defines the name per object; host code takes `generic`.
#pragma once

#ifndef HOPSCOTCH_TARGET
#define HOPSCOTCH_TARGET generic
#endif

#ifdef __CUDACC__
#define HOPSCOTCH_DEVICE __host__ __device__
#else
#define HOPSCOTCH_DEVICE
#endif

namespace hopscotch::inline HOPSCOTCH_TARGET {}
