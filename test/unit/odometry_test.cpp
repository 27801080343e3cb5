// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// From images to trajectories, on rendered scenes whose every motion is known.
#include "mvo/odometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <opencv2/imgproc.hpp>

#include "mvo/se3.hpp"
#include "mvo/sim.hpp"

namespace mvo {
namespace {

struct Sequence {
  sim::Scene scene;
  std::vector<sim::RenderedFrame> frames;

  Frame frame(std::size_t k) const { return sim::toFrame(frames[k]); }
};

Sequence rendered(const std::string& name, int width, int count, bool rgbd) {
  sim::SceneOptions options;
  options.width = width;
  options.height = width * 3 / 4;
  options.rgbd = rgbd;
  Sequence sequence{sim::makeScene(name, 3, options), {}};
  for (int k = 0; k < count; ++k) sequence.frames.push_back(sim::render(sequence.scene, 20 + k));
  return sequence;
}

const Sequence& room() {
  static const Sequence sequence = rendered("static", 320, 12, false);
  return sequence;
}
const Sequence& roomWithDepth() {
  static const Sequence sequence = rendered("static", 320, 8, true);
  return sequence;
}
const Sequence& blocks() {
  static const Sequence sequence = rendered("blocks", 480, 14, false);
  return sequence;
}

Options optionsOf(int frames) {
  Options options;
  options.window.frames = frames;
  return options;
}

std::vector<MultimotionEstimate> run(const Sequence& sequence, const Options& options) {
  MultimotionOdometry odometry(sequence.scene.camera, options);
  std::vector<MultimotionEstimate> estimates;
  for (std::size_t k = 0; k < sequence.frames.size(); ++k)
    estimates.push_back(odometry.addFrame(sequence.frame(k)));
  return estimates;
}

// The camera's true pose in the first camera.
Eigen::Isometry3d truth(const Sequence& sequence, std::size_t k) {
  return sequence.frames[0].T_world_camera.inverse() * sequence.frames[k].T_world_camera;
}

struct Drift {
  double position = 0;  // largest [m]
  double rotation = 0;  // largest [rad]
  double path = 0;      // of the truth [m]
};

Drift driftOf(const Sequence& sequence, const std::vector<MultimotionEstimate>& estimates) {
  Drift drift;
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    EXPECT_TRUE(estimates[k].valid) << k << ": " << estimates[k].problem;
    if (!estimates[k].valid) continue;
    EXPECT_EQ(estimates[k].motions.front().id, kStatic);
    const Eigen::Isometry3d error =
        truth(sequence, k).inverse() * estimates[k].motions.front().T_world_motion;
    drift.position = std::max(drift.position, error.translation().norm());
    drift.rotation = std::max(drift.rotation, angle(error.linear()));
    if (k > 0)
      drift.path += (truth(sequence, k - 1).inverse() * truth(sequence, k)).translation().norm();
  }
  return drift;
}

TEST(Odometry, FollowsTheCameraThroughAStaticRoom) {
  const auto estimates = run(room(), optionsOf(12));
  const Drift drift = driftOf(room(), estimates);
  RecordProperty("position_mm", std::to_string(1e3 * drift.position));
  RecordProperty("rotation_mrad", std::to_string(1e3 * drift.rotation));
  EXPECT_GT(drift.path, 0.05) << "the camera does move";
  EXPECT_LT(drift.position, 0.0012);
  EXPECT_LT(drift.rotation, 0.0002);
  for (const auto& estimate : estimates)
    EXPECT_EQ(estimate.motions.size(), 1U) << "nothing else moves, frame " << estimate.frame;
}

TEST(Odometry, FindsTheBlocksAndTheCamera) {
  const auto estimates = run(blocks(), optionsOf(14));
  const Drift drift = driftOf(blocks(), estimates);
  RecordProperty("position_mm", std::to_string(1e3 * drift.position));
  RecordProperty("rotation_mrad", std::to_string(1e3 * drift.rotation));
  EXPECT_LT(drift.position, 0.0032);
  EXPECT_LT(drift.rotation, 0.0006);
  int right = 0;
  int judged = 0;
  int agreeing = 0;
  int points = 0;
  for (std::size_t k = 4; k < estimates.size(); ++k) {
    const auto& frame = blocks().frames[k];
    const auto bodies = std::count_if(frame.objects.begin(), frame.objects.end(),
                                      [](const auto& object) { return object.visible_px > 800; });
    ++judged;
    const auto motions = static_cast<std::ptrdiff_t>(estimates[k].motions.size());
    if (motions == 1 + bodies)
      ++right;
    else {
      std::cerr << "FRAME " << k << " motions " << motions << " bodies " << bodies;
      for (auto& m : estimates[k].motions)
        std::cerr << " " << m.id << ":" << m.support << "/" << m.visible;
      std::cerr << std::endl;
    }
    // Every motion is one body: most of its points lie on the same mask.
    std::map<LabelId, std::map<int, int>> votes;
    for (const LabeledPoint& p : estimates[k].points)
      ++votes[p.id][frame.mask.at<uchar>(cvRound(p.y.y()), cvRound(p.y.x()))];
    for (const auto& [id, of_mask] : votes) {
      if (id == kOutlier) continue;
      int most = 0;
      for (const auto& [mask, n] : of_mask) {
        most = std::max(most, n);
        points += n;
      }
      agreeing += most;
    }
  }
  EXPECT_GE(right, 0.9 * judged);
  EXPECT_GT(agreeing, 0.95 * points);
}

TEST(Odometry, SameBitsAgain) {
  const auto first = run(room(), optionsOf(6));
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const auto second = run(room(), optionsOf(6));
  cv::setNumThreads(threads);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t k = 0; k < first.size(); ++k) {
    ASSERT_EQ(first[k].motions.size(), second[k].motions.size());
    for (std::size_t m = 0; m < first[k].motions.size(); ++m) {
      const MotionEstimate& a = first[k].motions[m];
      const MotionEstimate& b = second[k].motions[m];
      EXPECT_EQ(a.id, b.id);
      EXPECT_EQ(a.T_world_motion.matrix(), b.T_world_motion.matrix()) << k;
      EXPECT_EQ(a.covariance, b.covariance) << k;
    }
    ASSERT_EQ(first[k].points.size(), second[k].points.size());
    for (std::size_t p = 0; p < first[k].points.size(); ++p) {
      EXPECT_EQ(first[k].points[p].tracklet, second[k].points[p].tracklet);
      EXPECT_EQ(first[k].points[p].id, second[k].points[p].id);
      EXPECT_EQ(first[k].points[p].y, second[k].points[p].y);
    }
  }
}

TEST(Odometry, ABudgetThatIsFarTooShortStillFollowsEveryMotion) {
  Options options = optionsOf(14);
  options.engine.time_budget_ms = 1e-3;
  const auto hurried = run(blocks(), options);
  const Drift drift = driftOf(blocks(), hurried);
  EXPECT_LT(drift.position, 0.03);
  EXPECT_LT(drift.rotation, 0.006);
  for (std::size_t k = 2; k < hurried.size(); ++k) {
    EXPECT_TRUE(hurried[k].cut_short.batch) << k;
    EXPECT_FALSE(hurried[k].converged) << k;
    EXPECT_EQ(hurried[k].unestimated, 0) << k;
    for (const MotionEstimate& motion : hurried[k].motions) EXPECT_FALSE(motion.converged);
  }
  EXPECT_GE(hurried.back().motions.size(), 4U) << "bodies are found and kept";
  for (const auto& estimate : run(room(), optionsOf(6))) EXPECT_FALSE(estimate.cut_short.any());
}

TEST(Odometry, ResetStartsANewWorld) {
  MultimotionOdometry odometry(room().scene.camera, optionsOf(6));
  for (std::size_t k = 0; k < 4; ++k) odometry.addFrame(room().frame(k));
  odometry.reset();
  const auto fresh = run(room(), optionsOf(6));
  for (std::size_t k = 0; k < 3; ++k) {
    const auto again = odometry.addFrame(room().frame(k));
    EXPECT_EQ(again.frame, static_cast<FrameId>(k));
    ASSERT_TRUE(again.valid);
    EXPECT_EQ(again.motions.front().T_world_motion.matrix(),
              fresh[k].motions.front().T_world_motion.matrix());
  }
}

TEST(Odometry, FollowsTheCameraOnDepthImages) {
  const auto estimates = run(roomWithDepth(), optionsOf(8));
  const Drift drift = driftOf(roomWithDepth(), estimates);
  RecordProperty("position_mm", std::to_string(1e3 * drift.position));
  RecordProperty("rotation_mrad", std::to_string(1e3 * drift.rotation));
  EXPECT_LT(drift.position, 0.0011);
  EXPECT_LT(drift.rotation, 0.0002);
}

TEST(Odometry, FollowsTheCameraByDescriptors) {
  Options options = optionsOf(12);
  options.frontend.tracker = Tracker::kDescriptor;
  const Drift drift = driftOf(room(), run(room(), options));
  RecordProperty("position_mm", std::to_string(1e3 * drift.position));
  RecordProperty("rotation_mrad", std::to_string(1e3 * drift.rotation));
  EXPECT_LT(drift.position, 0.0020);
  EXPECT_LT(drift.rotation, 0.0004);
}

// What is done to a frame, and whether it can be seen to be wrong before it is tracked: then it
// does not count as a frame.
struct BadFrame {
  std::string name;
  bool depth = false;
  bool refused = false;
  std::function<void(Frame&)> spoil;
};

void PrintTo(const BadFrame& bad, std::ostream* out) { *out << bad.name; }

void fillBoth(Frame& frame, int grey) {
  frame.left = cv::Mat(frame.left.size(), CV_8U, cv::Scalar(grey));
  frame.right = frame.left.clone();
}

std::vector<BadFrame> badFrames() {
  return {
      {"EmptyLeft", false, true, [](Frame& f) { f.left = cv::Mat(); }},
      {"EmptyRight", false, true, [](Frame& f) { f.right = cv::Mat(); }},
      {"RightAndDepth", false, true, [](Frame& f) { f.depth = cv::Mat(f.left.size(), CV_32F); }},
      {"WrongSize", false, true, [](Frame& f) { f.left = cv::Mat::zeros(100, 100, CV_8U); }},
      {"WrongSizeRight", false, true, [](Frame& f) { f.right = cv::Mat::zeros(9, 9, CV_8U); }},
      {"Colour", false, true, [](Frame& f) { f.left = cv::Mat::zeros(f.left.size(), CV_8UC3); }},
      {"StampGoesBack", false, true, [](Frame& f) { f.stamp_ns -= 1'000'000'000; }},
      {"DepthInMillimetres", true, true,
       [](Frame& f) { f.depth = cv::Mat::zeros(f.left.size(), CV_16U); }},
      {"Black", false, false, [](Frame& f) { fillBoth(f, 0); }},
      {"Saturated", false, false, [](Frame& f) { fillBoth(f, 255); }},
      {"Textureless", false, false, [](Frame& f) { fillBoth(f, 120); }},
      {"Identical", false, false, [](Frame& f) { f.right = f.left.clone(); }},
      {"DepthOfHoles", true, false,
       [](Frame& f) { f.depth.setTo(std::numeric_limits<float>::quiet_NaN()); }},
      {"DepthOfZeros", true, false, [](Frame& f) { f.depth.setTo(0); }},
  };
}

class BadFrames : public testing::TestWithParam<BadFrame> {};
INSTANTIATE_TEST_SUITE_P(All, BadFrames, testing::ValuesIn(badFrames()),
                         [](const auto& bad) { return bad.param.name; });

TEST_P(BadFrames, AreReportedAndSurvived) {
  const Sequence& sequence = GetParam().depth ? roomWithDepth() : room();
  MultimotionOdometry odometry(sequence.scene.camera, optionsOf(6));
  for (std::size_t k = 0; k < 3; ++k) ASSERT_TRUE(odometry.addFrame(sequence.frame(k)).valid);
  Frame bad = sequence.frame(3);
  bad.left = bad.left.clone();
  bad.depth = bad.depth.clone();
  GetParam().spoil(bad);
  const auto reported = odometry.addFrame(bad);
  EXPECT_FALSE(reported.valid);
  EXPECT_TRUE(reported.motions.empty());
  EXPECT_GT(reported.problem.size(), 20U) << "a sentence";
  EXPECT_EQ(reported.problem.find('\n'), std::string::npos);

  MultimotionEstimate last;
  for (std::size_t k = 4; k < 7; ++k) {
    last = odometry.addFrame(sequence.frame(k));
    EXPECT_EQ(last.frame, static_cast<FrameId>(GetParam().refused ? k - 1 : k));
  }
  ASSERT_TRUE(last.valid) << last.problem;
  EXPECT_TRUE(last.problem.empty());
  // With a gap of one frame the points go on, and so does the world.
  const Eigen::Isometry3d error =
      truth(sequence, 6).inverse() * last.motions.front().T_world_motion;
  EXPECT_LT(error.translation().norm(), 0.03);
  EXPECT_LT(angle(error.linear()), 0.01);
}

TEST(Odometry, ABadFirstFrameIsNoFrame) {
  MultimotionOdometry odometry(room().scene.camera, optionsOf(6));
  EXPECT_FALSE(odometry.addFrame(Frame{}).valid);
  const auto first = odometry.addFrame(room().frame(0));
  EXPECT_EQ(first.frame, 0);
  ASSERT_TRUE(first.valid);
  EXPECT_EQ(first.motions.front().T_world_motion.matrix(), Eigen::Matrix4d::Identity());
}

TEST(Odometry, NothingToSeeIsNoMotion) {
  MultimotionOdometry odometry(room().scene.camera, optionsOf(6));
  for (std::int64_t k = 0; k < 5; ++k) {
    Frame frame = room().frame(0);
    frame.stamp_ns += k;
    fillBoth(frame, 80);
    const auto estimate = odometry.addFrame(frame);
    EXPECT_FALSE(estimate.valid);
    EXPECT_FALSE(estimate.problem.empty());
    EXPECT_TRUE(estimate.motions.empty());
  }
}

// The room from a camera that has walked a way.
const Sequence& longWalk() {
  static const Sequence sequence = [] {
    sim::SceneOptions options;
    options.width = 320;
    options.height = 240;
    Sequence walk{sim::makeScene("static", 3, options), {}};
    for (int k = 0; k < 45; ++k) walk.frames.push_back(sim::render(walk.scene, 20 + 4 * k));
    return walk;
  }();
  return sequence;
}

// The room as a pair sees it whose right eye is turned outwards: about `pixels` to the left.
MultimotionOdometry afterSquinting(float pixels) {
  MultimotionOdometry odometry(longWalk().scene.camera, optionsOf(24));
  const cv::Mat shift = (cv::Mat_<float>(2, 3) << 1, 0, -pixels, 0, 1, 0);
  for (std::size_t k = 0; k < longWalk().frames.size(); ++k) {
    Frame frame = longWalk().frame(k);
    cv::Mat moved;
    cv::warpAffine(frame.right, moved, shift, frame.right.size(), cv::INTER_CUBIC,
                   cv::BORDER_REPLICATE);
    frame.right = moved;
    odometry.addFrame(frame);
  }
  return odometry;
}

TEST(Odometry, SaysWhatIsWrongWithThePair) {
  const auto exact = afterSquinting(0).cameraErrors();
  ASSERT_TRUE(exact);
  EXPECT_EQ(exact->advice.find("calibrate again"), std::string::npos) << exact->advice;
  RecordProperty("exact_px", std::to_string(exact->disparity.value));
  const auto turned = afterSquinting(1).cameraErrors();
  ASSERT_TRUE(turned);
  RecordProperty("advice", turned->advice);
  RecordProperty("turned_px", std::to_string(turned->disparity.value));
  EXPECT_NEAR(turned->disparity.value, 1, 0.4);
  EXPECT_LT(turned->disparity.deviation, 0.3);
  EXPECT_GT(turned->yaw.value, 0);
  EXPECT_TRUE(turned->significant);
  EXPECT_NE(turned->advice.find("too large"), std::string::npos) << turned->advice;
}

TEST(Odometry, StartsFromWhatAnEarlierRunLearntOfThePair) {
  const LearntCameraErrors learnt = afterSquinting(1).cameraErrors()->learnt;
  MultimotionOdometry odometry(room().scene.camera, optionsOf(12));
  EXPECT_GT(odometry.cameraErrors()->disparity.deviation, 0.5);
  odometry.setCameraErrors(learnt);
  const auto off = [&] {
    const auto report = odometry.cameraErrors();
    const Eigen::VectorXd deviation = learnt.covariance.diagonal().cwiseSqrt();
    return (report->learnt.mean - learnt.mean).cwiseQuotient(deviation).cwiseAbs().maxCoeff();
  };
  EXPECT_LT(off(), 1e-6);
  for (std::size_t k = 0; k < 4; ++k) odometry.addFrame(room().frame(k));
  EXPECT_GT(off(), 0.1) << "it goes on learning";
  odometry.reset();
  EXPECT_LT(off(), 1e-6);
  StereoCamera other = room().scene.camera;
  other.baseline *= 1.01;
  MultimotionOdometry another(other, optionsOf(12));
  EXPECT_THROW(another.setCameraErrors(learnt), std::invalid_argument);
}

TEST(Odometry, APairThatIsTrustedOrNoPairHasNoErrors) {
  Options trusted = optionsOf(12);
  trusted.camera.errors = CameraErrorMode::kOff;
  MultimotionOdometry odometry(room().scene.camera, trusted);
  odometry.addFrame(room().frame(0));
  EXPECT_FALSE(odometry.cameraErrors());
  MultimotionOdometry with_depth(roomWithDepth().scene.camera, optionsOf(12));
  with_depth.addFrame(roomWithDepth().frame(0));
  EXPECT_FALSE(with_depth.cameraErrors());
}

TEST(Odometry, RefusesImpossibleCalibrationAndOptions) {
  StereoCamera camera = room().scene.camera;
  camera.baseline = 0;
  EXPECT_THROW(MultimotionOdometry(camera, Options{}), std::invalid_argument);
  Options options;
  options.window.frames = 0;
  EXPECT_THROW(MultimotionOdometry(room().scene.camera, options), std::invalid_argument);
}

}  // namespace
}  // namespace mvo
