// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Several numbers at a time, for all kernels, and the choice between their halves. A kernel is an
// always_inline template over the machine; onThisMachine() runs it. The compiler makes of the
// numbers what the target has. No Eigen types in these functions: they would be compiled twice.
//
// A product that is added is written as fused(): it is rounded once wherever it runs (the library
// is compiled with -ffp-contract=off), so the halves give the same bits.
#pragma once

#include <atomic>
#include <cstdint>
#include <cstring>

#if defined(__x86_64__)
#define MVO_HAS_AVX2_KERNELS
#define MVO_AVX2 __attribute__((target("avx2,fma")))
#if !defined(__clang__)
#include <immintrin.h>  // declares the builtins
#endif
#endif

// Functions of lanes are always inlined: how they would be passed does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"
#define MVO_INLINE __attribute__((always_inline)) inline

namespace mvo {

constexpr int kDoubles = 4;  ///< numbers in Doubles; arrays of them are padded to multiples
constexpr int kFloats = 8;   ///< numbers in Floats and Ints; arrays are padded to multiples

/// Lanes anywhere in memory.
using Doubles = double __attribute__((vector_size(8 * kDoubles), aligned(8), may_alias));
using HalfDoubles = double __attribute__((vector_size(4 * kDoubles), aligned(8), may_alias));
using Floats = float __attribute__((vector_size(4 * kFloats), aligned(4), may_alias));
using Ints = int __attribute__((vector_size(4 * kFloats), aligned(4), may_alias));
using Bytes = std::uint8_t __attribute__((vector_size(kFloats), aligned(1), may_alias));

MVO_INLINE Doubles load(const double* from) { return *reinterpret_cast<const Doubles*>(from); }
MVO_INLINE Floats load(const float* from) { return *reinterpret_cast<const Floats*>(from); }
MVO_INLINE void store(double* to, Doubles values) { *reinterpret_cast<Doubles*>(to) = values; }
MVO_INLINE void store(float* to, Floats values) { *reinterpret_cast<Floats*>(to) = values; }
MVO_INLINE double sum(Doubles v) { return (v[0] + v[2]) + (v[1] + v[3]); }
MVO_INLINE float sum(Floats v) {
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}
MVO_INLINE Floats toFloats(Ints v) { return __builtin_convertvector(v, Floats); }

/// Any machine that multiplies and adds with one rounding.
struct Portable {
  static MVO_INLINE Doubles all(double x) { return x - Doubles{}; }  // -0 stays -0
  static MVO_INLINE Floats all(float x) { return x - Floats{}; }
  static MVO_INLINE double fused(double a, double b, double c) { return __builtin_fma(a, b, c); }
  static MVO_INLINE float fused(float a, float b, float c) { return __builtin_fmaf(a, b, c); }
  static MVO_INLINE Doubles fused(Doubles a, Doubles b, Doubles c) {
    for (int i = 0; i < kDoubles; ++i) c[i] = __builtin_fma(a[i], b[i], c[i]);
    return c;
  }
  static MVO_INLINE Floats fused(Floats a, Floats b, Floats c) {
    for (int i = 0; i < kFloats; ++i) c[i] = __builtin_fmaf(a[i], b[i], c[i]);
    return c;
  }
  static MVO_INLINE Floats bytes(const std::uint8_t* from) {
    return toFloats(__builtin_convertvector(*reinterpret_cast<const Bytes*>(from), Ints));
  }
  static MVO_INLINE Floats root(Floats x) {
    for (int i = 0; i < kFloats; ++i) x[i] = __builtin_sqrtf(x[i]);
    return x;
  }
};

/// A machine for which that would be slow: it rounds twice, and its results differ by that.
struct TwoRoundings : Portable {
  static MVO_INLINE double fused(double a, double b, double c) { return a * b + c; }
  static MVO_INLINE float fused(float a, float b, float c) { return a * b + c; }
  static MVO_INLINE Doubles fused(Doubles a, Doubles b, Doubles c) { return a * b + c; }
  static MVO_INLINE Floats fused(Floats a, Floats b, Floats c) { return a * b + c; }
};

#if defined(MVO_HAS_AVX2_KERNELS) && !defined(__clang__)
// GCC resolves these builtins where the kernel ends up: in a function for AVX2. Clang wants them in
// one from the start; it finds the instructions by itself.
struct Avx2 : Portable {
  using Portable::fused;
  static MVO_INLINE Doubles all(double x) {
    using Two = double __attribute__((vector_size(16)));
    return __builtin_ia32_vbroadcastsd_pd256(Two{x, 0});
  }
  static MVO_INLINE Floats all(float x) {
    using Four = float __attribute__((vector_size(16)));
    return __builtin_ia32_vbroadcastss_ps256(Four{x, 0, 0, 0});
  }
  static MVO_INLINE Doubles fused(Doubles a, Doubles b, Doubles c) {
    return __builtin_ia32_vfmaddpd256(a, b, c);
  }
  static MVO_INLINE Floats fused(Floats a, Floats b, Floats c) {
    return __builtin_ia32_vfmaddps256(a, b, c);
  }
  static MVO_INLINE Floats bytes(const std::uint8_t* from) {
    using Sixteen = char __attribute__((vector_size(16)));
    long long eight;
    std::memcpy(&eight, from, sizeof eight);
    using Two = long long __attribute__((vector_size(16)));
    return toFloats(Ints(__builtin_ia32_pmovzxbd256(Sixteen(Two{eight, 0}))));
  }
  static MVO_INLINE Floats root(Floats x) { return __builtin_ia32_sqrtps256(x); }
};
#elif defined(MVO_HAS_AVX2_KERNELS)
using Avx2 = Portable;
#endif

/// a * b + c on machine M, each of a and b lanes or a number.
template <typename M>
MVO_INLINE double fused(double a, double b, double c) {
  return M::fused(a, b, c);
}
template <typename M>
MVO_INLINE float fused(float a, float b, float c) {
  return M::fused(a, b, c);
}
template <typename M>
MVO_INLINE Doubles fused(Doubles a, Doubles b, Doubles c) {
  return M::fused(a, b, c);
}
template <typename M>
MVO_INLINE Doubles fused(Doubles a, double b, Doubles c) {
  return M::fused(a, M::all(b), c);
}
template <typename M>
MVO_INLINE Floats fused(Floats a, Floats b, Floats c) {
  return M::fused(a, b, c);
}
template <typename M>
MVO_INLINE Floats fused(float a, Floats b, Floats c) {
  return M::fused(M::all(a), b, c);
}

/// What kernels run as: as this machine does it best, or for tests and measurements as others do.
enum class Half { kMachine, kPortable, kTwoRoundings };

namespace detail {

inline std::atomic<Half> half{Half::kMachine};

#if defined(MVO_HAS_AVX2_KERNELS)
inline bool hasAvx2() {
  static const bool has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return has;
}
template <typename Kernel>
MVO_AVX2 auto onAvx2(const Kernel& kernel) {
  return kernel(Avx2{});
}
#endif

}  // namespace detail

/// Makes every kernel run as this half from here on.
inline void chooseHalf(Half half) { detail::half = half; }

/// Runs kernel(M{}), M being the machine; mark its call operator MVO_KERNEL.
#define MVO_KERNEL __attribute__((always_inline))
template <typename Kernel>
auto onThisMachine(const Kernel& kernel) {
  const Half half = detail::half.load(std::memory_order_relaxed);
  if (half == Half::kPortable) return kernel(Portable{});
#if defined(MVO_HAS_AVX2_KERNELS)
  if (half == Half::kMachine && detail::hasAvx2()) return detail::onAvx2(kernel);
#endif
#if defined(__FP_FAST_FMA) && defined(__FP_FAST_FMAF)
  if (half == Half::kMachine) return kernel(Portable{});
#endif
  return kernel(TwoRoundings{});
}

}  // namespace mvo
