// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The kernels against what their comments say, one pixel after the other in double.
#include "kernels/patch.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <random>
#include <tuple>
#include <vector>

#include "support/halves.hpp"
#include "support/textures.hpp"

namespace mvo {
namespace {

using test_support::randomTexture;

constexpr float kU = 70.3F;
constexpr float kV = 55.8F;

GreyImage grey(const cv::Mat& image) {
  return {image.data, static_cast<std::ptrdiff_t>(image.step)};
}

double at(const cv::Mat& image, double u, double v) {
  const int iu = static_cast<int>(std::floor(u));
  const int iv = static_cast<int>(std::floor(v));
  const double a = u - iu;
  const double b = v - iv;
  const uchar* p = image.ptr(iv) + iu;
  const uchar* q = image.ptr(iv + 1) + iu;
  return (1 - b) * ((1 - a) * p[0] + a * p[1]) + b * ((1 - a) * q[0] + a * q[1]);
}

class FlowKernels : public testing::TestWithParam<std::tuple<Half, int>> {
 protected:
  FlowKernels()
      : taken_(std::get<0>(GetParam())),
        side_(std::get<1>(GetParam())),
        row_(paddedToLanes(side_)),
        room_(static_cast<std::size_t>(flowRoom(side_))),
        memory_(static_cast<std::size_t>(3 * side_ * row_)),
        patch_{memory_.data(), memory_.data() + side_ * row_, memory_.data() + 2 * side_ * row_} {
    takeFlowPatch(grey(image_), kU, kV, side_, room_.data(), patch_);
  }

  test::TakesHalf taken_;
  const cv::Mat image_ = randomTexture({160, 120}, 1);
  int side_;
  int row_;
  std::vector<float> room_;
  std::vector<float> memory_;
  FlowPatch patch_;
};

TEST_P(FlowKernels, TakeValuesAndGradientsFreeOfGainAndOffset) {
  const int half = side_ / 2;
  const int n = side_ * side_;
  Eigen::MatrixX3d raw(n, 3);  // value, gx, gy
  Eigen::MatrixX3d taken(n, 3);
  for (int y = 0; y < side_; ++y)
    for (int x = 0; x < row_; ++x) {
      const double u = kU + x - half;
      const double v = kV + y - half;
      const int i = y * row_ + x;
      if (x >= side_) {
        EXPECT_EQ(patch_.values[i], 0);
        EXPECT_EQ(patch_.gx[i], 0);
        EXPECT_EQ(patch_.gy[i], 0);
        continue;
      }
      raw.row(y * side_ + x) << at(image_, u, v),
          0.5 * (at(image_, u + 1, v) - at(image_, u - 1, v)),
          0.5 * (at(image_, u, v + 1) - at(image_, u, v - 1));
      taken.row(y * side_ + x) << patch_.values[i], patch_.gx[i], patch_.gy[i];
    }
  raw.rowwise() -= raw.colwise().mean().eval();
  const Eigen::VectorXd value = raw.col(0);
  raw.rightCols<2>() -= value * (value.transpose() * raw.rightCols<2>()) / value.squaredNorm();
  EXPECT_LT((taken - raw).cwiseAbs().maxCoeff(), 2e-3);
  const Eigen::Matrix3d H = raw.transpose() * raw;
  EXPECT_NEAR(patch_.square, H(0, 0), 1e-4 * H(0, 0));
  EXPECT_NEAR(patch_.hxx, H(1, 1), 1e-4 * H(1, 1));
  EXPECT_NEAR(patch_.hxy, H(1, 2), 1e-4 * (H(1, 1) + H(2, 2)));
  EXPECT_NEAR(patch_.hyy, H(2, 2), 1e-4 * H(2, 2));
}

TEST_P(FlowKernels, SumsOverTheImage) {
  const float u = kU + 0.6F;
  const float v = kV - 1.3F;
  const int half = side_ / 2;
  double x_sum = 0;
  double y_sum = 0;
  double product = 0;
  for (int y = 0; y < side_; ++y)
    for (int x = 0; x < side_; ++x) {
      const int i = y * row_ + x;
      const double s = at(image_, u + x - half, v + y - half);
      x_sum += s * patch_.gx[i];
      y_sum += s * patch_.gy[i];
      product += s * patch_.values[i];
    }
  const FlowSums found = flowSums(grey(image_), u, v, side_, patch_);
  const double scale = patch_.hxx + patch_.hyy;
  EXPECT_NEAR(found.x, x_sum, 1e-4 * scale);
  EXPECT_NEAR(found.y, y_sum, 1e-4 * scale);
  EXPECT_NEAR(found.product, product, 1e-4 * patch_.square);
  EXPECT_GT(std::abs(x_sum) + std::abs(y_sum), 0.05 * scale) << "there is something to compare";
}

INSTANTIATE_TEST_SUITE_P(Sides, FlowKernels,
                         testing::Combine(testing::Values(Half::kPortable, Half::kMachine,
                                                          Half::kTwoRoundings),
                                          testing::Values(5, 7, 13, 15, 21)));

using PatchKernels = test::BothHalves;

TEST_P(PatchKernels, AffineSums) {
  const cv::Mat image = randomTexture({160, 120}, 2);
  constexpr int n = 32;
  constexpr int used = 27;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-9, 9);
  std::uniform_real_distribution<float> number(-1, 1);
  std::vector<float> x(n, 0);
  std::vector<float> y(n, 0);
  std::vector<float> weight(n, 0);
  std::vector<float> value(n, 0);
  std::vector<float> descent(6 * n, 0);
  for (int i = 0; i < used; ++i) {
    x[i] = place(random);
    y[i] = place(random);
    weight[i] = number(random) + 1;
    value[i] = number(random);
    for (int r = 0; r < 6; ++r) descent[r * n + i] = number(random);
  }
  const float warp[6] = {1.1F, 0.2F, -0.15F, 0.9F, kU, kV};
  const AffineSums found =
      affineSums(grey(image), warp,
                 {n, x.data(), y.data(), weight.data(), value.data(), descent.data(), 100.0F});
  double expected[9] = {};
  for (int i = 0; i < used; ++i) {
    const double s = at(image, warp[0] * x[i] + warp[1] * y[i] + warp[4],
                        warp[2] * x[i] + warp[3] * y[i] + warp[5]) -
                     100;
    expected[0] += weight[i] * s;
    expected[1] += weight[i] * s * s;
    expected[2] += weight[i] * s * value[i];
    for (int r = 0; r < 6; ++r) expected[3 + r] += s * descent[r * n + i];
  }
  EXPECT_NEAR(found.mean, expected[0], 0.02);
  EXPECT_NEAR(found.square, expected[1], 1e-4 * expected[1]);
  EXPECT_NEAR(found.product, expected[2], 0.02);
  for (int r = 0; r < 6; ++r) EXPECT_NEAR(found.descent[r], expected[3 + r], 0.02) << r;
}

TEST_P(PatchKernels, RowCorrelations) {
  const cv::Mat image = randomTexture({160, 120}, 4);
  constexpr int side = 9;
  cv::Mat patch;
  image(cv::Rect(60, 50, side, side)).convertTo(patch, CV_32F);
  patch -= cv::mean(patch);
  patch /= cv::norm(patch);
  for (const int count : {1, 5, 8, 11, 29}) {
    std::vector<float> found(count);
    rowCorrelations(image.ptr(50) + 55, static_cast<std::ptrdiff_t>(image.step), side,
                    patch.ptr<float>(), count, found.data());
    for (int i = 0; i < count; ++i) {
      cv::Mat there;
      image(cv::Rect(55 + i, 50, side, side)).convertTo(there, CV_32F);
      there -= cv::mean(there);
      EXPECT_NEAR(found[i], patch.dot(there) / cv::norm(there), 1e-4) << count << ", " << i;
    }
  }
  const cv::Mat flat(20, 60, CV_8U, cv::Scalar(90));
  std::vector<float> found(12, 1);
  rowCorrelations(flat.ptr(3), static_cast<std::ptrdiff_t>(flat.step), side, patch.ptr<float>(), 12,
                  found.data());
  for (const float c : found) EXPECT_EQ(c, 0);
}

template <typename Numbers>
void keep(const Numbers& numbers, std::vector<double>& outputs) {
  for (const auto number : numbers) outputs.push_back(number);
}

TEST(PatchKernelBits, OfFlowAreTheSameOnBothHalves) {
  const cv::Mat image = randomTexture({160, 120}, 1);
  test::expectSameBitsOnBothHalves([&] {
    std::vector<double> outputs;
    std::mt19937 random(6);
    std::uniform_real_distribution<float> place(-9, 9);
    for (int i = 0; i < 100; ++i) {
      const int side = 3 + 2 * (i % 12);
      const int row = paddedToLanes(side);
      std::vector<float> room(static_cast<std::size_t>(flowRoom(side)));
      std::vector<float> memory(static_cast<std::size_t>(3 * side * row));
      FlowPatch patch{memory.data(), memory.data() + side * row, memory.data() + 2 * side * row};
      takeFlowPatch(grey(image), kU + place(random), kV + place(random), side, room.data(), patch);
      const FlowSums sums =
          flowSums(grey(image), kU + place(random), kV + place(random), side, patch);
      keep(memory, outputs);
      keep(std::vector<float>{patch.square, patch.hxx, patch.hxy, patch.hyy, sums.x, sums.y,
                              sums.product},
           outputs);
    }
    return outputs;
  });
}

TEST(PatchKernelBits, OfAffineSumsAreTheSameOnBothHalves) {
  const cv::Mat image = randomTexture({160, 120}, 2);
  test::expectSameBitsOnBothHalves([&] {
    std::vector<double> outputs;
    std::mt19937 random(8);
    std::uniform_real_distribution<float> number(-1, 1);
    for (int repeat = 0; repeat < 50; ++repeat) {
      constexpr int n = 48;
      std::vector<float> values(10 * n);
      for (float& value : values) value = number(random);
      for (int i = 0; i < 2 * n; ++i) values[i] *= 9;
      const float warp[6] = {1.1F, 0.2F, -0.15F, 0.9F, kU, kV};
      const float* from = values.data();
      const AffineSums found = affineSums(
          grey(image), warp, {n, from, from + n, from + 2 * n, from + 3 * n, from + 4 * n, 100.0F});
      keep(std::vector<float>{found.mean, found.square, found.product}, outputs);
      keep(found.descent, outputs);
    }
    return outputs;
  });
}

TEST(PatchKernelBits, OfCorrelationsAreTheSameOnBothHalves) {
  const cv::Mat image = randomTexture({160, 120}, 4);
  test::expectSameBitsOnBothHalves([&] {
    std::vector<double> outputs;
    for (int count = 1; count < 40; ++count) {
      constexpr int side = 9;
      cv::Mat patch;
      image(cv::Rect(60, 30 + count, side, side)).convertTo(patch, CV_32F);
      patch -= cv::mean(patch);
      patch /= cv::norm(patch);
      std::vector<float> found(static_cast<std::size_t>(count));
      rowCorrelations(image.ptr(50) + 55, static_cast<std::ptrdiff_t>(image.step), side,
                      patch.ptr<float>(), count, found.data());
      keep(found, outputs);
    }
    return outputs;
  });
}

INSTANTIATE_TEST_SUITE_P(Halves, PatchKernels,
                         testing::Values(Half::kPortable, Half::kMachine, Half::kTwoRoundings),
                         test::nameOfHalf);

}  // namespace
}  // namespace mvo
