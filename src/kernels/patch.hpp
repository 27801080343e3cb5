// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The inner loops of the front end on plain memory: patches of 8-bit images, eight pixels at a
// time. They use AVX2 where the machine has it, chosen at run time, so the library needs no machine
// flags.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/lanes.hpp"

namespace mvo {

constexpr int paddedToLanes(int n) { return (n + kFloats - 1) / kFloats * kFloats; }

/// A grey image; pixels kFloats beyond those asked for must be readable.
struct GreyImage {
  const std::uint8_t* data = nullptr;  ///< pixel (0, 0)
  std::ptrdiff_t step = 0;             ///< bytes from row to row
};

/// A square patch as Lucas-Kanade needs it: `side` rows of paddedToLanes(side) values and
/// gradients, zero beyond the side. The values have no mean; the gradients have none either and
/// nothing along the values, so sums of an image with them do not see its gain and offset.
struct FlowPatch {
  float* values = nullptr;  ///< [grey levels]
  float* gx = nullptr;      ///< [grey levels / px]
  float* gy = nullptr;
  float square = 0;  ///< sum of the values' squares
  float hxx = 0;     ///< sums of the gradients' products
  float hxy = 0;
  float hyy = 0;
};

/// Values that taking a patch needs room for: one pixel more on every side, and lanes that reach
/// beyond the last row. They must be finite: what is there is multiplied by zero.
constexpr int flowRoom(int side) { return (side + 2) * paddedToLanes(side + 2) + kFloats; }

/// Reads a patch around (u, v) [px].
void takeFlowPatch(const GreyImage& image, float u, float v, int side, float* room,
                   FlowPatch& patch);

/// Sums image * (gx, gy, values), the image's patch being around (u, v).
struct FlowSums {
  float x = 0;
  float y = 0;
  float product = 0;
};
FlowSums flowSums(const GreyImage& image, float u, float v, int side, const FlowPatch& patch);

/// What an affine alignment needs of the warped samples s_i = image(A x_i + t) - offset.
struct AffineSums {
  float mean = 0;      ///< sum w s
  float square = 0;    ///< sum w s^2
  float product = 0;   ///< sum w s value
  float descent[6]{};  ///< sum s descent_r
};

/// A patch of n pixels (a multiple of kFloats) at places x_i, y_i with weights and values; what
/// lies beyond the patch has no weight, and its place is the centre.
struct AffinePatch {
  int n = 0;
  const float* x = nullptr;
  const float* y = nullptr;
  const float* weight = nullptr;
  const float* value = nullptr;
  const float* descent = nullptr;  ///< six rows of n
  float offset = 0;                ///< [grey levels]
};

/// `warp` is A row by row, then t [px]. All places lie in the image, two pixels from its end.
AffineSums affineSums(const GreyImage& image, const float (&warp)[6], const AffinePatch& patch);

/// Normalised correlations of a patch of `side` x `side` values with zero mean and unit norm with
/// those whose first pixels are `corner` + 0 .. count - 1 in a row; 0 where there is no texture.
void rowCorrelations(const std::uint8_t* corner, std::ptrdiff_t step, int side, const float* patch,
                     int count, float* correlations);

}  // namespace mvo
