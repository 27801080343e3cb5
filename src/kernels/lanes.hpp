// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Four doubles at a time, for the kernels of III-F. The compiler makes of them what the target has:
// a kernel is an always_inline template, instantiated once as the build is configured and once for
// AVX2, chosen at run time. No Eigen types in these functions: they would be compiled twice.
#pragma once

#include "kernels/instruction_set.hpp"

// Functions of Lanes are always inlined: how they would be passed does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"
#define MVO_INLINE __attribute__((always_inline)) inline

namespace mvo {

/// Anywhere in memory.
using Lanes = double __attribute__((vector_size(32), aligned(8), may_alias));
using HalfLanes = double __attribute__((vector_size(16), aligned(8), may_alias));

MVO_INLINE Lanes load(const double* from) { return *reinterpret_cast<const Lanes*>(from); }
MVO_INLINE void store(double* to, Lanes values) { *reinterpret_cast<Lanes*>(to) = values; }
MVO_INLINE double sum(Lanes v) { return (v[0] + v[2]) + (v[1] + v[3]); }

#if defined(__x86_64__)
#define MVO_HAS_AVX2_KERNELS
#define MVO_AVX2 __attribute__((target("avx2,fma")))
#endif

}  // namespace mvo
