// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/photometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace mvo::sim {
namespace {

// A scene of which only size, rate and imperfections matter here.
Scene sceneWith(const Imperfections& imperfections, double noise = 0) {
  Scene scene;
  scene.options.noise = noise;
  scene.options.gain = 0.5;
  scene.options.rate_hz = 15;
  scene.options.imperfections = imperfections;
  scene.camera.width = 64;
  scene.camera.height = 48;
  return scene;
}

cv::Mat grey(double level) { return cv::Mat(48, 64, CV_32FC1, cv::Scalar(level)); }

double levelOf(const Scene& scene, int frame) {
  return cv::mean(develop(grey(100), scene, frame, leftEye(scene)))[0];
}

TEST(Photometry, ExposureHasTheNoiseAndGainAskedFor) {
  const cv::Mat image(200, 300, CV_32FC1, cv::Scalar(100));
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(expose(image, 1.1, 3.0, 7), mean, deviation);
  EXPECT_NEAR(mean[0], 110, 0.05);
  EXPECT_NEAR(deviation[0], 3.0, 0.05);
  EXPECT_EQ(cv::norm(expose(image, 1.1, 3.0, 7), expose(image, 1.1, 3.0, 7), cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(expose(image, 1.1, 3.0, 7), expose(image, 1.1, 3.0, 8), cv::NORM_INF), 0);
  EXPECT_EQ(cv::countNonZero(expose(image, 3.0, 0, 7) != 255), 0);
}

TEST(Photometry, ExposureStepsAtItsFrame) {
  Imperfections imperfections;
  imperfections.exposure = 0.3;
  imperfections.exposure_frame = 7;
  const Scene scene = sceneWith(imperfections);
  EXPECT_EQ(levelOf(scene, 6), 100);
  EXPECT_EQ(levelOf(scene, 7), 30);
  EXPECT_EQ(levelOf(scene, 100), 30);
}

TEST(Photometry, FlickerSwingsAtItsFrequency) {
  Imperfections imperfections;
  imperfections.flicker = 0.2;
  imperfections.flicker_hz = 3.75;  // four frames per swing
  const Scene scene = sceneWith(imperfections);
  EXPECT_EQ(levelOf(scene, 0), 100);
  EXPECT_EQ(levelOf(scene, 1), 120);
  EXPECT_EQ(levelOf(scene, 2), 100);
  EXPECT_EQ(levelOf(scene, 3), 80);
}

TEST(Photometry, FlickerIsABandInARollingShutter) {
  Imperfections imperfections;
  imperfections.flicker = 0.2;
  imperfections.flicker_hz = 50;
  imperfections.readout = 0.02;  // one swing
  const Scene scene = sceneWith(imperfections);
  const cv::Mat image = develop(grey(100), scene, 0, leftEye(scene));
  double darkest = 0;
  double brightest = 0;
  cv::minMaxLoc(image.col(0), &darkest, &brightest);
  EXPECT_NEAR(darkest, 80, 1);
  EXPECT_NEAR(brightest, 120, 1);
  EXPECT_NEAR(image.at<std::uint8_t>(12, 0), 80, 1) << "a quarter before the middle";
  EXPECT_NEAR(image.at<std::uint8_t>(35, 0), 120, 1);
}

TEST(Photometry, OneEyeIsDarkerByItsGain) {
  const Scene scene = sceneWith({});
  EXPECT_EQ(cv::mean(develop(grey(100), scene, 0, leftEye(scene)))[0], 100);
  EXPECT_EQ(cv::mean(develop(grey(100), scene, 0, rightEye(scene)))[0], 50);
}

TEST(Photometry, DefocusSpreadsAPointAsANormalDistribution) {
  Imperfections imperfections;
  imperfections.defocus = 2;
  const Scene scene = sceneWith(imperfections);
  cv::Mat light = grey(0);
  light.at<float>(24, 32) = 5000;
  const cv::Mat image = develop(light, scene, 0, leftEye(scene));
  const double peak = 5000 / (2 * M_PI * 4);
  EXPECT_NEAR(image.at<std::uint8_t>(24, 32), peak, 2);
  EXPECT_NEAR(image.at<std::uint8_t>(24, 34), peak * std::exp(-0.5), 2);
  EXPECT_NEAR(image.at<std::uint8_t>(28, 32), peak * std::exp(-2), 2);
}

TEST(Photometry, NoiseIsNotBlurred) {
  Imperfections imperfections;
  imperfections.defocus = 2;
  const Scene scene = sceneWith(imperfections, 4);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(develop(grey(100), scene, 0, leftEye(scene)), mean, deviation);
  EXPECT_NEAR(deviation[0], 4, 0.2);
}

TEST(Photometry, LowerJpegQualityLosesMore) {
  const auto loss = [](int quality) {
    Imperfections imperfections;
    imperfections.jpeg = quality;
    cv::Mat light(48, 64, CV_32FC1);
    cv::theRNG().state = 5;
    cv::randu(light, 0, 255);
    cv::GaussianBlur(light, light, {}, 1);
    const Scene plain = sceneWith({});
    const Scene compressed = sceneWith(imperfections);
    return cv::norm(develop(light.clone(), compressed, 0, leftEye(compressed)),
                    develop(light.clone(), plain, 0, leftEye(plain)), cv::NORM_L1) /
           static_cast<double>(light.total());
  };
  EXPECT_EQ(loss(0), 0) << "not compressed";
  EXPECT_GT(loss(90), 0.1);
  EXPECT_GT(loss(30), 2 * loss(90));
  EXPECT_LT(loss(30), 15) << "still the same image";
}

}  // namespace
}  // namespace mvo::sim
