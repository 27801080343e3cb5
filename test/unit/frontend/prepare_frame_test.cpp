// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "frontend/features.hpp"
#include "mvo/frame.hpp"
#include "support/textures.hpp"

namespace mvo {
namespace {

const cv::Size kSize(320, 240);
const StereoCamera kCamera{250, 250, 160, 120, 0.2, kSize.width, kSize.height};

Frame frameWith(const cv::Mat& mask) {
  Frame frame;
  frame.left = frame.right = test_support::randomTexture(kSize, 1);
  frame.mask = mask;
  return frame;
}

cv::Mat withoutLowerHalf() {
  cv::Mat mask(kSize, CV_8U, cv::Scalar(255));
  mask.rowRange(kSize.height / 2, kSize.height).setTo(0);
  return mask;
}

TEST(PrepareFrame, MasksMustBeGreyAndOfTheImagesSize) {
  const auto problem = [](const cv::Mat& mask) {
    return prepareFrame(frameWith(mask), kCamera, {}).problem;
  };
  EXPECT_EQ(problem({}), "");
  EXPECT_EQ(problem(withoutLowerHalf()), "");
  EXPECT_EQ(problem(cv::Mat(120, 160, CV_8U, cv::Scalar(1))),
            "the mask image is 160x120, the calibration says 320x240");
  EXPECT_EQ(problem(cv::Mat(kSize, CV_8UC3, cv::Scalar::all(1))),
            "the mask image is not 8-bit grey");
}

TEST(PrepareFrame, CornersKeepHalfAPatchAwayFromWhatIsMasked) {
  FrontendOptions options;
  const auto all = prepareFrame(frameWith({}), kCamera, options);
  const auto masked = prepareFrame(frameWith(withoutLowerHalf()), kCamera, options);
  const int last = kSize.height / 2 - 1 - options.patch / 2;
  std::size_t expected = 0;
  int lowest = 0;
  for (const CornerPeak& p : all.images->peaks) expected += p.v <= last ? 1 : 0;
  for (const CornerPeak& p : masked.images->peaks) lowest = std::max<int>(lowest, p.v);
  EXPECT_GT(expected, 100U);
  EXPECT_EQ(masked.images->peaks.size(), expected);
  EXPECT_LE(lowest, last);
}

}  // namespace
}  // namespace mvo
