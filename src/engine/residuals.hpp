// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// rho(p, l) of Eq. (2): every tracklet under every label, and the energy made of it.
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "engine/energy.hpp"
#include "mvo/options.hpp"
#include "mvo/stereo_camera.hpp"
#include "mvo/types.hpp"

namespace mvo {

class TrackArrays;

/// Residuals of N tracklets under L labels [px], maxima over the window's pairs, the dead zone not
/// yet taken off.
struct ResidualTable {
  Eigen::MatrixXd worst;  ///< pairs for which the label has no transform count e_th; kInadmissible
                          ///< without a shared pair
  Eigen::MatrixXd overlap;  ///< over shared pairs only (III-D); kInadmissible without one
};

/// Computes the table's columns and keeps them by the labels' keys: within one window a label's
/// trajectory never changes, so rounds pay for new labels only.
class ResidualCache {
 public:
  ResidualCache(const Window& window, const StereoCamera& camera, const NoiseOptions& noise,
                const EnergyOptions& options);

  ResidualTable table(const std::vector<Label>& labels);
  /// Over shared pairs, of one label; entries are in the order of the window's tracklets.
  const Eigen::VectorXd& overlap(const Label& label);

 private:
  struct Column {
    Eigen::VectorXd worst;
    Eigen::VectorXd overlap;
  };
  const Column& column(const Label& label);

  const Window& window_;
  StereoCamera camera_;
  NoiseOptions noise_;
  EnergyOptions options_;
  std::shared_ptr<const TrackArrays> tracks_;       // the window, as the residuals read it
  std::map<std::pair<bool, int>, Column> columns_;  // by Label::key()
};

/// Median residual [px] of a label's support, given the label's column of residuals; 0 without one.
double typicalResidual(const std::vector<int>& support,
                       const Eigen::Ref<const Eigen::VectorXd>& overlap);

/// rho from a residual: zero inside the dead zone, linear beyond; kInadmissible stays.
double dataCost(double residual, const EnergyOptions& options);

/// Eq. (2). The outlier label's cost is taken over all labels of the table and held from here on.
Energy makeEnergy(const ResidualTable& table, const Graph& graph, const EnergyOptions& options);

}  // namespace mvo
