// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "edges/mask_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "support/temporary_folder.hpp"

namespace mvo_ros {
namespace {

using mvo::test::errorOf;
using mvo::test::TemporaryFolder;

TEST(MaskFile, IsReadAsGrey) {
  const TemporaryFolder folder;
  const std::string path = folder / "mask.png";
  cv::Mat colour(30, 40, CV_8UC3, cv::Scalar::all(255));
  colour.rowRange(20, 30).setTo(cv::Scalar::all(0));
  cv::imwrite(path, colour);
  const Mask mask = readMask(path);
  ASSERT_EQ(mask.image.type(), CV_8UC1);
  EXPECT_EQ(mask.image.size(), cv::Size(40, 30));
  EXPECT_EQ(cv::countNonZero(mask.image), 20 * 40);
  EXPECT_EQ(cv::countNonZero(mask.image.rowRange(20, 30)), 0);
  EXPECT_NO_THROW(requireSize(mask, {40, 30}));
}

TEST(MaskFile, WhatIsWrongIsSaidWithItsName) {
  const TemporaryFolder folder;
  const std::string path = folder / "mask.png";
  EXPECT_EQ(errorOf([&] { readMask(path); }), "mask " + path + ": there is no such file");
  std::ofstream(path) << "no image";
  EXPECT_EQ(errorOf([&] { readMask(path); }), "mask " + path + ": cannot be read as an image");
  cv::imwrite(path, cv::Mat::zeros(30, 40, CV_8U));
  EXPECT_EQ(errorOf([&] { readMask(path); }),
            "mask " + path + ": is 0 everywhere, which leaves out the whole image");
  cv::imwrite(path, cv::Mat::ones(30, 40, CV_8U));
  EXPECT_EQ(errorOf([&] {
              requireSize(readMask(path), {640, 480});
            }),
            "mask " + path + ": has 40x30 pixels, but the left image has 640x480");
}

TEST(MaskFile, NoMaskFitsEveryImage) { EXPECT_NO_THROW(requireSize({}, {640, 480})); }

}  // namespace
}  // namespace mvo_ros
