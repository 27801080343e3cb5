// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The pair's error as a user reads it.
#include "frontend/camera/error_report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "frontend/camera/learnt_errors.hpp"

namespace mvo {
namespace {

const StereoCamera kCamera{700, 700, 320, 240, 0.2, 640, 480};
constexpr double kRadians = 3.14159265358979323846 / 180;

// Known to `share` of the prior's deviations.
ErrorEstimate known(const ErrorVector& mean, double share = 0.01) {
  return {mean, share * share * expectedErrors(kCamera).covariance};
}

CameraErrorReport reportOf(ErrorTerm term, double value, double share = 0.01) {
  return errorReport(kCamera, known(value * ErrorVector::Unit(term), share));
}

void expectHas(const std::string& sentence, const std::vector<std::string>& words) {
  for (const std::string& word : words)
    EXPECT_NE(sentence.find(word), std::string::npos) << sentence << "\nlacks: " << word;
}

TEST(ErrorReport, ACameraThatLooksOutwardsSeesDisparitiesTooLarge) {
  // A camera turned about its y axis, down, looks to the right, and what it sees moves left.
  const auto report = reportOf(kTurn, -0.1 * kRadians);
  EXPECT_NEAR(report.yaw.value, 0.1, 1e-9);
  EXPECT_NEAR(report.pitch.value, 0, 1e-9);
  EXPECT_NEAR(report.roll.value, 0, 1e-9);
  EXPECT_NEAR(report.focal.value, 0, 1e-7);
  EXPECT_NEAR(report.disparity.value, 700 * 0.1 * kRadians, 1e-9);
  EXPECT_GT(report.disparity_rms.value, report.disparity.value);
  EXPECT_NEAR(report.rows.value, 0, 1e-9);
  EXPECT_NEAR(report.rest_rms.value, 0, 1e-5);
  EXPECT_TRUE(report.significant);
  expectHas(report.advice, {"the right camera looks 0.10° outwards of what its calibration says: "
                            "disparities are 1.22 ± 0.0",
                            " px too large; corrected; calibrate again"});
  EXPECT_EQ(report.advice.find("longer"), std::string::npos) << report.advice;
  expectHas(reportOf(kTurn, 0.1 * kRadians).advice, {"0.10° inwards", "too small"});
}

TEST(ErrorReport, ACameraThatLooksUpwardsSeesTheRowsLower) {
  const auto report = reportOf(kTilt, 0.1 * kRadians);
  EXPECT_NEAR(report.pitch.value, 0.1, 1e-9);
  EXPECT_NEAR(report.rows.value, 700 * 0.1 * kRadians, 1e-9);
  expectHas(report.advice, {"looks 0.10° upwards", "rows differ by 1.22 ± 0.0"});
  expectHas(reportOf(kTilt, -0.1 * kRadians).advice, {"0.10° downwards"});
}

TEST(ErrorReport, RollAndFocalLengthAreErrorsOfTheWholeImage) {
  // The camera rolls clockwise, from x to y, and the image the other way.
  const auto rolled = reportOf(kRoll, -0.2 * kRadians);
  EXPECT_NEAR(rolled.roll.value, 0.2, 1e-9);
  EXPECT_NEAR(rolled.disparity.value, 0, 1e-9);
  EXPECT_NEAR(rolled.disparity_rms.value, 0.2 * kRadians * 480 / std::sqrt(12), 0.01);
  EXPECT_NEAR(rolled.rows_rms.value, 0.2 * kRadians * 640 / std::sqrt(12), 0.01);
  expectHas(rolled.advice, {"the right camera is rolled by 0.20° clockwise: disparities are off by",
                            "px rms and rows differ by", "px rms; corrected"});
  const auto longer = reportOf(kScale, 0.004);
  EXPECT_NEAR(longer.focal.value, 0.4, 1e-9);
  expectHas(longer.advice, {"has a focal length 0.40 % longer: "});
}

TEST(ErrorReport, WhatNoMountingExplainsIsSaid) {
  // A principal point that is off looks like a turn in the middle, but not quite.
  const auto shifted = reportOf(kAcross, 0.002);
  EXPECT_NEAR(shifted.yaw.value, -0.002 / kRadians, 0.02);
  EXPECT_GT(shifted.rest_rms.value, 0.01);
  EXPECT_LT(shifted.rest_rms.value, 0.2 * shifted.disparity_rms.value);
  const auto radial = reportOf(kRadial, 0.02);
  EXPECT_GT(radial.rest_rms.value, 0.1);
  expectHas(radial.advice, {"differs in principal point or distortion by "});
}

TEST(ErrorReport, EyesThatAreNotTriggeredTogetherAreNoMatterOfCalibration) {
  const auto report = reportOf(kDelay, 3e-3);
  EXPECT_NEAR(report.delay.value, 3, 1e-9);
  EXPECT_EQ(report.advice,
            "the right camera sees 3.00 ± 0.05 ms later than the left; corrected; trigger both "
            "cameras together");
  expectHas(reportOf(kDelay, -3e-3).advice, {"earlier"});
  ErrorVector both = 3e-3 * ErrorVector::Unit(kDelay);
  both[kTurn] = -0.1 * kRadians;
  expectHas(errorReport(kCamera, known(both)).advice,
            {"looks 0.10° outwards of what its calibration says and sees 3.00 ± 0.05 ms later",
             "; corrected; calibrate again; trigger both"});
}

TEST(ErrorReport, NothingIsSaidOfWhatIsSmallOrUnknown) {
  for (const auto& report :
       {errorReport(kCamera, expectedErrors(kCamera)), reportOf(kTurn, 1e-4),
        reportOf(kTurn, 2e-3, 0.5), reportOf(kDelay, 9e-4), reportOf(kDelay, 3e-3, 0.5)}) {
    EXPECT_FALSE(report.significant) << report.advice;
    EXPECT_EQ(report.advice, "");
  }
}

TEST(ErrorReport, DeviationsAreThoseOfTheFigures) {
  // Against samples of the Gaussian.
  const auto report = errorReport(kCamera, known(ErrorVector::Zero(), 0.1));
  const Eigen::LLT<ErrorMatrix> factor(known(ErrorVector::Zero(), 0.1).covariance);
  double disparity = 0;
  double rest = 0;
  double yaw = 0;
  for (int i = 0; i < kErrorTerms; ++i) {  // sigma points: exact for sums of squares
    const ErrorVector mean = factor.matrixL() * ErrorVector::Unit(i);
    const auto at = errorReport(kCamera, known(mean));
    disparity += at.disparity_rms.value * at.disparity_rms.value;
    rest += at.rest_rms.value * at.rest_rms.value;
    yaw += at.yaw.value * at.yaw.value;
  }
  EXPECT_NEAR(report.disparity_rms.deviation, std::sqrt(disparity), 1e-6);
  EXPECT_NEAR(report.rest_rms.deviation, std::sqrt(rest), 1e-6);
  EXPECT_NEAR(report.yaw.deviation, std::sqrt(yaw), 1e-9);
}

TEST(LearntErrors, ComeBackAsTheyWere) {
  ErrorVector mean;
  for (int i = 0; i < kErrorTerms; ++i) mean[i] = 1e-4 * (i + 1);
  const ErrorEstimate estimate = known(mean);
  const LearntCameraErrors learnt = learntErrors(kCamera, estimate);
  EXPECT_EQ(learnt.terms.front(), "across");
  EXPECT_EQ(learnt.terms.back(), "delay");
  const ErrorEstimate back = estimateOf(learnt, kCamera);
  EXPECT_EQ(back.mean, mean);
  EXPECT_LT((back.covariance - estimate.covariance).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(LearntErrors, OfAnotherCameraAreRefused) {
  const auto complaint = [](const LearntCameraErrors& learnt) -> std::string {
    try {
      estimateOf(learnt, kCamera);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  const LearntCameraErrors good = learntErrors(kCamera, known(ErrorVector::Zero()));
  EXPECT_EQ(complaint(good), "");
  LearntCameraErrors other = good;
  other.camera.fu = 701;
  EXPECT_EQ(complaint(other),
            "the camera errors belong to another camera: its fx is 701, this camera's is 700");
  other = good;
  other.camera.width = 1280;
  expectHas(complaint(other), {"width is 1280", "640"});
  other = good;
  other.terms[3] = "squint";
  expectHas(complaint(other), {"'squint'", "'scale'"});
  other = good;
  other.terms.pop_back();
  expectHas(complaint(other), {"12 terms", "13"});
  other = good;
  other.covariance(0, 0) = -1;
  expectHas(complaint(other), {"not positive definite"});
  other = good;
  other.covariance(0, 1) = other.covariance(1, 0) = 1;
  expectHas(complaint(other), {"not positive definite"});
  other = good;
  other.mean[0] = std::nan("");
  expectHas(complaint(other), {"not finite"});
}

}  // namespace
}  // namespace mvo
