// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/camera/error_influence.hpp"

#include <utility>

#include "mvo/se3.hpp"

namespace mvo {

namespace {

constexpr std::size_t kEnough = 60;  // tracklets that tell what all of a label do

// Of a label's tracklets that are seen in both of two frames, as many as are enough, evenly.
std::vector<int> some(const Window& window, const std::vector<int>& support, FrameId a, FrameId b) {
  std::vector<int> common;
  for (const int p : support) {
    const Tracklet& t = window.tracklets[p];
    if (t.first() <= a && t.last() >= b) common.push_back(p);
  }
  if (common.size() <= kEnough) return common;
  std::vector<int> chosen;
  for (std::size_t i = 0; i < kEnough; ++i) chosen.push_back(common[i * common.size() / kEnough]);
  return chosen;
}

}  // namespace

void ErrorInfluence::addTo(Segmentation& segmentation, const Window& corrected,
                           const CameraErrors& errors, const LinkResidual& residual) {
  const ErrorMatrix& covariance = errors.estimate().covariance;
  std::map<LabelId, Steps> all;
  for (std::size_t l = 0; l < segmentation.estimates.size(); ++l) {
    auto& estimate = segmentation.estimates[l];
    const LabelId id = segmentation.labeling.labels[l].id;
    if (!estimate || id == kOutlier) continue;
    const Trajectory& trajectory = estimate->trajectory;
    const std::vector<int> support = segmentation.labeling.support(static_cast<int>(l));
    const Steps& known = steps_[id];
    Steps steps;
    Influence window = Influence::Zero();
    Influence step = Influence::Zero();
    for (FrameId k = trajectory.first_frame + 1; k <= trajectory.lastFrame(); ++k) {
      const auto T_k_km1 = trajectory.between(k, k - 1);
      if (!T_k_km1) continue;
      const auto before = known.find(k);
      if (before != known.end()) {
        step = before->second;
      } else if (const auto now = errors.motionByErrors(
                     corrected, k - 1, k, *T_k_km1, some(corrected, support, k - 1, k), residual)) {
        step = *now;
      }  // else it is as in the frame before
      steps.emplace(k, step);
      window = step + adjoint(*T_k_km1) * window;
    }
    estimate->summary.covariance += window * covariance * window.transpose();
    estimate->summary.step_covariance += step * covariance * step.transpose();
    all.insert_or_assign(id, std::move(steps));
  }
  steps_ = std::move(all);
}

}  // namespace mvo
