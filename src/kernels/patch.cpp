// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/patch.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

// Clang knows no such pragma; what it builds is portable.
#if defined(__x86_64__) && !defined(__clang__)
#define MVO_PATCH_HAS_AVX2
#include <immintrin.h>
#endif

namespace mvo {

namespace portable {
#include "kernels/patch.inl"
}  // namespace portable

#ifdef MVO_PATCH_HAS_AVX2
#pragma GCC push_options
#pragma GCC target("avx2,fma")
#define MVO_KERNELS_USE_AVX2
namespace avx2 {
#include "kernels/patch.inl"
}  // namespace avx2
#undef MVO_KERNELS_USE_AVX2
#pragma GCC pop_options

#define MVO_DISPATCH(call) return usesAvx2() ? avx2::call : portable::call
#else
#define MVO_DISPATCH(call) return portable::call
#endif

void takeFlowPatch(const GreyImage& image, float u, float v, int side, float* room,
                   FlowPatch& patch) {
  MVO_DISPATCH(takeFlowPatch(image, u, v, side, room, patch));
}

FlowSums flowSums(const GreyImage& image, float u, float v, int side, const FlowPatch& patch) {
  MVO_DISPATCH(flowSums(image, u, v, side, patch));
}

AffineSums affineSums(const GreyImage& image, const float (&warp)[6], const AffinePatch& patch) {
  MVO_DISPATCH(affineSums(image, warp, patch));
}

void rowCorrelations(const std::uint8_t* corner, std::ptrdiff_t step, int side, const float* patch,
                     int count, float* correlations) {
  MVO_DISPATCH(rowCorrelations(corner, step, side, patch, count, correlations));
}

void gradientProducts(const std::uint8_t* row, std::ptrdiff_t step, int width, float* xx, float* xy,
                      float* yy) {
  MVO_DISPATCH(gradientProducts(row, step, width, xx, xy, yy));
}

void cornerScores(const float* const (&rows)[3][kCornerBlock], int width, float* columns,
                  float* scores) {
  MVO_DISPATCH(cornerScores(rows, width, columns, scores));
}

void markPeaks(const float* const (&rows)[3], int width, float least, std::uint8_t* marks) {
  MVO_DISPATCH(markPeaks(rows, width, least, marks));
}

}  // namespace mvo
