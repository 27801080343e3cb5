// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/feature_tracker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include "frontend/keypoints.hpp"
#include "mvo/sim.hpp"
#include "statistics.hpp"
#include "support/textures.hpp"
#include "support/tracked_window.hpp"

namespace mvo {
namespace {

using test::trackFrame;
using test_support::randomTexture;
using test_support::translated;

constexpr int kFrames = 6;
constexpr int kFirst = 20;

sim::Scene sceneOf(const std::string& name, bool rgbd) {
  sim::SceneOptions options;
  options.width = 480;
  options.height = 360;
  options.rgbd = rgbd;
  return sim::makeScene(name, 3, options);
}

struct Sequence {
  sim::Scene scene;
  std::vector<sim::RenderedFrame> frames;
};

const Sequence& blocks(bool rgbd) {
  const auto rendered = [](bool as_rgbd) {
    Sequence sequence{sceneOf("blocks", as_rgbd), {}};
    for (int k = 0; k < kFrames; ++k)
      sequence.frames.push_back(sim::render(sequence.scene, kFirst + k));
    return sequence;
  };
  static const Sequence stereo = rendered(false);
  static const Sequence depth = rendered(true);
  return rgbd ? depth : stereo;
}

using Links = std::vector<std::vector<Feature>>;

Links trackAll(const Sequence& sequence, Tracker tracker) {
  FrontendOptions options;
  options.tracker = tracker;
  FeatureTracker features(1);
  Links links;
  for (const auto& frame : sequence.frames)
    links.push_back(trackFrame(features, sim::toFrame(frame), {}, sequence.scene.camera, options));
  return links;
}

// Inverse depth of a point on a smooth surface; none near edges.
std::optional<double> inverseDepth(const sim::RenderedFrame& frame, const Eigen::Vector3d& y) {
  constexpr int kReach = 4;
  const int u = static_cast<int>(std::floor(y.x()));
  const int v = static_cast<int>(std::floor(y.y()));
  const cv::Rect around(u - kReach, v - kReach, 2 * kReach + 2, 2 * kReach + 2);
  if ((around & cv::Rect({0, 0}, frame.depth.size())) != around) return std::nullopt;
  double low = 0;
  double high = 0;
  cv::minMaxLoc(frame.depth(around), &low, &high);
  if (high > 1.05 * low) return std::nullopt;
  cv::minMaxLoc(frame.mask(around), &low, &high);
  if (high > low) return std::nullopt;
  const auto w = [&](int du, int dv) { return 1.0 / frame.depth.at<float>(v + dv, u + du); };
  const double a = y.x() - u;
  const double b = y.y() - v;
  return (1 - b) * ((1 - a) * w(0, 0) + a * w(1, 0)) + b * ((1 - a) * w(0, 1) + a * w(1, 1));
}

// Where a point seen at `y` in a frame truly is in another frame.
Eigen::Vector3d truth(const Sequence& s, int from, int to, const Eigen::Vector3d& y, double w) {
  const StereoCamera& c = s.scene.camera;
  const auto& a = s.frames[from];
  const auto& b = s.frames[to];
  const int body = a.mask.at<uchar>(cvRound(y.y()), cvRound(y.x())) - 1;
  const Eigen::Vector3d p_a((y.x() - c.cu) / (c.fu * w), (y.y() - c.cv) / (c.fv * w), 1 / w);
  Eigen::Vector3d p_world = a.T_world_camera * p_a;
  if (body >= 0) p_world = b.T_world_bodies[body] * (a.T_world_bodies[body].inverse() * p_world);
  return c.project(b.T_world_camera.inverse() * p_world);
}

struct Case {
  Tracker tracker;
  bool rgbd;
};

class BothTrackers : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(StereoAndDepth, BothTrackers,
                         testing::Values(Case{Tracker::kKlt, false}, Case{Tracker::kKlt, true},
                                         Case{Tracker::kDescriptor, false},
                                         Case{Tracker::kDescriptor, true}),
                         [](const auto& c) {
                           return std::string(c.param.tracker == Tracker::kKlt ? "Klt" : "Desc") +
                                  (c.param.rgbd ? "Depth" : "Stereo");
                         });

TEST_P(BothTrackers, FollowWhatTheGeometrySays) {
  const Sequence& sequence = blocks(GetParam().rgbd);
  const Links links = trackAll(sequence, GetParam().tracker);
  std::map<TrackletId, std::pair<int, Feature>> born;
  std::vector<double> position;
  std::vector<double> disparity;
  int wrong = 0;
  for (int k = 0; k < kFrames; ++k)
    for (const Feature& f : links[k]) {
      const auto [it, fresh] = born.insert({f.id, {k, f}});
      if (fresh) continue;
      const auto& [from, start] = it->second;
      const auto w = inverseDepth(sequence.frames[from], start.y);
      if (!w) continue;
      const Eigen::Vector3d error = f.y - truth(sequence, from, k, start.y, *w);
      position.push_back(error.head<2>().norm());
      disparity.push_back(std::abs(error.x() - error.z()));
      if (position.back() > 3 || disparity.back() > 3) ++wrong;
    }
  ASSERT_GT(position.size(), 500U);
  EXPECT_LT(median(position), 0.15);
  EXPECT_LT(median(disparity), 0.15);
  EXPECT_LT(wrong, 0.03 * static_cast<double>(position.size()));
}

TEST_P(BothTrackers, IdsPersistAndAreNeverUsedTwice) {
  const Links links = trackAll(blocks(GetParam().rgbd), GetParam().tracker);
  std::set<TrackletId> all;
  std::map<TrackletId, int> last;
  int followed = 0;
  for (int k = 0; k < kFrames; ++k) {
    TrackletId before = -1;
    for (const Feature& f : links[k]) {
      EXPECT_GT(f.id, before) << "sorted";
      before = f.id;
      const auto known = last.find(f.id);
      if (known != last.end()) {
        EXPECT_GE(known->second, k - 2) << "longer lost than the gap allows";
        ++followed;
      } else if (!all.empty()) {
        EXPECT_GT(f.id, *all.begin());
      }
      last[f.id] = k;
      all.insert(f.id);
    }
  }
  EXPECT_GT(followed, 150 * (kFrames - 1)) << "points of a frame that the frame before had";
}

TEST_P(BothTrackers, SameResultFromAnyNumberOfThreads) {
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const Links one = trackAll(blocks(GetParam().rgbd), GetParam().tracker);
  cv::setNumThreads(2);
  const Links two = trackAll(blocks(GetParam().rgbd), GetParam().tracker);
  cv::setNumThreads(threads);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    ASSERT_EQ(one[k].size(), two[k].size()) << k;
    for (std::size_t i = 0; i < one[k].size(); ++i) {
      EXPECT_EQ(one[k][i].id, two[k][i].id);
      EXPECT_EQ(one[k][i].y, two[k][i].y) << "bit for bit";
    }
  }
}

TEST_P(BothTrackers, TheSurplusIsForgottenWhereNothingMoves) {
  const Sequence& sequence = blocks(GetParam().rgbd);
  FrontendOptions options;
  options.tracker = GetParam().tracker;
  options.max_features = 300;
  FeatureTracker tracker(1);
  const auto before =
      trackFrame(tracker, sim::toFrame(sequence.frames[0]), {}, sequence.scene.camera, options);
  ASSERT_GT(before.size(), 200U);
  TrackingPrior prior;
  for (std::size_t i = 0; i < before.size(); i += 6) prior.dense[before[i].id] = true;

  FeatureTracker unchanged = tracker;
  const auto all = trackFrame(unchanged, sim::toFrame(sequence.frames[1]), prior,
                              sequence.scene.camera, options);
  options.max_features = 100;
  const auto fewer =
      trackFrame(tracker, sim::toFrame(sequence.frames[1]), prior, sequence.scene.camera, options);
  EXPECT_LE(fewer.size(), 100U);
  std::set<TrackletId> kept;
  for (const Feature& f : fewer) kept.insert(f.id);
  int early = 0;
  int others = 0;
  for (const Feature& f : all) {
    if (f.id > before.back().id) continue;  // new
    if (prior.dense.count(f.id) != 0) {
      EXPECT_EQ(kept.count(f.id), 1U) << f.id;
    }
    if (prior.dense.count(f.id) != 0 || kept.count(f.id) == 0) continue;
    ++others;
    if (f.id < before[before.size() / 2].id) ++early;
  }
  EXPECT_GT(others, 20);
  EXPECT_NEAR(early, others / 2.0, others / 4.0) << "old and young alike";

  options.max_features = 20;  // fewer than those on bodies
  EXPECT_LE(
      trackFrame(tracker, sim::toFrame(sequence.frames[2]), prior, sequence.scene.camera, options)
          .size(),
      20U);
}

TEST_P(BothTrackers, NothingWithoutTexture) {
  const Sequence& sequence = blocks(GetParam().rgbd);
  FrontendOptions options;
  options.tracker = GetParam().tracker;
  FeatureTracker tracker(1);
  const Frame good = sim::toFrame(sequence.frames[0]);
  for (const int grey : {0, 255, 100}) {
    Frame frame = good;
    frame.left = cv::Mat(good.left.size(), CV_8U, cv::Scalar(grey));
    if (!good.right.empty()) frame.right = frame.left;
    EXPECT_TRUE(trackFrame(tracker, frame, {}, sequence.scene.camera, options).empty()) << grey;
  }
  EXPECT_GT(trackFrame(tracker, good, {}, sequence.scene.camera, options).size(), 150U)
      << "and goes on afterwards";
}

TEST_P(BothTrackers, PointsComeBackAfterOneBlackFrameButNotAfterTwo) {
  const Sequence& sequence = blocks(GetParam().rgbd);
  const Frame good = sim::toFrame(sequence.frames[0]);
  Frame black = good;
  black.left = cv::Mat(good.left.size(), CV_8U, cv::Scalar(0));
  if (!good.right.empty()) black.right = black.left;
  for (const int gap : {1, 2}) {
    FrontendOptions options;
    options.tracker = GetParam().tracker;
    FeatureTracker tracker(1);
    const auto before = trackFrame(tracker, good, {}, sequence.scene.camera, options);
    ASSERT_GT(before.size(), 150U);
    for (int i = 0; i < gap; ++i)
      EXPECT_TRUE(trackFrame(tracker, black, {}, sequence.scene.camera, options).empty());
    const auto after = trackFrame(tracker, good, {}, sequence.scene.camera, options);
    const auto kept = std::count_if(after.begin(), after.end(), [&before](const Feature& f) {
      return f.id <= before.back().id;
    });
    if (gap == 1) {
      EXPECT_GT(kept, 0.9 * static_cast<double>(before.size()));
    } else {
      EXPECT_EQ(kept, 0);
    }
  }
}

TEST_P(BothTrackers, PointsEndWhereTheMaskIsAndNewOnesKeepAway) {
  const Sequence& sequence = blocks(GetParam().rgbd);
  FrontendOptions options;
  options.tracker = GetParam().tracker;
  FeatureTracker tracker(1);
  const int middle = sequence.scene.camera.height / 2;
  const auto track = [&](FeatureTracker& with, int k, bool masked) {
    Frame frame = sim::toFrame(sequence.frames[k]);
    if (masked) {
      frame.mask = cv::Mat(frame.left.size(), CV_8U, cv::Scalar(255));
      frame.mask.rowRange(middle, frame.mask.rows).setTo(0);
    }
    return trackFrame(with, frame, {}, sequence.scene.camera, options);
  };
  const auto below = [middle](const std::vector<Feature>& features) {
    std::set<TrackletId> ids;
    for (const Feature& f : features)
      if (f.y.y() >= middle) ids.insert(f.id);
    return ids;
  };
  const auto before = track(tracker, 0, false);
  FeatureTracker unmasked = tracker;
  std::set<TrackletId> entering = below(track(unmasked, 1, false));
  for (auto it = entering.begin(); it != entering.end();)
    it = *it > before.back().id ? entering.erase(it) : std::next(it);
  ASSERT_GT(entering.size(), 50U);
  const auto masked = track(tracker, 1, true);
  EXPECT_GT(masked.size(), 50U) << "the rest goes on";
  EXPECT_TRUE(below(masked).empty());
  const auto after = track(tracker, 2, false);
  EXPECT_GT(below(after).size(), 50U);
  for (const Feature& f : after) EXPECT_EQ(entering.count(f.id), 0U) << f.id << " has ended";
}

class BothTrackersOnStereo : public testing::TestWithParam<Tracker> {};
INSTANTIATE_TEST_SUITE_P(Trackers, BothTrackersOnStereo,
                         testing::Values(Tracker::kKlt, Tracker::kDescriptor));

TEST_P(BothTrackersOnStereo, IdenticalImagesHaveNoDisparity) {
  const Sequence& sequence = blocks(false);
  FrontendOptions options;
  options.tracker = GetParam();
  FeatureTracker tracker(1);
  Frame frame = sim::toFrame(sequence.frames[0]);
  frame.right = frame.left.clone();
  for (int i = 0; i < 2; ++i)
    for (const Feature& f : trackFrame(tracker, frame, {}, sequence.scene.camera, options))
      EXPECT_GE(f.y.x() - f.y.z(), options.min_disparity) << "only mismatches are left";
  EXPECT_LT(trackFrame(tracker, frame, {}, sequence.scene.camera, options).size(), 10U);
}

// Half the exposure from one frame to the next, and a right eye that is darker all the time.
TEST(FeatureTracker, LightNeitherLosesNorMovesPoints) {
  const Sequence& sequence = blocks(false);
  const auto lit = [&](int k, double left, double right) {
    const Frame seen = sim::toFrame(sequence.frames[k]);
    Frame frame;
    seen.left.convertTo(frame.left, CV_8U, left, 5);
    seen.right.convertTo(frame.right, CV_8U, right);
    return frame;
  };
  const StereoCamera& camera = sequence.scene.camera;
  FeatureTracker plain(1);
  FeatureTracker changing(1);
  const auto born = trackFrame(plain, lit(0, 1, 0.6), {}, camera, {});
  ASSERT_EQ(trackFrame(changing, lit(0, 1, 0.6), {}, camera, {}).size(), born.size());
  EXPECT_GT(born.size(), 300U);
  const auto expected = trackFrame(plain, lit(1, 1, 0.6), {}, camera, {});
  const auto found = trackFrame(changing, lit(1, 0.5, 0.3), {}, camera, {});
  std::map<TrackletId, Eigen::Vector3d> places;
  for (const Feature& f : found) places[f.id] = f.y;
  std::vector<double> moved;
  int followed = 0;
  for (const Feature& f : expected) {
    if (f.id > born.back().id) continue;
    ++followed;
    if (const auto it = places.find(f.id); it != places.end())
      moved.push_back((it->second - f.y).norm());
  }
  EXPECT_GT(followed, 250);
  EXPECT_GT(static_cast<double>(moved.size()), 0.97 * followed);
  EXPECT_LT(median(moved), 0.03);
}

// A jump that only the prediction can bridge.
TEST_P(BothTrackersOnStereo, PredictionsAreUsed) {
  const cv::Size size(640, 480);
  const StereoCamera camera{500, 500, 320, 240, 0.2, size.width, size.height};
  const cv::Mat image = randomTexture(size, 4);
  constexpr int kJump = 140;
  constexpr int kDisparity = 25;
  const Frame first{1, image, translated(image, -kDisparity, 0), {}};
  const cv::Mat moved = translated(image, kJump, 0);
  const Frame second{2, moved, translated(moved, -kDisparity, 0), {}};
  FrontendOptions options;
  options.tracker = GetParam();
  FeatureTracker tracker(1);
  TrackingPrior prior;
  for (const Feature& f : trackFrame(tracker, first, {}, camera, options))
    prior.predicted[f.id] = f.y + Eigen::Vector3d(kJump + 1, 1, kJump + 1);
  const auto found = trackFrame(tracker, second, prior, camera, options);
  int followed = 0;
  for (const Feature& f : found) {
    const auto it = prior.predicted.find(f.id);
    if (it == prior.predicted.end()) continue;
    EXPECT_NEAR(f.y.x(), it->second.x() - 1, 0.3);
    EXPECT_NEAR(f.y.y(), it->second.y() - 1, 0.3);
    EXPECT_NEAR(f.y.x() - f.y.z(), kDisparity, 0.3);
    ++followed;
  }
  EXPECT_GT(followed, 150);
}

TEST(FeatureTracker, ImagesWithoutMatchGiveNothing) {
  const cv::Size size(480, 360);
  const StereoCamera camera{400, 400, 240, 180, 0.2, size.width, size.height};
  for (const Tracker tracker : {Tracker::kKlt, Tracker::kDescriptor}) {
    FrontendOptions options;
    options.tracker = tracker;
    FeatureTracker features(1);
    const auto seen = trackFrame(features, {1, randomTexture(size, 5), randomTexture(size, 6), {}},
                                 {}, camera, options);
    EXPECT_LT(seen.size(), 10U);
  }
}

TEST(Keypoints, FindABlobWhereItIs) {
  for (const auto& [u, v] : {std::make_pair(30.0F, 20.0F), {30.4F, 20.2F}, {29.7F, 20.3F}}) {
    cv::Mat image(48, 64, CV_8U);
    for (int y = 0; y < image.rows; ++y)
      for (int x = 0; x < image.cols; ++x) {
        const float r2 =
            std::pow(static_cast<float>(x) - u, 2.0F) + std::pow(static_cast<float>(y) - v, 2.0F);
        image.at<uchar>(y, x) = cv::saturate_cast<uchar>(60 + 150 * std::exp(-r2 / 6));
      }
    const KeypointSet set = findKeypoints(image, {});
    const auto strongest = [](const Keypoints& k) {
      return k
          .positions[std::max_element(k.contrast.begin(), k.contrast.end()) - k.contrast.begin()];
    };
    ASSERT_GT(set[0].size(), 0);
    EXPECT_LT(cv::norm(strongest(set[0]) - cv::Point2f(u, v)), 0.05);
    const KeypointSet inverted = findKeypoints(255 - image, {});
    ASSERT_GT(inverted[1].size(), 0);
    EXPECT_LT(cv::norm(strongest(inverted[1]) - cv::Point2f(u, v)), 0.05);
  }
}

TEST(Keypoints, AreListedRowByRow) {
  const KeypointSet set = findKeypoints(randomTexture({320, 240}, 7), {});
  for (const Keypoints& points : set) {
    ASSERT_GT(points.size(), 50);
    ASSERT_EQ(points.rows.size(), 241U);
    EXPECT_EQ(points.rows.back(), points.size());
    for (int v = 0; v < 240; ++v)
      for (int i = points.rows[v]; i < points.rows[v + 1]; ++i) {
        EXPECT_NEAR(points.positions[i].y, v, 0.5 + 1e-6);
        if (i > points.rows[v]) {
          EXPECT_GE(points.positions[i].x, points.positions[i - 1].x);
        }
      }
  }
}

}  // namespace
}  // namespace mvo
