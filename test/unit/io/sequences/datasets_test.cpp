// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "mvo/se3.hpp"
#include "mvo/sequence.hpp"
#include "mvo/trajectory_files.hpp"
#include "support/temporary_folder.hpp"
#include "support/trajectories.hpp"

namespace mvo {
namespace {

namespace fs = std::filesystem;

using test::errorOf;
using test::TemporaryFolder;
using test::transform;

void write(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

void writeImage(const fs::path& path, int width, int height, int value) {
  fs::create_directories(path.parent_path());
  cv::imwrite(path.string(), cv::Mat(height, width, CV_8UC1, cv::Scalar(value)));
}

// --- the package's own layout

SequenceInfo smallCamera(bool rgbd) {
  SequenceInfo info;
  info.rgbd = rgbd;
  info.camera = {50, 51, 15.5, 11.5, rgbd ? 0.0 : 0.2, 32, 24};
  info.rate_hz = 10;
  return info;
}

SequenceFrame smallFrame(int k, bool rgbd) {
  SequenceFrame frame;
  frame.stamp_ns = 1'500'000'000'000'000'001 + k * 100'000'000LL;
  frame.left = cv::Mat(24, 32, rgbd ? CV_8UC3 : CV_8UC1, cv::Scalar::all(10 + k));
  frame.right = rgbd ? cv::Mat(24, 32, CV_16UC1, cv::Scalar(1500 + k))
                     : cv::Mat(24, 32, CV_8UC1, cv::Scalar(20 + k));
  if (k == 2) return frame;  // without truth
  frame.T_world_camera = transform(0.1 * k, 0, 0, 0, 0.01 * k, 0);
  frame.T_world_bodies[1] = transform(1, 0.2 * k, 3);
  frame.mask = cv::Mat::zeros(24, 32, CV_8UC1);
  frame.mask.at<unsigned char>(5, 6) = 1;
  frame.objects.push_back({1, 77, 0.1003, 100, 0.9, 0.77});
  return frame;
}

class SequenceFolder : public ::testing::TestWithParam<bool> {};

TEST_P(SequenceFolder, WhatTheWriterWritesIsRead) {
  const bool rgbd = GetParam();
  const TemporaryFolder folder;
  SequenceWriter writer(folder.path(), smallCamera(rgbd));
  for (int k = 0; k < 3; ++k) writer.add(smallFrame(k, rgbd));
  writer.finish();

  const SequenceSource source = openSequenceFolder(folder.path());
  EXPECT_EQ(source.frames, 3u);
  EXPECT_EQ(source.info.rgbd, rgbd);
  EXPECT_DOUBLE_EQ(source.info.camera.fv, 51);
  EXPECT_DOUBLE_EQ(source.info.camera.cu, 15.5);
  EXPECT_NEAR(source.info.rate_hz, 10, 1e-9);
  for (int k = 0; k < 3; ++k) {
    const SequenceFrame expected = smallFrame(k, rgbd);
    const SequenceFrame frame = source.frame(k);
    EXPECT_EQ(frame.stamp_ns, expected.stamp_ns);
    EXPECT_EQ(frame.left.type(), expected.left.type());
    EXPECT_EQ(cv::norm(frame.left, expected.left), 0);
    EXPECT_EQ(frame.right.type(), expected.right.type());
    EXPECT_EQ(cv::norm(frame.right, expected.right), 0);
    ASSERT_EQ(frame.T_world_camera.has_value(), expected.T_world_camera.has_value());
    ASSERT_EQ(frame.objects.size(), expected.objects.size());
    if (!frame.T_world_camera) continue;
    EXPECT_TRUE(frame.T_world_camera->isApprox(*expected.T_world_camera, 1e-8));
    EXPECT_TRUE(frame.T_world_bodies.at(1).isApprox(expected.T_world_bodies.at(1), 1e-8));
    EXPECT_EQ(cv::norm(frame.mask, expected.mask), 0);
    EXPECT_EQ(frame.objects[0].visible_px, 77);
    EXPECT_EQ(frame.objects[0].silhouette_px, 100);
    EXPECT_DOUBLE_EQ(frame.objects[0].visible_share, 0.77);
    EXPECT_DOUBLE_EQ(frame.objects[0].inframe_share, 0.9);
  }
}

INSTANTIATE_TEST_SUITE_P(Sensors, SequenceFolder, ::testing::Values(false, true));

TEST(SequenceFolderErrors, NameTheFile) {
  const TemporaryFolder folder;
  const std::string calib = (folder / "calib.json").string();
  const auto error = [&] { return errorOf([&] { openSequenceFolder(folder.path()); }); };
  EXPECT_EQ(error(), "cannot read " + calib);
  write(calib, "{");
  EXPECT_EQ(error().rfind(calib, 0), 0u) << error();
  write(calib, R"({"type": "mono"})");
  EXPECT_EQ(error(), calib + ": type is 'mono', neither stereo nor rgbd");
  write(calib, R"({"type": "stereo", "width": 32, "height": 24, "fx": 0, "fy": 50, "cx": 16,
                   "cy": 12, "baseline": 0.1})");
  EXPECT_EQ(error().rfind(calib, 0), 0u) << error();
  write(calib, R"({"type": "stereo", "width": 32, "height": 24, "fx": 50, "fy": 50, "cx": 16,
                   "cy": 12, "baseline": 0.1})");
  write(folder / "times.txt", "0 1.0\n");
  const SequenceSource source = openSequenceFolder(folder.path());
  const auto frame_error = [&] { return errorOf([&] { source.frame(0); }); };
  EXPECT_EQ(frame_error(), "there is no image " + (folder / "left/000000.png").string());
  writeImage(folder / "left/000000.png", 30, 24, 0);
  EXPECT_EQ(frame_error(), (folder / "left/000000.png").string() +
                               " has 30x24 pixels, the calibration says 32x24");
  write(folder / "left/000000.png", "no image");
  EXPECT_EQ(frame_error(), (folder / "left/000000.png").string() + " is not a readable image");
}

TEST(Truth, IsReadAsFarAsItGoes) {
  const TemporaryFolder folder;
  EXPECT_EQ(errorOf([&] { readTruth(folder.path()); }),
            folder.path().string() + " is not a sequence with a truth folder");
  write(folder / "times.txt", "4 1.0\n5 1.1\n6 1.2\n");
  fs::create_directories(folder / "truth");
  const Truth bare = readTruth(folder.path());
  EXPECT_EQ(bare.stamps_ns.size(), 3u);
  EXPECT_TRUE(bare.camera.empty());
  EXPECT_FALSE(bare.mask);

  write(folder / "truth/camera.tum", "1.1 1 2 3 0 0 0 1\n");
  write(folder / "truth/object_12.tum", "1.1 1 2 3 0 0 0 1\n");
  write(folder / "truth/object_x.tum", "not a body\n");
  write(folder / "truth/boxes.csv", "frame,x,y,width,height\n5,10,20,30,40\n");
  writeImage(folder / "truth/masks/000005.png", 8, 6, 12);
  const Truth truth = readTruth(folder.path());
  EXPECT_EQ(truth.camera.size(), 1u);
  ASSERT_EQ(truth.bodies.size(), 1u);
  EXPECT_EQ(truth.bodies.count(12), 1u);
  ASSERT_EQ(truth.boxes.size(), 1u);
  EXPECT_EQ(truth.boxes[0].stamp_ns, 1'100'000'000);
  EXPECT_DOUBLE_EQ(truth.boxes[0].width, 30);
  EXPECT_EQ(truth.mask(1).at<unsigned char>(0, 0), 12);
  EXPECT_TRUE(truth.mask(0).empty());

  write(folder / "truth/body_boxes.csv",
        "frame,body,x1,y1,x2,y2,occluded_by\n4,A,10,20,30,60,pole\n");
  write(folder / "truth/velocities.csv", "first,last,body,vx,vz,sd\n4,6,A,1,2,0.5\n");
  const Truth boxed = readTruth(folder.path());
  ASSERT_EQ(boxed.boxes.size(), 2u);  // both files'
  EXPECT_EQ(boxed.boxes[1].body, "A");
  ASSERT_EQ(boxed.velocities.size(), 1u);
  EXPECT_EQ(boxed.velocities[0].last_ns, 1'200'000'000);
  EXPECT_FALSE(boxed.calibration);
  write(folder / "calib.json",
        R"({"type": "rgbd", "width": 8, "height": 6, "fx": 5, "fy": 6, "cx": 4, "cy": 3})");
  EXPECT_DOUBLE_EQ(readTruth(folder.path()).calibration->fv, 6);

  write(folder / "truth/boxes.csv", "frame,x,y,width,height\n9,10,20,30,40\n");
  EXPECT_EQ(
      errorOf([&] { readTruth(folder.path()); }),
      (folder / "truth/boxes.csv").string() + ":2: column 'frame': frame 9 is not in times.txt");
}

// --- KITTI

void writeKitti(const fs::path& folder) {
  write(folder / "calib.txt",
        "P0: 700 0 16 0 0 701 12 0 0 0 1 0\nP1: 700 0 16 -350 0 701 12 0 0 0 1 0\n");
  write(folder / "times.txt", "0.000000e+00\n1.036224e-01\n");
  for (const char* name : {"000000.png", "000001.png"}) {
    writeImage(folder / "image_0" / name, 32, 24, 100);
    writeImage(folder / "image_1" / name, 32, 24, 200);
  }
}

TEST(Kitti, IsRead) {
  const TemporaryFolder folder;
  const fs::path sequence = folder / "sequences" / "07";
  writeKitti(sequence);
  write(folder / "poses/07.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n0 -1 0 5 1 0 0 6 0 0 1 7\n");
  for (const fs::path& path : {sequence, sequence / ""}) {
    const SequenceSource source = openKitti(path);
    EXPECT_EQ(source.frames, 2u);
    EXPECT_FALSE(source.info.rgbd);
    EXPECT_DOUBLE_EQ(source.info.camera.baseline, 0.5);
    EXPECT_DOUBLE_EQ(source.info.camera.fv, 701);
    EXPECT_EQ(source.info.camera.width, 32);
    const SequenceFrame frame = source.frame(1);
    EXPECT_EQ(frame.stamp_ns, 1000'103'622'400);
    EXPECT_EQ(frame.left.at<unsigned char>(0, 0), 100);
    EXPECT_EQ(frame.right.at<unsigned char>(0, 0), 200);
    ASSERT_TRUE(frame.T_world_camera);
    EXPECT_TRUE(frame.T_world_camera->isApprox(transform(5, 6, 7, 0, 0, M_PI / 2), 1e-9));
  }
}

TEST(Kitti, WorksWithoutPosesAndNamesWhatIsWrong) {
  const TemporaryFolder folder;
  writeKitti(folder.path());
  EXPECT_FALSE(openKitti(folder.path()).frame(0).T_world_camera);
  write(folder / "poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  EXPECT_EQ(errorOf([&] { openKitti(folder.path()); }),
            (folder / "poses.txt").string() + " has 1 poses for 2 frames");
  write(folder / "calib.txt", "P0: 700 0 16 0 0 701 12 0 0 0 1 0\n");
  EXPECT_EQ(errorOf([&] { openKitti(folder.path()); }),
            (folder / "calib.txt").string() + " has no projections P0 and P1");
}

// --- Oxford Multimotion

std::string viconRow(const std::string& time, const std::string& object,
                     const Eigen::Isometry3d& T) {
  std::string row = time + "," + object;
  const Eigen::Quaterniond q(T.linear());
  const auto t = T.translation();
  for (const double value : {q.x(), q.y(), q.z(), q.w(), t.x(), t.y(), t.z()})
    row += "," + std::to_string(value);
  for (int i = 0; i < 16; ++i) row += "," + std::to_string(T.matrix()(i / 4, i % 4));
  return row + "\n";
}

const std::string kViconHeader =
    "time_sec,time_nsec,object,qx,qy,qz,qw,tx,ty,tz,T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,"
    "T23,T30,T31,T32,T33\n";

void writeOxford(const fs::path& dataset, const std::string& cam0, const std::string& cam1) {
  const fs::path segment = dataset / "swinging";
  write(dataset / "kalibr_2019.yaml",
        "cam0:\n  camera_model: pinhole\n" + cam0 +
            "  intrinsics: [200.0, 200.0, 32.0, 24.0]\n  resolution: [64, 48]\n"
            "  rostopic: /bumblebee/left/image\ncam1:\n" +
            cam1 +
            "  intrinsics: [200.0, 200.0, 32.0, 24.0]\n  resolution: [64, 48]\n"
            "  rostopic: /bumblebee/right/image\n");
  write(dataset / "vicon_2019.yaml",
        "T_apparatus_left:\n- [0.0, 0.0, 1.0, 0.1]\n- [-1.0, 0.0, 0.0, 0.0]\n"
        "- [0.0, -1.0, 0.0, 0.0]\n- [0.0, 0.0, 0.0, 1.0]\n");
  write(segment / "stereo/stereo.csv",
        "frame_num,time_sec,time_nsec\n0,100,500\n1,100,100000500\n");
  write(segment / "vicon.csv", kViconHeader + viconRow("102,0", "box2", transform(1, 0, 0)) +
                                   viconRow("102,0", "box1", transform(2, 0, 0)) +
                                   viconRow("102,0", "sensor_payload", transform(0, 0, 1)) +
                                   viconRow("102,100000000", "sensor_payload", transform(0, 0, 2)) +
                                   viconRow("102,100000000", "box1", transform(2, 1, 0)));
  for (const char* name : {"000000", "000001"}) {
    writeImage(segment / "stereo" / (std::string(name) + "_left.png"), 64, 48, 100);
    writeImage(segment / "stereo" / (std::string(name) + "_right.png"), 64, 48, 200);
  }
}

const std::string kStraight =
    "  T_cn_cnm1:\n  - [1.0, 0.0, 0.0, -0.24]\n  - [0.0, 1.0, 0.0, 0.0]\n"
    "  - [0.0, 0.0, 1.0, 0.0]\n  - [0.0, 0.0, 0.0, 1.0]\n";

TEST(Oxford, ARectifiedSegmentIsRead) {
  const TemporaryFolder folder;
  writeOxford(folder.path(), "", kStraight);
  OxfordOptions options;
  options.vicon_offset = -2;
  const SequenceSource source = openOxford(folder / "swinging", options);
  EXPECT_EQ(source.frames, 2u);
  EXPECT_DOUBLE_EQ(source.info.camera.baseline, 0.24);
  EXPECT_DOUBLE_EQ(source.info.camera.fu, 200);
  EXPECT_EQ(source.info.camera.width, 64);
  const SequenceFrame frame = source.frame(1);
  EXPECT_EQ(frame.stamp_ns, 100'100'000'500);
  EXPECT_EQ(frame.left.at<unsigned char>(3, 3), 100);
  EXPECT_EQ(frame.right.at<unsigned char>(3, 3), 200);
  ASSERT_TRUE(frame.T_world_camera);
  // The camera looks along the apparatus' x axis, 0.1 m ahead of its origin.
  EXPECT_TRUE(frame.T_world_camera->translation().isApprox(Eigen::Vector3d(0.1, 0, 2), 1e-6));
  EXPECT_TRUE((frame.T_world_camera->linear() * Eigen::Vector3d::UnitZ())
                  .isApprox(Eigen::Vector3d::UnitX(), 1e-6));
  ASSERT_EQ(frame.T_world_bodies.size(), 1u);  // box2 was not seen then
  EXPECT_TRUE(frame.T_world_bodies.at(1).translation().isApprox(Eigen::Vector3d(2, 1, 0), 1e-6));
  EXPECT_EQ(source.frame(0).T_world_bodies.size(), 2u);
}

TEST(Oxford, WithoutTheOffsetThePosesAreOfAnotherTime) {
  const TemporaryFolder folder;
  writeOxford(folder.path(), "", kStraight);
  EXPECT_FALSE(openOxford(folder / "swinging").frame(0).T_world_camera);
}

// The right camera is turned by 0.15 rad about the optical axis: what is one row in the scene is
// one row in both images only after rectification.
TEST(Oxford, ARotatedPairIsRectified) {
  const TemporaryFolder folder;
  const double c = std::cos(0.15);
  const double s = std::sin(0.15);
  const auto row = [](double a, double b, double d, double e) {
    return "  - [" + std::to_string(a) + ", " + std::to_string(b) + ", " + std::to_string(d) +
           ", " + std::to_string(e) + "]\n";
  };
  writeOxford(folder.path(), "  distortion_coeffs: [0.0, 0.0, 0.0, 0.0]\n",
              "  T_cn_cnm1:\n" + row(c, -s, 0, -0.24 * c) + row(s, c, 0, -0.24 * s) +
                  row(0, 0, 1, 0) + row(0, 0, 0, 1));
  // A bright spot at a scene point of both images.
  const Eigen::Isometry3d T_right_left = transform(0, 0, 0, 0, 0, 0.15) * transform(-0.24, 0, 0);
  const Eigen::Vector3d p_left(0.44, 0.15, 4.0);
  const auto spot = [&](const std::string& side, const Eigen::Vector3d& p) {
    cv::Mat image = cv::Mat::zeros(48, 64, CV_8UC1);
    const double u = 200 * p.x() / p.z() + 32;
    const double v = 200 * p.y() / p.z() + 24;
    for (int y = 0; y < image.rows; ++y)
      for (int x = 0; x < image.cols; ++x)
        image.at<unsigned char>(y, x) = cv::saturate_cast<unsigned char>(
            250 * std::exp(-((x - u) * (x - u) + (y - v) * (y - v)) / 4));
    cv::imwrite((folder / ("swinging/stereo/000000_" + side + ".png")).string(), image);
  };
  spot("left", p_left);
  spot("right", T_right_left * p_left);
  const auto centre = [](const cv::Mat& image) {
    const cv::Moments m = cv::moments(image);
    return cv::Point2d(m.m10 / m.m00, m.m01 / m.m00);
  };
  const SequenceSource source = openOxford(folder / "swinging");
  const SequenceFrame frame = source.frame(0);
  const cv::Point2d left = centre(frame.left);
  const cv::Point2d right = centre(frame.right);
  EXPECT_NEAR(left.y, right.y, 0.1);
  const double disparity = source.info.camera.fu * source.info.camera.baseline / 4.0;
  EXPECT_NEAR(left.x - right.x, disparity, 0.2);
  EXPECT_NEAR(source.info.camera.baseline, 0.24, 1e-6);

  OxfordOptions as_they_are;
  as_they_are.rectified = true;
  const SequenceFrame raw = openOxford(folder / "swinging", as_they_are).frame(0);
  EXPECT_GT(std::abs(centre(raw.left).y - centre(raw.right).y), 1.0);
}

TEST(Oxford, NamesWhatIsMissing) {
  const TemporaryFolder folder;
  const fs::path segment = folder / "swinging";
  EXPECT_EQ(errorOf([&] { openOxford(segment); }),
            "cannot read " + (segment / "stereo/stereo.csv").string());
  writeOxford(folder.path(), "", kStraight);
  OxfordOptions options;
  options.apparatus = "robot";
  EXPECT_EQ(errorOf([&] { openOxford(segment, options); }),
            (segment / "vicon.csv").string() + " has no object 'robot'");
  const std::string calibration = (folder / "kalibr_2019.yaml").string();
  write(calibration, "cam0:\n  intrinsics: [1, 2, 3]\n  resolution: [64, 48]\n");
  EXPECT_EQ(errorOf([&] { openOxford(segment); }),
            calibration + ": cam0 has no resolution or no pinhole intrinsics");
  write(calibration, "nothing: [1]\n");
  EXPECT_EQ(errorOf([&] { openOxford(segment); }), calibration + ": no cam0");
}

}  // namespace
}  // namespace mvo
