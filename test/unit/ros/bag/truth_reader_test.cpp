// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/bag/truth_reader.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "ros/bag/truth_bag.hpp"
#include "support/temporary_folder.hpp"
#include "support/trajectories.hpp"

namespace mvo_ros {
namespace {

using mvo::test::errorOf;
using mvo::test::TemporaryFolder;
using mvo::test::transform;

mvo::SequenceFrame frame(int k) {
  mvo::SequenceFrame frame;
  frame.stamp_ns = 1'500'000'000'000'000'001 + k * 100'000'000LL;
  frame.left = cv::Mat(24, 32, CV_8UC1, cv::Scalar(50));
  frame.right = frame.left;
  return frame;
}

mvo::SequenceInfo info() {
  mvo::SequenceInfo info;
  info.camera = {50, 50, 16, 12, 0.2, 32, 24};
  return info;
}

TEST(TruthReader, ReadsWhatTheSimulatorWrites) {
  const TemporaryFolder folder;
  const std::string path = (folder / "a.bag").string();
  {
    TruthBag bag(path, info());
    for (int k = 0; k < 3; ++k) {
      mvo::SequenceFrame next = frame(k);
      if (k > 0) {  // the first frame has images alone
        next.T_world_camera = transform(0.1 * k, 2, 3, 0.1, 0.2, 0.3);
        next.T_world_bodies[2] = transform(1, 0.2 * k, 3);
        next.mask = cv::Mat::zeros(24, 32, CV_8UC1);
        next.mask.at<unsigned char>(5, k) = 2;
        next.objects.push_back({2, 60, 0.01, 100, 0.8, 0.6});
      }
      bag.add(next);
    }
    bag.close();
  }
  const mvo::Truth truth = readTruthBag(path);
  ASSERT_EQ(truth.stamps_ns.size(), 3u);
  EXPECT_EQ(truth.stamps_ns[0], frame(0).stamp_ns);
  ASSERT_EQ(truth.camera.size(), 2u);
  EXPECT_EQ(truth.camera[0].stamp_ns, frame(1).stamp_ns);
  EXPECT_TRUE(truth.camera[1].T_world_body.isApprox(transform(0.2, 2, 3, 0.1, 0.2, 0.3), 1e-9));
  ASSERT_EQ(truth.bodies.count(2), 1u);
  EXPECT_EQ(truth.bodies.at(2).size(), 2u);
  ASSERT_EQ(truth.visibility.size(), 2u);
  EXPECT_EQ(truth.visibility[0].body, 2);
  EXPECT_EQ(truth.visibility[0].image_share, 0.01);  // exactly: these are limits
  EXPECT_EQ(truth.visibility[0].visible_share, 0.6);
  ASSERT_TRUE(truth.mask);
  EXPECT_TRUE(truth.mask(0).empty());
  EXPECT_EQ(truth.mask(2).at<unsigned char>(5, 2), 2);
  EXPECT_EQ(cv::countNonZero(truth.mask(2)), 1);
}

TEST(TruthReader, ABagWithoutTruthIsAnError) {
  const TemporaryFolder folder;
  const std::string path = (folder / "a.bag").string();
  {
    TruthBag bag(path, info());
    bag.add(frame(0));
    bag.close();
  }
  EXPECT_EQ(errorOf([&] { readTruthBag(path); }), path + " has no truth topics");
}

TEST(TruthReader, WhatIsNoBagIsAnError) {
  const TemporaryFolder folder;
  const std::string path = (folder / "a.bag").string();
  const auto error = [&] { return errorOf([&] { readTruthBag(path); }); };
  EXPECT_EQ(error().rfind("cannot read the truth from " + path, 0), 0u);
  std::ofstream(path) << "no bag";
  EXPECT_EQ(error().rfind("cannot read the truth from " + path, 0), 0u);
}

}  // namespace
}  // namespace mvo_ros
