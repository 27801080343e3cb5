// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/row_band.hpp"

namespace mvo {

namespace {
constexpr float kDeviations = 2;  // of the rows, that a match may be off by
}  // namespace

RowBand expectedRows(const Eigen::Vector3d& y, const TrackingPrior& prior,
                     const StereoCamera& camera, const FrontendOptions& options) {
  const auto reach = static_cast<float>(options.max_epipolar);
  if (!prior.errors) return {0, reach};
  const auto rows = prior.errors->rows(camera, y);
  return {static_cast<float>(rows.mean), reach + kDeviations * static_cast<float>(rows.deviation)};
}

}  // namespace mvo
