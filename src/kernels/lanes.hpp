// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Several numbers at a time, for all kernels, and the choice between their two halves. The compiler
// makes of the numbers what the target has: a kernel is an always_inline function, instantiated
// once as the build is configured (the portable half) and once for AVX2 (the machine's half),
// chosen at run time. No Eigen types in these functions: they would be compiled twice.
#pragma once

#include <atomic>

// Functions of lanes are always inlined: how they would be passed does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"
#define MVO_INLINE __attribute__((always_inline)) inline

#if defined(__x86_64__)
#define MVO_HAS_AVX2_KERNELS
#define MVO_AVX2 __attribute__((target("avx2,fma")))
#endif

namespace mvo {

constexpr int kDoubles = 4;  ///< numbers in Doubles; arrays of them are padded to multiples
constexpr int kFloats = 8;   ///< numbers in Floats and Ints; arrays are padded to multiples

/// Lanes anywhere in memory.
using Doubles = double __attribute__((vector_size(8 * kDoubles), aligned(8), may_alias));
using HalfDoubles = double __attribute__((vector_size(4 * kDoubles), aligned(8), may_alias));
using Floats = float __attribute__((vector_size(4 * kFloats), aligned(4), may_alias));
using Ints = int __attribute__((vector_size(4 * kFloats), aligned(4), may_alias));

MVO_INLINE Doubles load(const double* from) { return *reinterpret_cast<const Doubles*>(from); }
MVO_INLINE Floats load(const float* from) { return *reinterpret_cast<const Floats*>(from); }
MVO_INLINE void store(double* to, Doubles values) { *reinterpret_cast<Doubles*>(to) = values; }
MVO_INLINE double sum(Doubles v) { return (v[0] + v[2]) + (v[1] + v[3]); }

namespace detail {
inline std::atomic<bool> portable_only{false};
}

/// Makes every kernel take its portable half, or again the machine's. For tests and measurements.
inline void forcePortable(bool force) { detail::portable_only = force; }

#if defined(MVO_HAS_AVX2_KERNELS)
/// Does the machine's half differ from the portable one, and is it wanted?
inline bool usesAvx2() {
  static const bool has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return has && !detail::portable_only.load(std::memory_order_relaxed);
}
#endif

}  // namespace mvo
