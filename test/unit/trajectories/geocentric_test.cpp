// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories/geocentric.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mvo/se3.hpp"

namespace mvo {
namespace {

constexpr LabelId kBody = 3;
constexpr FrameId kFrames = 30;
const Eigen::Vector3d kCentre(0.4, -0.2, 3);  // of the body, in the first camera [m]

// The truth: a camera that wanders and a body that moves along +x of the world and turns.
Eigen::Isometry3d cameraAt(FrameId k) {
  const double t = 0.1 * static_cast<double>(k);
  Vector6d xi;
  xi << 0.3 * std::sin(t), -0.2 * t, 0.4 * t, 0.1 * std::sin(2 * t), 0.15 * t, -0.05 * t;
  return mvo::exp(xi);
}
Eigen::Isometry3d bodyAt(FrameId k) {
  const double t = 0.1 * static_cast<double>(k);
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translate(kCentre + Eigen::Vector3d(0.5 * t, 0, 0));
  T.rotate(Eigen::AngleAxisd(0.3 * t, Eigen::Vector3d::UnitY()));
  return T;
}

// What a batch over [first, last] says: T_ck_c1 of the camera relative to the static world or to
// the body.
Trajectory egomotion(LabelId id, FrameId first, FrameId last) {
  const auto T_ck_l = [id](FrameId k) {
    return id == kStatic ? cameraAt(k).inverse() : cameraAt(k).inverse() * bodyAt(k);
  };
  Trajectory trajectory;
  trajectory.first_frame = first;
  for (FrameId k = first; k <= last; ++k) {
    trajectory.T_ck_c1.push_back(T_ck_l(k) * T_ck_l(first).inverse());
    trajectory.segment.push_back(0);
  }
  return trajectory;
}

void expectNear(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double tolerance) {
  EXPECT_LT((a.matrix() - b.matrix()).norm(), tolerance) << a.matrix() << "\n\n" << b.matrix();
}

// Feeds a window of `span` frames that slides over all frames.
GeocentricTrajectories slid(FrameId span, LabelId world = kStatic, LabelId body = kBody) {
  GeocentricTrajectories trajectories;
  for (FrameId k = 1; k < kFrames; ++k) {
    const FrameId first = std::max<FrameId>(0, k - span + 1);
    trajectories.update(world, egomotion(kStatic, first, k), Eigen::Vector3d::Zero());
    trajectories.update(body, egomotion(kBody, first, k), kCentre);
    trajectories.forgetBefore(first);
  }
  return trajectories;
}

TEST(Geocentric, TheWorldIsTheFirstCamera) {
  GeocentricTrajectories trajectories;
  trajectories.update(kStatic, egomotion(kStatic, 0, kFrames - 1), {7, 7, 7});
  for (FrameId k = 0; k < kFrames; ++k) {
    ASSERT_TRUE(trajectories.inWorld(kStatic, k));
    expectNear(*trajectories.inWorld(kStatic, k), cameraAt(k), 1e-12);
    expectNear(*trajectories.inCamera(kStatic, k), cameraAt(k).inverse(), 1e-12);
  }
}

TEST(Geocentric, TheBodyFrameIsFixedAtBirth) {
  GeocentricTrajectories trajectories;
  trajectories.update(kStatic, egomotion(kStatic, 0, 5), Eigen::Vector3d::Zero());
  trajectories.update(kBody, egomotion(kBody, 0, 5), kCentre);
  const auto born = trajectories.inWorld(kBody, 0);
  ASSERT_TRUE(born);
  Eigen::Isometry3d expected = Eigen::Isometry3d::Identity();
  expected.translation() = kCentre;
  expectNear(*born, expected, 1e-12);
  // Another centroid, from other points, moves nothing.
  trajectories.update(kBody, egomotion(kBody, 0, 6), {9, 9, 9});
  expectNear(*trajectories.inWorld(kBody, 0), expected, 1e-12);
  for (FrameId k = 0; k <= 5; ++k) expectNear(*trajectories.inWorld(kBody, k), bodyAt(k), 1e-12);
}

TEST(Geocentric, ABodyThatMovesAlongXHasRisingX) {
  const GeocentricTrajectories trajectories = slid(kFrames);
  for (FrameId k = 1; k < kFrames; ++k) {
    const Eigen::Vector3d step = trajectories.inWorld(kBody, k)->translation() -
                                 trajectories.inWorld(kBody, k - 1)->translation();
    EXPECT_NEAR(step.x(), 0.05, 1e-9) << "while the camera moves as well";
    EXPECT_NEAR(step.tail<2>().norm(), 0, 1e-9);
  }
}

TEST(Geocentric, ASlidingWindowContinuesTheFullChain) {
  for (const FrameId span : {3, 7, 29}) {
    const GeocentricTrajectories trajectories = slid(span);
    for (FrameId k = kFrames - span; k < kFrames; ++k) {
      expectNear(trajectories.inWorld(kStatic, k).value(), cameraAt(k), 1e-9);
      expectNear(trajectories.inWorld(kBody, k).value(), bodyAt(k), 1e-9);
    }
  }
}

TEST(Geocentric, FrozenPosesAnchorWhatComesAfter) {
  GeocentricTrajectories trajectories;
  trajectories.update(kStatic, egomotion(kStatic, 0, 10), Eigen::Vector3d::Zero());
  // Frames 0..4 leave the window; a batch that now sees everything from 5 on otherwise only changes
  // what is after 5.
  trajectories.forgetBefore(5);
  EXPECT_FALSE(trajectories.inWorld(kStatic, 4));
  Trajectory still;
  still.first_frame = 5;
  still.T_ck_c1.assign(6, Eigen::Isometry3d::Identity());
  still.segment.assign(6, 0);
  trajectories.update(kStatic, still, Eigen::Vector3d::Zero());
  for (FrameId k = 5; k <= 10; ++k)
    expectNear(trajectories.inWorld(kStatic, k).value(), cameraAt(5), 1e-12);
}

TEST(Geocentric, ACameraThatWasLostGoesOnFromWhereItWas) {
  GeocentricTrajectories trajectories;
  trajectories.update(kStatic, egomotion(kStatic, 0, 4), Eigen::Vector3d::Zero());
  for (FrameId k = 5; k < 10; ++k) trajectories.forgetBefore(k);
  trajectories.update(kStatic, egomotion(kStatic, 10, 12), {9, 9, 9});
  expectNear(trajectories.inWorld(kStatic, 10).value(), cameraAt(4), 1e-12);
  expectNear(trajectories.inWorld(kStatic, 12).value(),
             cameraAt(4) * cameraAt(10).inverse() * cameraAt(12), 1e-12);
}

TEST(Geocentric, BodiesThatNeverComeBackLeaveNothing) {
  GeocentricTrajectories trajectories;
  for (LabelId id = kStatic; id < 20; ++id)
    trajectories.update(id, egomotion(kStatic, 0, id == 7 ? 8 : 4), Eigen::Vector3d::Zero());
  trajectories.forgetBefore(5);
  const auto known = [&trajectories] {
    std::set<LabelId> ids;
    for (LabelId id = kStatic + 1; id < 20; ++id)
      if (trajectories.knows(id)) ids.insert(id);
    return ids;
  };
  EXPECT_EQ(known().size(), 19U);
  trajectories.forgetBodies(5, {3});
  EXPECT_EQ(known(), (std::set<LabelId>{3, 7})) << "one may come back, one is in view";
  trajectories.update(3, egomotion(kStatic, 9, 10), {9, 9, 9});
  expectNear(trajectories.inCamera(3, 9).value(), cameraAt(4).inverse(), 1e-12);
  trajectories.update(4, egomotion(kStatic, 9, 10), {9, 9, 9});
  EXPECT_LT((trajectories.inCamera(4, 9)->translation() - Eigen::Vector3d(9, 9, 9)).norm(), 1e-12)
      << "begins anew";
}

TEST(Geocentric, FramesOfOtherSegmentsHaveNoPose) {
  GeocentricTrajectories trajectories;
  Trajectory torn = egomotion(kStatic, 0, 6);
  torn.segment = {0, 0, 0, -1, 1, 1, 1};
  trajectories.update(kStatic, torn, Eigen::Vector3d::Zero());
  EXPECT_TRUE(trajectories.inWorld(kStatic, 2));
  for (FrameId k = 3; k <= 6; ++k) EXPECT_FALSE(trajectories.inWorld(kStatic, k)) << k;
}

TEST(Geocentric, NoWorldPoseWithoutTheCamera) {
  GeocentricTrajectories trajectories;
  trajectories.update(kBody, egomotion(kBody, 0, 4), kCentre);
  EXPECT_TRUE(trajectories.inCamera(kBody, 2));
  EXPECT_FALSE(trajectories.inWorld(kBody, 2));
  EXPECT_FALSE(trajectories.inCamera(7, 2));
  EXPECT_TRUE(trajectories.since(0).empty());
  trajectories.update(kBody, {}, kCentre);  // an empty estimate changes nothing
  EXPECT_TRUE(trajectories.inCamera(kBody, 2));
}

TEST(Geocentric, SinceListsAllPosesInTheWorld) {
  const GeocentricTrajectories trajectories = slid(10);
  const auto all = trajectories.since(25);
  EXPECT_EQ(all.size(), 2U * 5U);
  for (const SmoothedPose& pose : all) {
    EXPECT_GE(pose.frame, 25);
    expectNear(pose.T_world_motion, pose.id == kStatic ? cameraAt(pose.frame) : bodyAt(pose.frame),
               1e-9);
  }
}

// The label of the static world may go to another part of it, whose batch starts later or says the
// same thing in its own frame: the camera must not jump.
TEST(Geocentric, NoJumpWhenAnotherLabelBecomesTheStaticWorld) {
  GeocentricTrajectories trajectories;
  for (FrameId k = 1; k < kFrames; ++k) {
    const FrameId first = std::max<FrameId>(k < 15 ? 0 : 12, k - 9);
    trajectories.update(kStatic, egomotion(kStatic, first, k), Eigen::Vector3d::Constant(k));
    trajectories.forgetBefore(std::max<FrameId>(0, k - 9));
    expectNear(trajectories.inWorld(kStatic, k).value(), cameraAt(k), 1e-9);
  }
}

// Another part of the world, whose motion differs: the newest pose goes on by it, those before
// stay.
TEST(Geocentric, GoesOnFromAPoseWithoutRewritingThoseBefore) {
  GeocentricTrajectories trajectories;
  trajectories.update(kStatic, egomotion(kStatic, 0, 10), Eigen::Vector3d::Zero());
  Trajectory other;
  other.first_frame = 3;
  Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
  step.translation().z() = -1;
  other.T_ck_c1.push_back(Eigen::Isometry3d::Identity());
  other.segment.push_back(0);
  for (FrameId k = 4; k <= 11; ++k) other.append(step);
  trajectories.continueFrom(10, cameraAt(10));
  EXPECT_TRUE(trajectories.bridges(other));
  for (const FrameId last : {11, 12, 13}) {
    trajectories.update(kStatic, other, Eigen::Vector3d::Zero());
    for (FrameId k = 0; k <= 10; ++k)
      expectNear(trajectories.inWorld(kStatic, k).value(), cameraAt(k), 1e-12);
    Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
    moved.translation().z() = static_cast<double>(last - 10);
    expectNear(trajectories.inWorld(kStatic, last).value(), cameraAt(10) * moved, 1e-12);
    other.append(step);
  }
  other.dropBefore(12);  // as does the window, whose frames are then smoothed again
  trajectories.forgetBefore(12);
  EXPECT_TRUE(trajectories.bridges(other));
  EXPECT_FALSE(trajectories.bridges(egomotion(kStatic, 20, 22)));
  EXPECT_FALSE(trajectories.bridges({}));
}

// The world was taken for what the body is.
TEST(Geocentric, AContradictionIsHowOtherwiseTheCameraMoved) {
  GeocentricTrajectories trajectories;
  trajectories.update(kStatic, egomotion(kBody, 4, 20), Eigen::Vector3d::Zero());
  const Trajectory truth = egomotion(kStatic, 8, 20);
  const Vector6d missed = trajectories.contradiction(truth, 20);
  expectNear(exp(missed) * egomotion(kBody, 8, 20).T_ck_c1.back(), truth.T_ck_c1.back(), 1e-9);
  EXPECT_GT(missed.norm(), 0.1);
  EXPECT_LT(trajectories.contradiction(egomotion(kBody, 8, 20), 20).norm(), 1e-9);
  EXPECT_EQ(trajectories.contradiction(egomotion(kStatic, 21, 25), 25), Vector6d::Zero());
  EXPECT_EQ(trajectories.contradiction(truth, 21), Vector6d::Zero());
}

}  // namespace
TEST(Geocentric, ABodyThatRestedIsTakenUpWhereItWasInTheWorld) {
  GeocentricTrajectories poses;
  Eigen::Isometry3d step =
      Eigen::Isometry3d::Identity();  // the camera moves 0.1 m along +x per frame
  step.translation().x() = -0.1;
  Trajectory moving{0, {Eigen::Isometry3d::Identity()}, {0}};
  for (int k = 1; k < 8; ++k) moving.append(step);
  poses.update(kStatic, moving, Eigen::Vector3d::Zero());
  // Seen at rest in front of the moving camera in frames 0 and 1, then again in frames 6 and 7.
  Trajectory seen{0, {Eigen::Isometry3d::Identity()}, {0}};
  seen.append(step);
  poses.update(1, seen, {0, 0, 2});
  ASSERT_TRUE(poses.inWorld(1, 1));
  EXPECT_NEAR(poses.inWorld(1, 1)->translation().x(), 0.0, 1e-12);
  seen.first_frame = 6;
  poses.update(1, seen, {0, 0, 2});
  ASSERT_TRUE(poses.inWorld(1, 7));
  EXPECT_NEAR(poses.inWorld(1, 7)->translation().x(), 0.0, 1e-12);
  EXPECT_NEAR(poses.inCamera(1, 7)->translation().x(), -0.7, 1e-12);
}

}  // namespace mvo
