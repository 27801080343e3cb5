// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/box_motions.hpp"

#include <gtest/gtest.h>

#include "support/trajectories.hpp"

namespace mvo {
namespace {

using test::transform;

constexpr int kFrames = 11;
constexpr std::int64_t kPeriod = 100'000'000;  // [ns]
const Eigen::Isometry3d kWorld = transform(1, -2, 3, 0.5, -0.7, 1.9);
const TrueVelocity kVelocity{"A", 0, 10 * kPeriod, 3.0, -1.0, 0.1};

// A car 20 m ahead that goes 3 m/s to the right and comes 1 m/s closer; the camera rests, and the
// estimate has another world.
class CarInBoxes : public ::testing::Test {
 protected:
  CarInBoxes() {
    std::vector<std::int64_t> stamps;
    for (int k = 0; k < kFrames; ++k) {
      const Eigen::Vector3d p(-2 + 0.3 * k, 1, 20 - 0.1 * k);
      stamps.push_back(k * kPeriod);
      true_camera_.emplace_back(Eigen::Isometry3d::Identity());
      camera_.emplace_back(kWorld);
      motions_[7].emplace_back(kWorld * transform(p.x(), p.y(), p.z(), 0, 0.1, 0));
      const Eigen::Vector3d seen = calibration_->project(p);
      boxes_.push_back({{stamps.back(), seen.x() - 40, seen.y() - 20, 80, 40, "A", ""}});
    }
    clock_ = FrameClock(stamps);
    holders_["A"] = Holders(kFrames, 7);
  }

  BoxScene scene() const {
    return {clock_, camera_, true_camera_, motions_, boxes_, calibration_, holders_};
  }

  FrameClock clock_{{0, 1}};
  FramePoses camera_;
  FramePoses true_camera_;
  MotionPoses motions_;
  FrameBoxes boxes_;
  std::optional<StereoCamera> calibration_ = StereoCamera{700, 700, 600, 180, 0.5, 1240, 370};
  std::map<std::string, Holders> holders_;
};

TEST_F(CarInBoxes, ThePerfectEstimateHasNoErrors) {
  const BoxPlacement place = placement("A", scene()).value();
  EXPECT_EQ(place.frames, kFrames);
  EXPECT_EQ(place.inside, kFrames);
  const auto scores = scoreVelocities({kVelocity}, scene());
  ASSERT_EQ(scores.size(), 1u);
  EXPECT_EQ(scores[0].id, 7);
  EXPECT_EQ(scores[0].last, 10u);
  EXPECT_NEAR(scores[0].errorX(), 0, 1e-9);
  EXPECT_NEAR(scores[0].errorZ(), 0, 1e-9);
  EXPECT_NEAR(scores[0].displacement_error, 0, 1e-9);
  EXPECT_NEAR(scores[0].depth, 19.5, 1e-9);
  ASSERT_TRUE(scores[0].implied_depth);
  EXPECT_NEAR(scores[0].implied_depth->z, 19.5, 1e-9);
  EXPECT_GT(scores[0].implied_depth->sd, 19.5 * 0.1 / 3);
}

TEST_F(CarInBoxes, AFastEstimateIsOffByItsExcess) {
  for (int k = 0; k < kFrames; ++k)
    motions_[7][k] = kWorld * transform(-2 + 0.33 * k, 1, 20 - 0.06 * k);
  const VelocityScore score = scoreVelocities({kVelocity}, scene()).at(0);
  EXPECT_NEAR(score.errorX(), 0.3, 1e-9);
  EXPECT_NEAR(score.errorZ(), 0.4, 1e-9);
  EXPECT_NEAR(score.displacement_error, 0.5, 1e-9);  // within one second
}

TEST_F(CarInBoxes, AnEstimateElsewhereIsNotInItsBox) {
  for (std::size_t k = 3; k < kFrames; ++k)
    motions_[7][k] = kWorld * transform(0, 0, -40);  // behind the camera
  motions_[7][2] = kWorld * transform(2, 1, 20);
  motions_[7][1].reset();
  camera_[0].reset();
  const BoxPlacement place = placement("A", scene()).value();
  EXPECT_EQ(place.frames, 9);
  EXPECT_EQ(place.inside, 0);
}

TEST_F(CarInBoxes, TheLastHolderGoesOnWhereNoneHolds) {
  holders_["A"] = Holders(kFrames);
  holders_["A"][4] = 7;
  EXPECT_EQ(placement("A", scene())->frames, 7);  // from its frame on
}

TEST_F(CarInBoxes, AVelocityNeedsOneIdWithBothPoses) {
  motions_[8] = motions_[7];
  for (int k = 0; k < 7; ++k) holders_["A"][k] = 8;
  EXPECT_EQ(scoreVelocities({kVelocity}, scene())[0].id, 8);
  motions_[8][10].reset();
  EXPECT_EQ(scoreVelocities({kVelocity}, scene())[0].id, 7);
  camera_[0].reset();
  EXPECT_EQ(scoreVelocities({kVelocity}, scene())[0].id, 0);
  EXPECT_TRUE(scoreVelocities({{"A", 0, 50 * kPeriod, 3, 0, 1}}, scene()).empty());  // cropped
}

TEST_F(CarInBoxes, ADepthNeedsARestingCameraAndAClearMotion) {
  EXPECT_TRUE(impliedDepth(kVelocity, scene()));
  TrueVelocity vague = kVelocity;
  vague.sd = 1;
  EXPECT_FALSE(impliedDepth(vague, scene()));
  TrueVelocity still = kVelocity;
  still.vx = 0;
  EXPECT_FALSE(impliedDepth(still, scene()));
  true_camera_[10] = transform(0.1, 0, 0);
  EXPECT_FALSE(impliedDepth(kVelocity, scene()));
  calibration_.reset();
  EXPECT_FALSE(placement("A", scene()));
  EXPECT_EQ(scoreVelocities({kVelocity}, scene())[0].id, 7);
}

}  // namespace
}  // namespace mvo
