// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Every imperfection of the pair does to the images what its option says, and nothing else.
#include "mvo/imperfections.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mvo/sim.hpp"
#include "sim/eye.hpp"
#include "support/imperfect_blocks.hpp"

namespace mvo::sim {
namespace {

using test::blocksWith;
using test::exactFrame;
using test::identical;
using test::kFrame;
using test::later;
using test::shiftAround;
using test::shiftOf;

constexpr double kDegree = M_PI / 180;

const cv::Point kCenter(319, 243);
const cv::Point kRightEdge(560, 243);
const cv::Point kCorner(560, 400);

TEST(Imperfections, YawShiftsTheDisparity) {
  Imperfections imperfections;
  imperfections.right_yaw = 0.05;
  const Eigen::Vector2d shift = shiftAround(imperfections, kCenter);
  EXPECT_NEAR(shift.x(), -500 * 0.05 * kDegree, 0.02);  // outwards: the disparity grows
  EXPECT_NEAR(shift.y(), 0, 0.02);
}

TEST(Imperfections, PitchShiftsTheRows) {
  Imperfections imperfections;
  imperfections.right_pitch = 0.1;
  const Eigen::Vector2d shift = shiftAround(imperfections, kCenter);
  EXPECT_NEAR(shift.x(), 0, 0.02);
  EXPECT_NEAR(shift.y(), 500 * 0.1 * kDegree, 0.02);  // it looks up: all lies further down
}

TEST(Imperfections, RollTurnsTheImage) {
  Imperfections imperfections;
  imperfections.right_roll = 0.2;
  EXPECT_NEAR(shiftAround(imperfections, kCenter, 30).norm(), 0, 0.03);
  // Clockwise: what is on the right lies further up.
  EXPECT_NEAR(shiftAround(imperfections, kRightEdge).y(), -241.4 * 0.2 * kDegree, 0.06);
}

TEST(Imperfections, FocalLengthStretchesTheImage) {
  Imperfections imperfections;
  imperfections.right_focal = 0.003;
  EXPECT_NEAR(shiftAround(imperfections, kCenter).norm(), 0, 0.03);
  EXPECT_NEAR(shiftAround(imperfections, kRightEdge).x(), 241.4 * 0.003, 0.06);
}

TEST(Imperfections, PrincipalPointShiftsAll) {
  Imperfections imperfections;
  imperfections.right_center_u = 0.7;
  imperfections.right_center_v = -0.4;
  for (const cv::Point& middle : {kCenter, kCorner}) {
    const Eigen::Vector2d shift = shiftAround(imperfections, middle);
    EXPECT_NEAR(shift.x(), 0.7, 0.02);
    EXPECT_NEAR(shift.y(), -0.4, 0.02);
  }
}

TEST(Imperfections, RadialErrorGrowsWithTheCubeOfTheRadius) {
  Imperfections imperfections;
  imperfections.right_radial = 2;
  EXPECT_NEAR(shiftAround(imperfections, kCenter).norm(), 0, 0.02);
  const Eigen::Vector2d radius(kCorner.x - 318.6, kCorner.y - 243.2);
  const Eigen::Vector2d expected = 2 * std::pow(radius.norm() / 400, 3) * radius.normalized();
  EXPECT_GT(expected.norm(), 0.7);
  EXPECT_NEAR((shiftAround(imperfections, kCorner) - expected).norm(), 0, 0.1);
}

TEST(Imperfections, RadialErrorIsThatOfTheOptionHalfADiagonalOff) {
  Imperfections imperfections;
  imperfections.right_radial = -1.5;
  const Eye eye = rightEye(blocksWith(imperfections));
  const Eigen::Vector2d corner(318.6 + 320, 243.2 + 240);
  Eye pinhole = eye;
  pinhole.distortion = {};
  const Eigen::Vector3d p((corner.x() - 318.6) / 500, (corner.y() - 243.2) / 500, 1);
  EXPECT_NEAR((pinhole.project(p) - corner).norm(), 0, 1e-9);
  EXPECT_NEAR((eye.project(p) - corner).dot(Eigen::Vector2d(0.8, 0.6)), -1.5, 1e-9);
  EXPECT_NEAR((eye.undistort(eye.project(p)) - corner).norm(), 0, 1e-9);
}

TEST(Imperfections, TangentialErrorBendsRowsAndColumns) {
  Imperfections imperfections;
  imperfections.right_tangential = 3;
  EXPECT_NEAR(shiftAround(imperfections, kCenter, 30).norm(), 0, 0.03);
  const double x = (kCorner.x - 318.6) / 400;
  const double y = (kCorner.y - 243.2) / 400;
  const Eigen::Vector2d expected(3 * (3 * x * x + y * y) / 3, 3 * 2 * x * y / 3);
  EXPECT_GT(expected.minCoeff(), 0.4);
  EXPECT_NEAR((shiftAround(imperfections, kCorner) - expected).norm(), 0, 0.1);
}

// What was fitted on rectified KITTI images: the disparity is short by 0.65 + 2.7 x^2 px, rows
// differ by 7 x y px. A tilted lens, a turn and a shift that nearly cancel in the middle make it.
TEST(Imperfections, MakeTheErrorOfRectifiedKittiImages) {
  SceneOptions options = usualOptions("street");
  options.imperfections.right_tangential = -10.49;
  options.imperfections.right_yaw = -1.2433;
  options.imperfections.right_center_u = -14.95;
  const Scene scene = makeScene("street", 1, options);
  const Eye eye = rightEye(scene);
  for (const double x : {-0.8, -0.4, 0.0, 0.4, 0.8})
    for (const double y : {-0.15, 0.0, 0.15}) {
      const Eigen::Vector3d p = 500 * Eigen::Vector3d(x, y, 1);
      const Eigen::Vector3d exact = scene.camera.project(p);
      const Eigen::Vector2d error =
          eye.project(eye.T_eye_camera * p) - Eigen::Vector2d(exact.z(), exact.y());
      EXPECT_NEAR(error.x(), 0.65 + 2.7 * x * x, 0.5) << x << ' ' << y;
      EXPECT_NEAR(error.y(), 7 * x * y, 0.15) << x << ' ' << y;
    }
}

TEST(Imperfections, UndistortedPixelsAreThoseOfThePinhole) {
  Imperfections imperfections;
  imperfections.right_radial = -8;
  imperfections.right_tangential = 12;
  const Eye eye = rightEye(blocksWith(imperfections));
  Eye pinhole = eye;
  pinhole.distortion = {};
  for (const double x : {-0.6, 0.0, 0.3, 0.65})
    for (const double y : {-0.5, 0.0, 0.45}) {
      const Eigen::Vector3d p(x, y, 1);
      EXPECT_NEAR((eye.undistort(eye.project(p)) - pinhole.project(p)).norm(), 0, 1e-9);
    }
}

// Rays that are bent by next to nothing see what straight ones see.
TEST(Imperfections, BentRaysMeetTheStraightOnes) {
  Imperfections imperfections;
  imperfections.right_radial = 1e-7;
  const RenderedFrame frame = render(blocksWith(imperfections), kFrame);
  cv::Mat difference;
  cv::absdiff(frame.right, exactFrame().right, difference);
  // A few samples lie on an edge, or between two levels of detail.
  EXPECT_LT(cv::countNonZero(difference > 1), 2e-4 * static_cast<double>(difference.total()));
}

TEST(Imperfections, DelayedEyeSeesWhatIsThereLater) {
  Imperfections imperfections;
  imperfections.right_delay = 0.005;
  const Scene scene = blocksWith(imperfections);
  const RenderedFrame frame = render(scene, kFrame);
  EXPECT_TRUE(identical(frame.left, exactFrame().left));
  EXPECT_FALSE(identical(frame.right, exactFrame().right));
  const RenderedFrame after = render(later(blocksWith({}), 0.005), kFrame);
  EXPECT_LE(cv::norm(frame.right, after.right, cv::NORM_INF), 1);
}

// The image moves during the delay, by rows as well: that is what an estimator can see of it.
TEST(Imperfections, DelayShiftsTheRowsByTheImagesMotion) {
  Imperfections imperfections;
  imperfections.right_delay = 0.02;
  const Scene scene = blocksWith(imperfections);
  const Eigen::Isometry3d T_late_now = scene.T_world_camera(scene.time(kFrame) + 0.02).inverse() *
                                       scene.T_world_camera(scene.time(kFrame));
  const cv::Point wall(330, 190);  // between the blocks
  ASSERT_EQ(cv::countNonZero(exactFrame().mask(cv::Rect(wall.x - 20, wall.y - 20, 40, 40))), 0);
  const double depth = exactFrame().depth.at<float>(wall);
  const StereoCamera& camera = scene.camera;
  const Eigen::Vector3d p =
      camera.backProject({1.0 * wall.x, 1.0 * wall.y, camera.rightColumn(wall.x, depth)});
  const Eigen::Vector3d motion = camera.project(T_late_now * p) - camera.project(p);
  ASSERT_GT(std::abs(motion.y()), 0.1);
  const cv::Point seen(static_cast<int>(std::lround(camera.project(p).z())), wall.y);
  const Eigen::Vector2d shift =
      shiftOf(exactFrame().right, render(scene, kFrame).right, {seen.x - 20, seen.y - 20, 40, 40});
  EXPECT_NEAR(shift.x(), motion.z(), 0.05);
  EXPECT_NEAR(shift.y(), motion.y(), 0.05);
}

TEST(Imperfections, TruthAndTheClaimStayThoseOfTheExactPair) {
  Imperfections imperfections;
  imperfections.right_yaw = 0.3;
  imperfections.right_focal = 0.01;
  imperfections.right_radial = 3;
  imperfections.right_delay = 0.004;
  const Scene scene = blocksWith(imperfections);
  const RenderedFrame frame = render(scene, kFrame);
  EXPECT_TRUE(identical(frame.left, exactFrame().left));
  EXPECT_TRUE(identical(frame.mask, exactFrame().mask));
  EXPECT_TRUE(identical(frame.depth, exactFrame().depth));
  EXPECT_TRUE(frame.T_world_camera.isApprox(exactFrame().T_world_camera, 0));
  const StereoCamera claimed = sequenceInfo(scene).camera;
  const StereoCamera exact = sequenceInfo(blocksWith({})).camera;
  EXPECT_EQ(claimed.fu, exact.fu);
  EXPECT_EQ(claimed.cu, exact.cu);
  EXPECT_EQ(claimed.baseline, exact.baseline);
}

std::string complaintAbout(const SceneOptions& options) {
  try {
    makeScene("blocks", 1, options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Imperfections, BadOnesAreNamedWithTheirRange) {
  SceneOptions options;
  options.imperfections.right_yaw = 7;
  EXPECT_EQ(complaintAbout(options), "option right_yaw is '7', it must be in [-5, 5] deg");
  options.imperfections = {};
  options.imperfections.hood = std::nan("");
  EXPECT_NE(complaintAbout(options).find("hood"), std::string::npos);
  options.imperfections = {};
  options.imperfections.right_radial = 15;
  options.width = 160;
  options.height = 120;
  EXPECT_EQ(complaintAbout(options),
            "simulation option right_radial is 15, it must be in [-10, 10]");
  options.imperfections = {};
  options.imperfections.right_delay = 0.01;
  options.rgbd = true;
  EXPECT_EQ(complaintAbout(options),
            "simulation option right_delay is 0.01, an RGB-D camera takes only 0");
}

}  // namespace
}  // namespace mvo::sim
