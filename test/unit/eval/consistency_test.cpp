// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Covariances that are true, too small and too large; whose samples count.
#include "eval/consistency.hpp"

#include <gtest/gtest.h>

#include <random>

#include "mvo/se3.hpp"

namespace mvo {
namespace {

constexpr std::size_t kFrames = 400;
constexpr std::int64_t kPeriod = 100;

std::int64_t stampOf(std::size_t frame) { return static_cast<std::int64_t>(frame) * kPeriod; }

FrameClock clockOf() {
  std::vector<std::int64_t> stamps;
  for (std::size_t k = 0; k < kFrames; ++k) stamps.push_back(stampOf(k));
  return FrameClock(std::move(stamps));
}

FramePoses truePoses() {
  Vector6d twist;
  twist << 0.01, -0.02, 0.03, 0.004, 0.005, -0.006;
  FramePoses poses;
  for (std::size_t k = 0; k < kFrames; ++k) poses.emplace_back(exp(static_cast<double>(k) * twist));
  return poses;
}

// Steps, and windows of `length` frames, with errors drawn from a covariance.
std::vector<MotionCovariance> drawn(std::size_t length, const Matrix6d& covariance) {
  const FramePoses truth = truePoses();
  const Matrix6d L = covariance.llt().matrixL();
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  std::vector<MotionCovariance> rows;
  const auto add = [&](MotionSpan span, std::size_t a, std::size_t b) {
    Vector6d n;
    for (double& x : n) x = normal(generator);
    rows.push_back({stampOf(b), 3, span, stampOf(a), exp(L * n) * *truth[b] * truth[a]->inverse(),
                    covariance});
  };
  for (std::size_t k = 1; k < kFrames; ++k) {
    add(MotionSpan::kStep, k - 1, k);
    add(MotionSpan::kWindow, k < length ? 0 : k - length + 1, k);
  }
  return rows;
}

Matrix6d someCovariance() {
  Vector6d d;
  d << 1, 2, 3, 0.1, 0.2, 0.3;
  const Vector6d c = Vector6d::Constant(0.2);
  return 1e-6 * (Matrix6d(d.asDiagonal()) + c * c.transpose());
}

TEST(Consistency, IsOneForTrueCovariances) {
  const Consistency c = consistencyOf(clockOf(), drawn(11, someCovariance()), {1, 3}, truePoses());
  EXPECT_EQ(c.step.samples, static_cast<int>(kFrames) - 1);
  EXPECT_EQ(c.window.samples, 40);  // 399 = 39 of ten steps each, and the rest at the beginning
  for (const Nees& nees : {c.step, c.window}) {
    EXPECT_GT(nees.mean, nees.low);
    EXPECT_LT(nees.mean, nees.high);
  }
  EXPECT_LE(c.step.beyond, 12);  // 4 of 399 are expected
  EXPECT_TRUE(c.all.empty());
}

TEST(Consistency, BandsAreThoseOfChiSquares) {
  std::vector<MotionCovariance> rows = drawn(11, someCovariance());
  rows.resize(40);  // twenty steps
  const Consistency c = consistencyOf(clockOf(), rows, {3}, truePoses());
  EXPECT_EQ(c.step.samples, 20);
  EXPECT_NEAR(c.step.low, 0.76, 0.005);
  EXPECT_NEAR(c.step.high, 1.27, 0.005);
}

TEST(Consistency, ShowsCovariancesThatAreTooSmallOrTooLarge) {
  for (const double factor : {0.25, 4.0}) {
    std::vector<MotionCovariance> rows = drawn(11, someCovariance());
    for (MotionCovariance& row : rows) row.covariance *= factor;
    const Consistency c = consistencyOf(clockOf(), rows, {3}, truePoses());
    EXPECT_NEAR(c.step.mean * factor, 1, 0.1);
    EXPECT_EQ(c.step.mean > c.step.high, factor < 1);
    EXPECT_EQ(c.step.mean<c.step.low, factor> 1);
  }
}

TEST(Consistency, CountsOnlyWhatIsAskedForAndKnown) {
  const auto rows = drawn(11, someCovariance());
  EXPECT_EQ(consistencyOf(clockOf(), rows, {1}, truePoses()).step.samples, 0);
  FramePoses truth = truePoses();
  truth[20].reset();
  EXPECT_EQ(consistencyOf(clockOf(), rows, {3}, truth).step.samples, static_cast<int>(kFrames) - 3);
  MotionCovariance all = rows.back();
  all.span = MotionSpan::kAll;
  const auto since_first = consistencyOf(clockOf(), {all}, {3}, truePoses()).all;
  ASSERT_EQ(since_first.size(), 1U);
  EXPECT_EQ(since_first[0].frame, kFrames - 1);
}

}  // namespace
}  // namespace mvo
