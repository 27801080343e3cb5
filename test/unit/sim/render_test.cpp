// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "mvo/sim.hpp"
#include "support/photometric.hpp"

namespace mvo::sim {
namespace {

SceneOptions small() {
  SceneOptions options;
  options.width = 160;
  options.height = 120;
  return options;
}

SceneOptions clean() {
  SceneOptions options;
  options.noise = 0;
  options.gain = 1;
  return options;
}

// The blocks without noise or gain, made once.
const Scene& cleanBlocks() {
  static const Scene scene = makeScene("blocks", 2, clean());
  return scene;
}

using test::photometricError;
using test::pointAt;

bool identical(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

// Pixels of a body whose neighbourhood is the body as well.
cv::Mat inside(const cv::Mat& mask, int id, int margin) {
  cv::Mat region;
  cv::erode(mask == id, region,
            cv::getStructuringElement(cv::MORPH_RECT, {2 * margin + 1, 2 * margin + 1}));
  return region;
}

TEST(Render, EverySceneFillsItsImages) {
  for (const std::string& name : sceneNames()) {
    const Scene scene = makeScene(name, 3, small());
    const RenderedFrame frame = render(scene, 40);
    EXPECT_EQ(frame.left.type(), CV_8UC1);
    EXPECT_EQ(frame.right.size(), cv::Size(160, 120));
    EXPECT_EQ(frame.T_world_bodies.size(), scene.bodies.size()) << name;
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(frame.left, mean, deviation);
    EXPECT_GT(mean[0], 60) << name;
    EXPECT_GT(deviation[0], name == "corridor" ? 10 : 15) << name;
    double nearest = 0;
    double farthest = 0;
    cv::minMaxLoc(frame.depth, &nearest, &farthest);
    EXPECT_GT(nearest, 0.4) << name;
    EXPECT_LT(farthest, name == "street" ? 600 : name == "corridor" ? 27 : 12) << name;
    EXPECT_TRUE(cv::checkRange(frame.depth)) << name << ": every pixel shows something";
    double largest = 0;
    cv::minMaxLoc(frame.mask, nullptr, &largest);
    EXPECT_EQ(static_cast<std::size_t>(largest), scene.bodies.size()) << name;
  }
}

TEST(Render, SameBytesAgainAndFromOtherThreads) {
  const Scene scene = makeScene("blocks", 3, small());
  const Scene again = makeScene("blocks", 3, small());
  const RenderedFrame frame = render(scene, 7);
  render(again, 2);
  auto other = std::async(std::launch::async, [&] { return render(again, 7); });
  auto neighbour = std::async(std::launch::async, [&] { return render(again, 8); });
  const RenderedFrame same = other.get();
  EXPECT_TRUE(identical(frame.left, same.left));
  EXPECT_TRUE(identical(frame.right, same.right));
  EXPECT_TRUE(identical(frame.mask, same.mask));
  EXPECT_FALSE(identical(frame.left, neighbour.get().left));
  EXPECT_FALSE(identical(frame.left, render(makeScene("blocks", 4, small()), 7).left));
}

// Every point of a body's faces is seen where truth and camera say, or something nearer hides it.
TEST(Render, TruthPutsBodyPointsOnTheirMaskAtTheirDepth) {
  const Scene& scene = cleanBlocks();
  const RenderedFrame frame = render(scene, 33);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    int seen = 0;
    for (const Face& face : scene.bodies[i].faces) {
      if (!face.counts) continue;
      const Eigen::Isometry3d T_camera_body =
          frame.T_world_camera.inverse() * frame.T_world_bodies[i];
      Eigen::Vector3d center = Eigen::Vector3d::Zero();
      for (const auto& corner : face.corners) center += corner / face.corners.size();
      if ((T_camera_body.linear() * face.normal).dot(T_camera_body * center) > -0.1) continue;
      for (const Eigen::Vector3d& corner : face.corners) {
        const Eigen::Vector3d p = T_camera_body * (center + 0.7 * (corner - center));
        const Eigen::Vector3d pixel = scene.camera.project(p);
        const cv::Point at(static_cast<int>(std::lround(pixel.x())),
                           static_cast<int>(std::lround(pixel.y())));
        if (!cv::Rect(0, 0, 640, 480).contains(at)) continue;
        if (frame.mask.at<std::uint8_t>(at) == i + 1) {
          ++seen;
          const Eigen::Vector3d seen_camera =
              pointAt(scene.camera, at.x, at.y, frame.depth.at<float>(at));
          const Eigen::Vector3d seen_body = T_camera_body.inverse() * seen_camera;
          EXPECT_NEAR(face.normal.dot(seen_body - center), 0, 1e-4) << "lies in the face";
          EXPECT_LT((seen_camera - p).norm(), 0.1);
        } else {
          EXPECT_LT(frame.depth.at<float>(at), p.z()) << "hidden by something nearer";
        }
      }
    }
    EXPECT_GE(seen, 4) << "body " << i + 1;
  }
}

TEST(Render, DisparityAgreesWithDepth) {
  const Scene& scene = cleanBlocks();
  const StereoCamera& camera = scene.camera;
  const RenderedFrame frame = render(scene, 20);
  const cv::Mat region = inside(frame.mask, 4, 6) | inside(frame.mask, 1, 6);
  const auto difference = [&](double shift) {
    return photometricError(frame, frame.right, region, camera, [&](const Eigen::Vector3d& p) {
      return Eigen::Vector2d(camera.project(p).z() + shift, camera.project(p).y());
    });
  };
  const double aligned = difference(0);
  EXPECT_LE(aligned, 8);
  EXPECT_GT(difference(0.5), 1.5 * aligned);
  EXPECT_GT(difference(-0.5), 1.5 * aligned);
}

TEST(Render, BodiesLookTheSameInTheNextFrame) {
  const Scene& scene = cleanBlocks();
  const RenderedFrame now = render(scene, 20);
  const RenderedFrame next = render(scene, 21);
  for (int id = 1; id <= 4; ++id) {
    const Eigen::Isometry3d T_next_now = next.T_world_camera.inverse() *
                                         next.T_world_bodies[id - 1] *
                                         now.T_world_bodies[id - 1].inverse() * now.T_world_camera;
    const auto difference = [&](const Eigen::Isometry3d& T) {
      return photometricError(
          now, next.left, inside(now.mask, id, 6), scene.camera,
          [&](const Eigen::Vector3d& p) { return scene.camera.project(T * p).head<2>().eval(); });
    };
    const double with_truth = difference(T_next_now);
    EXPECT_LE(with_truth, 10) << "body " << id;
    EXPECT_GT(difference(next.T_world_camera.inverse() * now.T_world_camera), 2 * with_truth)
        << "body " << id << " does not move with the room";
  }
}

TEST(Render, BodiesHaveCorners) {
  for (const std::string name : {"blocks", "spin", "cars", "occlusion"}) {
    const Scene scene = makeScene(name, 6);
    const RenderedFrame frame = render(scene, 10);
    for (const BodyVisibility& object : frame.objects) {
      if (object.visible_share < 0.95) continue;
      std::vector<cv::Point2f> corners;
      cv::goodFeaturesToTrack(frame.left, corners, 500, 0.01, 4,
                              inside(frame.mask, object.body, 3));
      EXPECT_GE(corners.size(), 30U) << name << " body " << object.body;
    }
  }
}

TEST(Render, VisibilityFollowsTheMask) {
  Scene scene = cleanBlocks();
  const RenderedFrame hung = render(scene, 0);
  const BodyVisibility& first = hung.objects.at(0);
  EXPECT_EQ(first.body, 1);
  EXPECT_LT(first.visible_px, cv::countNonZero(hung.mask == 1)) << "the string is not counted";
  EXPECT_DOUBLE_EQ(first.image_share, first.visible_px / (640.0 * 480.0));
  EXPECT_DOUBLE_EQ(first.visible_share, first.visible_px / (1.0 * first.silhouette_px));
  // Half of a body before the left edge of the image: the camera is turned by half its view.
  const double half_view = std::atan((scene.camera.cu + 0.5) / scene.camera.fu);
  const Eigen::Isometry3d T_world_body = hung.T_world_bodies[0];
  scene.T_world_camera = [=](double) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation() = T_world_body * Eigen::Vector3d(-3, 0, 0);
    T.linear() = T_world_body.linear() *
                 Eigen::AngleAxisd(-half_view, Eigen::Vector3d::UnitZ()).matrix() *
                 (Eigen::Matrix3d() << 0, 0, 1, -1, 0, 0, 0, -1, 0).finished();
    return T;
  };
  const BodyVisibility half = render(scene, 0).objects.at(0);
  EXPECT_NEAR(half.inframe_share, 0.5, 0.05);
  EXPECT_LE(half.visible_share, half.inframe_share);
  EXPECT_GT(half.silhouette_px, 5000);
}

TEST(Render, OcclusionHidesTheBoxAndShowsItAgain) {
  const Scene scene = makeScene("occlusion", 9, small());
  int hidden = 0;
  int whole = 0;
  int changes = 0;
  bool was_hidden = false;
  for (int i = 0; i < 200; i += 2) {
    const BodyVisibility box = render(scene, i).objects.at(0);
    const bool is_hidden = box.visible_px == 0;
    hidden += is_hidden ? 1 : 0;
    whole += box.visible_share > 0.95 ? 1 : 0;
    changes += is_hidden != was_hidden ? 1 : 0;
    was_hidden = is_hidden;
  }
  EXPECT_GE(hidden, 5);
  EXPECT_GE(whole, 40);
  EXPECT_GE(changes, 2) << "it comes out again";
}

TEST(Render, RgbdHasColourAndMetricDepth) {
  SceneOptions options = small();
  options.rgbd = true;
  const Scene scene = makeScene("cars", 2, options);
  const RenderedFrame frame = render(scene, 5);
  EXPECT_TRUE(frame.right.empty());
  ASSERT_EQ(frame.color.type(), CV_8UC3);
  cv::Mat grey;
  cv::cvtColor(frame.color, grey, cv::COLOR_BGR2GRAY);
  EXPECT_TRUE(identical(grey, frame.left));
  std::vector<cv::Mat> channels;
  cv::split(frame.color, channels);
  EXPECT_GT(cv::norm(channels[0], channels[2], cv::NORM_L1) / frame.left.total(), 3) << "colourful";

  const SequenceFrame stored = toSequenceFrame(frame);
  ASSERT_EQ(stored.right.type(), CV_16UC1);
  for (const cv::Point p : {cv::Point(80, 60), cv::Point(10, 110), cv::Point(150, 5)}) {
    EXPECT_NEAR(stored.right.at<std::uint16_t>(p), 1000 * frame.depth.at<float>(p), 0.51);
  }
  const Frame input = toFrame(frame);
  EXPECT_TRUE(input.right.empty());
  EXPECT_TRUE(identical(input.depth, frame.depth));
  // The lowest pixel in the ninth shows the floor: depth by the camera's height.
  const Eigen::Vector3d p_world =
      frame.T_world_camera * pointAt(scene.camera, 80, 119, frame.depth.at<float>(119, 80));
  EXPECT_NEAR(p_world.z(), 0, 1e-3);
}

TEST(Render, DepthBeyondSixteenBitsIsAHole) {
  SceneOptions options = usualOptions("street");
  options.width /= 4;
  options.height /= 4;
  options.rgbd = true;
  const RenderedFrame frame = render(makeScene("street", 1, options), 0);
  const cv::Mat stored = toSequenceFrame(frame).right;
  EXPECT_GT(cv::countNonZero(frame.depth > 70), 1000) << "the sky";
  EXPECT_EQ(cv::countNonZero((stored != 0) & (frame.depth > 65.536)), 0);
  EXPECT_EQ(cv::countNonZero((stored == 0) & (frame.depth < 65.534)), 0);
}

TEST(Render, GainBrightensTheRightImage) {
  SceneOptions options = small();
  options.gain = 1.2;
  const RenderedFrame frame = render(makeScene("static", 1, options), 0);
  EXPECT_NEAR(cv::mean(frame.right)[0] / cv::mean(frame.left)[0], 1.2, 0.04);
}

TEST(Render, BlurSmearsWhatMoves) {
  SceneOptions options = small();
  options.noise = 0;
  options.rate_hz = 3;
  const auto sharpness = [&](double blur) {
    options.blur = blur;
    const RenderedFrame frame = render(makeScene("spin", 1, options), 3);
    cv::Mat edges;
    cv::Laplacian(frame.left, edges, CV_32F);
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(edges, mean, deviation, inside(frame.mask, 1, 2));
    return deviation[0];
  };
  EXPECT_LT(sharpness(1.0), 0.9 * sharpness(0));
}

}  // namespace
}  // namespace mvo::sim
