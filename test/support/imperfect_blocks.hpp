// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The blocks as imperfect cameras see them, without noise, beside what the exact pair sees.
#pragma once

#include <opencv2/imgproc.hpp>

#include "mvo/sim.hpp"

namespace mvo::test {

inline constexpr int kFrame = 12;

inline bool identical(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

inline sim::Scene blocksWith(const sim::Imperfections& imperfections) {
  sim::SceneOptions options;
  options.noise = 0;
  options.gain = 1;
  options.imperfections = imperfections;
  return sim::makeScene("blocks", 2, options);
}

inline const sim::RenderedFrame& exactFrame() {
  static const sim::RenderedFrame frame = sim::render(blocksWith({}), kFrame);
  return frame;
}

/// The scene as it is `dt` seconds later.
inline sim::Scene later(sim::Scene scene, double dt) {
  const auto shifted = [dt](const sim::Motion& motion) {
    return [=](double t) { return motion(t + dt); };
  };
  scene.T_world_camera = shifted(scene.T_world_camera);
  for (sim::Body& body : scene.bodies) body.T_world_body = shifted(body.T_world_body);
  return scene;
}

/// Without what sampling adds to the finest structures, and without the patch's brightness.
inline cv::Mat smoothed(const cv::Mat& image, const cv::Rect& patch) {
  cv::Mat smooth;
  image.convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, {}, 3);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(smooth(patch), mean, deviation);
  return (smooth - mean[0]) / deviation[0];
}

/// How far a patch of an image has moved in another one [px], by least squares on its gradients.
inline Eigen::Vector2d shiftOf(const cv::Mat& from, const cv::Mat& to, const cv::Rect& patch) {
  const cv::Mat a = smoothed(from, patch);
  const cv::Mat b = smoothed(to, patch);
  // The mean of both images' gradients leaves no error of second order.
  const cv::Mat sum = a + b;
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
  Eigen::Vector2d y = Eigen::Vector2d::Zero();
  for (int v = patch.y; v < patch.br().y; ++v) {
    for (int u = patch.x; u < patch.br().x; ++u) {
      const Eigen::Vector2d gradient((sum.at<float>(v, u + 1) - sum.at<float>(v, u - 1)) / 4,
                                     (sum.at<float>(v + 1, u) - sum.at<float>(v - 1, u)) / 4);
      A += gradient * gradient.transpose();
      y += gradient * (a.at<float>(v, u) - b.at<float>(v, u));
    }
  }
  return A.ldlt().solve(y);
}

/// What an imperfection does to a patch of the right image, around a pixel.
inline Eigen::Vector2d shiftAround(const sim::Imperfections& imperfections, const cv::Point& middle,
                                   int half = 60) {
  const sim::RenderedFrame frame = sim::render(blocksWith(imperfections), kFrame);
  return shiftOf(exactFrame().right, frame.right,
                 {middle.x - half, middle.y - half, 2 * half, 2 * half});
}

}  // namespace mvo::test
