// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/estimation.hpp"

#include <algorithm>
#include <numeric>
#include <opencv2/core/utility.hpp>

#include "engine/batch/bundle_adjustment.hpp"

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
  // A tracklet ties each of its frames but the first: from there up, after its last down again.
  std::vector<int> ties(window.frames() + 1, 0);
  for (const int p : support) {
    const Tracklet& t = window.tracklets[p];
    if (t.first() == t.last()) continue;
    ++ties[t.first() + 1 - window.first_frame];
    --ties[t.last() + 1 - window.first_frame];
  }
  std::partial_sum(ties.begin(), ties.end(), ties.begin());
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

// A tracklet's observations in a run; its landmark is still unknown.
BatchTrack within(const Tracklet& tracklet, const Run& run) {
  const auto& o = tracklet.observations;
  const auto frameBefore = [](const Observation& a, FrameId frame) { return a.frame < frame; };
  const auto begin = std::lower_bound(o.begin(), o.end(), run.first, frameBefore);
  const auto end = std::lower_bound(begin, o.end(), run.last + 1, frameBefore);
  return {Eigen::Vector4d::Zero(), o.data() + (begin - o.begin()), o.data() + (end - o.begin())};
}

// A landmark from where it was seen nearest.
Eigen::Vector4d firstGuess(const BatchTrack& track, const std::vector<Eigen::Isometry3d>& T_ck_c1,
                           FrameId first_frame, const StereoCamera& camera) {
  const Observation& nearest =
      *std::max_element(track.begin, track.end, [](const Observation& a, const Observation& b) {
        return a.y.x() - a.y.z() < b.y.x() - b.y.z();
      });
  Eigen::Vector3d y = nearest.y;
  y.z() = std::min(y.z(), y.x() - kMinDisparity);
  return T_ck_c1[nearest.frame - first_frame].inverse().matrix() *
         camera.backProject(y).homogeneous();
}

const Eigen::Vector4d* knownLandmark(const LandmarkMap& landmarks, TrackletId id) {
  const auto it = landmarks.p_c.find(id);
  return it == landmarks.p_c.end() ? nullptr : &it->second;
}

// A label's batch over a run of frames, and whose landmarks it has.
struct LabelBatch {
  Bundle bundle;
  std::vector<TrackletId> ids;  // of the tracks
};

LabelBatch batchOf(const Window& window, const StereoCamera& camera, const Trajectory& hypothesis,
                   const std::vector<int>& support, const BatchStart& start, const Run& run) {
  LabelBatch batch;
  Bundle& bundle = batch.bundle;
  bundle.first_frame = run.first;
  bundle.T_ck_c1.reserve(run.frames());
  for (FrameId k = run.first; k <= run.last; ++k)
    bundle.T_ck_c1.push_back(*hypothesis.between(k, run.first));
  std::optional<Eigen::Isometry3d> T_c1_start;
  if (start.landmarks != nullptr)
    T_c1_start = hypothesis.between(run.first, start.landmarks->frame);
  batch.ids.reserve(support.size());
  bundle.tracks.reserve(support.size());
  for (const int p : support) {
    const Tracklet& t = window.tracklets[p];
    BatchTrack track = within(t, run);
    if (track.end - track.begin < 2) continue;
    const Eigen::Vector4d* known = T_c1_start ? knownLandmark(*start.landmarks, t.id) : nullptr;
    track.is_known = known != nullptr;
    track.p_c1 = known != nullptr ? Eigen::Vector4d(T_c1_start->matrix() * *known)
                                  : firstGuess(track, bundle.T_ck_c1, run.first, camera);
    batch.ids.push_back(t.id);
    bundle.tracks.push_back(track);
  }
  return batch;
}

// What is left of a run without a frame that has too little to say: the newer part, or the older
// one if it is the newest.
Run without(const Run& run, FrameId weak) {
  return weak == run.last ? Run{run.first, weak - 1} : Run{weak + 1, run.last};
}

std::optional<LabelEstimate> estimateLabel(const Window& window, const StereoCamera& camera,
                                           const Trajectory& hypothesis,
                                           const std::vector<int>& support, const BatchStart& start,
                                           int min_observations, BundleAdjuster& adjuster) {
  Run run = newestRun(window, hypothesis, support, min_observations);
  while (run.frames() >= 2) {
    LabelBatch batch = batchOf(window, camera, hypothesis, support, start, run);
    LabelEstimate estimate;
    estimate.summary = adjuster.adjust(batch.bundle, {start.iterations, start.wants_covariance});
    if (!estimate.summary.usable) {
      const auto weak = adjuster.newestWeakFrame(batch.bundle);
      if (!weak) return std::nullopt;
      run = without(run, *weak);
      continue;
    }
    estimate.trajectory.first_frame = run.first;
    estimate.trajectory.segment.assign(batch.bundle.T_ck_c1.size(), 0);
    estimate.trajectory.T_ck_c1 = std::move(batch.bundle.T_ck_c1);
    estimate.landmarks.frame = run.first;
    estimate.landmarks.p_c.reserve(batch.ids.size());
    for (std::size_t j = 0; j < batch.ids.size(); ++j)
      estimate.landmarks.p_c.set(batch.ids[j], batch.bundle.tracks[j].p_c1);
    return estimate;
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::optional<LabelEstimate>> estimateLabels(
    const Window& window, const StereoCamera& camera, const Labeling& labels,
    const std::vector<BatchStart>& starts, const NoiseOptions& noise,
    const BundleAdjustmentOptions& options, BatchMemory& memory) {
  const int count = static_cast<int>(labels.labels.size());
  std::vector<std::vector<int>> supports;
  std::vector<int> large;
  std::vector<int> small;
  for (int l = 0; l < count; ++l) {
    supports.push_back(labels.support(l));
    std::size_t observations = 0;
    for (const int p : supports[l]) observations += window.tracklets[p].observations.size();
    (isBatchSplit(observations) ? large : small).push_back(l);
  }
  std::vector<std::optional<LabelEstimate>> estimates(count);
  const auto estimate = [&](int l, BundleAdjuster& adjuster) {
    estimates[l] = estimateLabel(window, camera, labels.labels[l].trajectory, supports[l],
                                 starts[l], options.min_observations, adjuster);
  };
  if (!large.empty()) {
    BundleAdjuster adjuster(camera, noise, options, memory);
    for (const int l : large) estimate(l, adjuster);
  }
  cv::parallel_for_(cv::Range(0, static_cast<int>(small.size())), [&](const cv::Range& range) {
    BundleAdjuster adjuster(camera, noise, options, memory);
    for (int i = range.start; i < range.end; ++i) estimate(small[i], adjuster);
  });
  return estimates;
}

}  // namespace mvo
