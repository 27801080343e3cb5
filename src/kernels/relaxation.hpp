// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The iteration of the convex relaxation on plain memory, vectorised over labels (edges, label
// costs) and over tracklets (simplices). Uses AVX2 where the machine has it, chosen at run time.
#pragma once

#include "kernels/lanes.hpp"

namespace mvo {

/// The saddle point of coral.hpp. Arrays are `width` labels for each tracklet or edge. Labels
/// beyond the problem's cost more than any other, tracklets beyond it have no edges and cost
/// nothing.
struct SaddlePoint {
  int width = 0;      ///< labels, padded
  int tracklets = 0;  ///< without padding
  int edges = 0;
  const int* ends = nullptr;            ///< two tracklets per edge
  const double* half_weight = nullptr;  ///< per edge: w / 2
  const double* gamma = nullptr;        ///< per label, 0 without a cost
  const double* rho = nullptr;
  const double* step = nullptr;    ///< per tracklet, also the padding: of the descent of u
  double* u = nullptr;             ///< shares
  double* extrapolated = nullptr;  ///< 2 u - the u before
  double* y = nullptr;             ///< per edge
  double* z = nullptr;             ///< per tracklet
  double* level = nullptr;         ///< per label: what the last projection of z took away
  double* cost = nullptr;          ///< rho + K^T (y, z)
  double* scratch = nullptr;       ///< kDoubles * width
};

/// Descends u along `cost` and projects it onto the simplices; extrapolates.
void descendShares(const SaddlePoint& s);

/// Ascends y and z along the extrapolated shares, projects them, and sums up the new cost.
void ascendPrices(const SaddlePoint& s, double balance);

}  // namespace mvo
