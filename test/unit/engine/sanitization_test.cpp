// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-E by hand: small and short labels, bad tracklets, redundant labels that the graph kept apart.
#include "engine/sanitization.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace mvo {
namespace {

const StereoCamera kCamera{500, 500, 319.5, 239.5, 0.24, 640, 480};

// Points at rest seen by a camera at rest; each takes the steps that it is told.
struct Scene {
  Window window{0, 5, {}};
  Labeling labels;

  void add(int count, int label, FrameId first, int frames, double step) {
    for (int i = 0; i < count; ++i) {
      const double u = 20 + 7.0 * static_cast<double>(window.tracklets.size());
      Tracklet t{static_cast<TrackletId>(window.tracklets.size()), {}};
      for (int k = 0; k < frames; ++k)
        t.observations.push_back({first + k, {u + step * k, 240, u + step * k - 30}});
      window.tracklets.push_back(t);
      labels.assignment.push_back(label);
    }
  }
  // A label that stands still, or moves all that it sees by so many pixels a frame.
  void addLabel(double px) {
    Label label;
    label.proposal = static_cast<int>(labels.labels.size());
    const double z = 500 * 0.24 / 30;
    for (int k = 0; k < window.frames(); ++k) {
      label.trajectory.T_ck_c1.emplace_back(Eigen::Translation3d(px * k * z / 500, 0, 0));
      label.trajectory.segment.push_back(0);
    }
    labels.labels.push_back(label);
  }
  // Labels from this one on are new, unless all are.
  Labeling sanitized(const Options& options = {}, int known = 0) const {
    Labeling labels_known = labels;
    for (int l = 0; l < known; ++l) labels_known.labels[l].known = l;
    ResidualCache cache(window, kCamera, options.noise, options.energy);
    Graph graph;
    graph.neighbors.resize(window.tracklets.size());
    return sanitizeLabels(window, graph, cache, labels_known, options.energy, options.engine,
                          known > 0);
  }
};

TEST(Sanitization, FewerThanTenTrackletsAreOutliers) {
  for (const int count : {9, 10}) {
    Scene scene;
    scene.addLabel(0);
    scene.addLabel(5);
    scene.add(20, 0, 0, 6, 0);
    scene.add(count, 1, 0, 6, 5);
    const Labeling result = scene.sanitized();
    EXPECT_EQ(result.labels.size(), count == 10 ? 2U : 1U);
    EXPECT_EQ(static_cast<int>(result.support(kOutlier).size()), count == 10 ? 0 : 9);
    EXPECT_EQ(result.support(0).size(), 20U);
  }
}

TEST(Sanitization, FewerThanThreeFramesAreOutliers) {
  for (const int frames : {2, 3}) {
    Scene scene;
    scene.addLabel(0);
    scene.addLabel(5);
    scene.add(20, 0, 0, 6, 0);
    scene.add(20, 1, 2, frames, 5);
    EXPECT_EQ(scene.sanitized().labels.size(), frames == 3 ? 2U : 1U);
  }
}

TEST(Sanitization, AWindowOfTwoFramesHasMotionsOfTwoFrames) {
  Scene scene;
  scene.window.last_frame = 1;
  scene.addLabel(0);
  scene.add(20, 0, 0, 2, 0);
  EXPECT_EQ(scene.sanitized().labels.size(), 1U);
}

TEST(Sanitization, TrackletsAboveTheThresholdAreOutliers) {
  Scene scene;
  scene.addLabel(0);
  scene.add(20, 0, 0, 6, 0);
  scene.add(1, 0, 0, 2, 1.4);
  scene.add(1, 0, 0, 2, 1.7);
  Options options;
  options.energy.threshold = 1.5;  // e_th [px]
  const Labeling result = scene.sanitized(options);
  EXPECT_EQ(result.assignment[20], 0);
  EXPECT_EQ(result.assignment[21], kOutlier);
}

TEST(Sanitization, ALabelThatGetsTooSmallByTheThresholdIsDropped) {
  Scene scene;
  scene.addLabel(0);
  scene.addLabel(5);
  scene.add(20, 0, 0, 6, 0);
  scene.add(9, 1, 0, 6, 5);
  scene.add(3, 1, 0, 6, 20);  // twelve, but nine that fit
  const Labeling result = scene.sanitized();
  EXPECT_EQ(result.labels.size(), 1U);
  EXPECT_EQ(result.support(kOutlier).size(), 12U);
}

TEST(Sanitization, RedundantLabelsMergeThoughNoEdgeJoinsThem) {
  Scene scene;
  scene.addLabel(0);
  scene.addLabel(0.1);
  scene.add(20, 0, 0, 6, 0);
  scene.add(20, 1, 0, 6, 0.1);
  const Labeling result = scene.sanitized();
  EXPECT_EQ(result.labels.size(), 1U);
  EXPECT_EQ(result.support(0).size(), 40U);
}

// How well the others fit, and whether it was missed before, is nothing to it.
TEST(Sanitization, AWarmStartKeepsWhatAColdOneKeeps) {
  for (const double wobble : {0.1, 0.8})  // [px]
    for (const double worlds : {0.0, 0.8})
      for (const int known : {0, 1, 2}) {
        Scene scene;
        scene.addLabel(0);
        scene.addLabel(5);
        scene.add(20, 0, 0, 6, 0);
        scene.add(12, 1, 0, 6, 5);
        for (std::size_t p = 0; p < scene.window.tracklets.size(); ++p)
          for (Observation& o : scene.window.tracklets[p].observations)
            o.y.y() += (p < 20 ? worlds : wobble) * (o.frame % 2 == 0 ? 0.5 : -0.5);
        EXPECT_EQ(scene.sanitized({}, known).labels.size(), 2U)
            << wobble << ' ' << worlds << ' ' << known;
      }
}

TEST(Sanitization, ANewMotionMustBeInView) {
  for (const FrameId last : {4, 5}) {
    Scene scene;
    scene.addLabel(0);
    scene.addLabel(5);
    scene.add(20, 0, 0, 6, 0);
    scene.add(12, 1, last - 3, 4, 5);
    EXPECT_EQ(scene.sanitized({}, 1).labels.size(), last == 5 ? 2U : 1U);
    EXPECT_EQ(scene.sanitized({}, 2).labels.size(), 2U) << "known ones may fade";
  }
}

TEST(Sanitization, TrackletsThatEndedDoNotHoldANewMotionDown) {
  for (const int seen : {9, 10}) {
    Scene scene;
    scene.addLabel(0);
    scene.addLabel(5);
    scene.add(40, 0, 0, 6, 0);
    scene.add(30, 1, 0, 5, 5);  // gone before the newest frame
    scene.add(seen, 1, 0, 6, 5);
    EXPECT_EQ(scene.sanitized({}, 1).labels.size(), seen == 10 ? 2U : 1U);
  }
}

TEST(Sanitization, WithoutLabelsOrTracklets) {
  EXPECT_TRUE(Scene().sanitized().assignment.empty());
  Scene outliers;
  outliers.add(5, kOutlier, 0, 6, 1);
  EXPECT_EQ(outliers.sanitized().assignment, std::vector<int>(5, kOutlier));
}

}  // namespace
}  // namespace mvo
