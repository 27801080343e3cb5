// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/corners.hpp"

#include <algorithm>
#include <cstring>

#include "kernels/lanes.hpp"

namespace mvo {

namespace {

// Smaller eigenvalue of ((xx, xy), (xy, yy)).
template <typename M>
MVO_INLINE Floats smallerEigenvalue(const Floats& xx, const Floats& xy, const Floats& yy) {
  const Floats mean = 0.5F * (xx + yy);
  const Floats difference = 0.5F * (xx - yy);
  return mean - M::root(fused<M>(difference, difference, xy * xy));
}

template <typename M>
MVO_INLINE void gradientProductsOn(const std::uint8_t* row, std::ptrdiff_t step, int width,
                                   float* xx, float* xy, float* yy) {
  constexpr float scale = 0.125F;  // Sobel's
  for (int start = 0; start < width; start += kFloats) {
    const int u = std::min(start, width - kFloats);
    const std::uint8_t* p = row + u;
    const Floats above_left = M::bytes(p - step - 1);
    const Floats above_right = M::bytes(p - step + 1);
    const Floats below_left = M::bytes(p + step - 1);
    const Floats below_right = M::bytes(p + step + 1);
    const Floats right = M::bytes(p + 1) - M::bytes(p - 1);
    const Floats down = M::bytes(p + step) - M::bytes(p - step);
    const Floats gx =
        scale * fused<M>(2.0F, right, above_right - above_left + below_right - below_left);
    const Floats gy =
        scale * fused<M>(2.0F, down, below_left - above_left + below_right - above_right);
    store(xx + u, gx * gx);
    store(xy + u, gx * gy);
    store(yy + u, gy * gy);
  }
}

template <typename M>
MVO_INLINE void cornerScoresOn(const float* const (&rows)[3][kCornerBlock], int width,
                               float* columns, float* scores) {
  constexpr float share = 1.0F / (kCornerBlock * kCornerBlock);
  const int wide = width + kCornerBlock - 1;
  for (int k = 0; k < 3; ++k)
    for (int start = 0; start < wide; start += kFloats) {
      const int u = std::min(start, wide - kFloats);
      Floats sum = load(rows[k][0] + u);
      for (int y = 1; y < kCornerBlock; ++y) sum += load(rows[k][y] + u);
      store(columns + k * wide + u, share * sum);
    }
  for (int start = 0; start < width; start += kFloats) {
    const int u = std::min(start, width - kFloats);
    Floats sums[3];
    for (int k = 0; k < 3; ++k) {
      sums[k] = load(columns + k * wide + u);
      for (int x = 1; x < kCornerBlock; ++x) sums[k] += load(columns + k * wide + u + x);
    }
    store(scores + u, smallerEigenvalue<M>(sums[0], sums[1], sums[2]));
  }
}

template <typename M>
MVO_INLINE void markPeaksOn(const float* const (&rows)[3], int width, float least,
                            std::uint8_t* marks) {
  for (int start = 0; start < width; start += kFloats) {
    const int u = std::min(start, width - kFloats);
    const Floats centre = load(rows[1] + u);
    Ints peak = centre > least;
    for (const float* row : rows)
      for (int x = -1; x <= 1; ++x) peak &= centre >= load(row + u + x);
    const Bytes bytes = __builtin_convertvector(peak, Bytes);
    std::memcpy(marks + u, &bytes, sizeof bytes);
  }
}

}  // namespace

void gradientProducts(const std::uint8_t* row, std::ptrdiff_t step, int width, float* xx, float* xy,
                      float* yy) {
  onThisMachine([&](auto machine) MVO_KERNEL {
    return gradientProductsOn<decltype(machine)>(row, step, width, xx, xy, yy);
  });
}

void cornerScores(const float* const (&rows)[3][kCornerBlock], int width, float* columns,
                  float* scores) {
  onThisMachine([&](auto machine) MVO_KERNEL {
    return cornerScoresOn<decltype(machine)>(rows, width, columns, scores);
  });
}

void markPeaks(const float* const (&rows)[3], int width, float least, std::uint8_t* marks) {
  onThisMachine([&](auto machine) MVO_KERNEL {
    return markPeaksOn<decltype(machine)>(rows, width, least, marks);
  });
}

}  // namespace mvo
