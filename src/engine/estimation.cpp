// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/engine/estimation.hpp"

#include <algorithm>

namespace mvo {

namespace {

constexpr double kMinDisparity = 0.05;  // of a first guess; the batch may move it farther [px]

struct Run {
  FrameId first = 0;
  FrameId last = -1;
  int frames() const { return static_cast<int>(last - first + 1); }
};

// The newest run of frames that belong to one segment of the hypothesis, each tied to the one
// before by enough tracklets; a longer one before it wins only if the newest is a single frame.
Run newestRun(const Window& window, const Trajectory& hypothesis, const std::vector<int>& support,
              int least) {
  std::vector<int> ties(window.frames(), 0);
  for (const int p : support) {
    const auto& o = window.tracklets[p].observations;
    for (std::size_t j = 1; j < o.size(); ++j)
      for (FrameId k = o[j - 1].frame + 1; k <= o[j].frame; ++k) ++ties[k - window.first_frame];
  }
  Run run;
  for (FrameId k = window.last_frame; k > window.first_frame; --k) {
    const bool tied =
        ties[k - window.first_frame] >= least && hypothesis.between(k, k - 1).has_value();
    if (tied && run.last < run.first)
      run = {k - 1, k};
    else if (tied)
      run.first = k - 1;
    else if (run.frames() > 1)
      break;
  }
  return run;
}

}  // namespace

std::optional<LabelEstimate> estimateLabel(const Window& window, const StereoCamera& camera,
                                           const Trajectory& hypothesis,
                                           const std::vector<int>& support,
                                           const LandmarkMap* start, const Options& options,
                                           int iterations) {
  const Run run =
      newestRun(window, hypothesis, support, options.bundle_adjustment.min_observations);
  if (run.frames() < 2) return std::nullopt;

  Batch batch;
  batch.first_frame = run.first;
  for (FrameId k = run.first; k <= run.last; ++k)
    batch.T_ck_c1.push_back(*hypothesis.between(k, run.first));
  std::optional<Eigen::Isometry3d> T_c1_start;
  if (start != nullptr) T_c1_start = hypothesis.between(run.first, start->frame);
  for (const int p : support) {
    const Tracklet& t = window.tracklets[p];
    Batch::Landmark landmark;
    landmark.id = t.id;
    for (const Observation& o : t.observations)
      if (o.frame >= run.first && o.frame <= run.last) landmark.observations.push_back(o);
    if (landmark.observations.size() < 2) continue;
    const auto known = T_c1_start ? start->p_c.find(t.id) : decltype(start->p_c.end()){};
    if (T_c1_start && known != start->p_c.end()) {
      landmark.p_c1 = T_c1_start->matrix() * known->second;
    } else {
      // From where it was seen nearest.
      const auto nearest =
          std::max_element(landmark.observations.begin(), landmark.observations.end(),
                           [](const Observation& a, const Observation& b) {
                             return a.y.x() - a.y.z() < b.y.x() - b.y.z();
                           });
      Eigen::Vector3d y = nearest->y;
      y.z() = std::min(y.z(), y.x() - kMinDisparity);
      landmark.p_c1 = batch.T_ck_c1[nearest->frame - run.first].inverse().matrix() *
                      camera.backProject(y).homogeneous();
    }
    batch.landmarks.push_back(std::move(landmark));
  }

  LabelEstimate estimate;
  estimate.summary =
      adjustBundle(batch, camera, options.noise, options.bundle_adjustment, iterations);
  if (!estimate.summary.usable) return std::nullopt;
  estimate.trajectory.first_frame = run.first;
  estimate.trajectory.segment.assign(batch.T_ck_c1.size(), 0);
  estimate.trajectory.T_ck_c1 = std::move(batch.T_ck_c1);
  estimate.landmarks.frame = run.first;
  for (const Batch::Landmark& landmark : batch.landmarks)
    estimate.landmarks.p_c.emplace(landmark.id, landmark.p_c1);
  return estimate;
}

}  // namespace mvo
