// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Your own tracklets: any sensor that follows points in 3-D can fill a window. Here a range sensor
// is invented that drives past a wall while a box slides by; the engine finds both motions.
#include <cstdlib>
#include <iostream>
#include <mvo/segment_motions.hpp>
#include <random>
#include <vector>

namespace {

constexpr int kFrames = 12;
constexpr double kNoise = 0.1;  // of the measurements [px]

// The engine takes stereo measurements. A sensor of points becomes a stereo pair of the resolution
// that fits its noise; only the ratio of noise to focal length counts.
const mvo::StereoCamera kSensor{500, 500, 320, 240, 0.2, 640, 480};

struct Cloud {
  std::vector<Eigen::Vector3d> points;  // in the world when the sensor starts [m]
  Eigen::Vector3d step;                 // per frame [m]
};

Cloud makeCloud(const Eigen::Vector3d& centre, const Eigen::Vector3d& size, int points,
                const Eigen::Vector3d& step, std::mt19937& random) {
  std::uniform_real_distribution<double> anywhere(-0.5, 0.5);
  Cloud cloud{{}, step};
  for (int i = 0; i < points; ++i) {
    const Eigen::Vector3d offset(anywhere(random), anywhere(random), anywhere(random));
    cloud.points.emplace_back(centre + size.cwiseProduct(offset));
  }
  return cloud;
}

}  // namespace

int main() {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, kNoise);
  const Eigen::Vector3d sensor_step(0.01, 0, 0.03);
  const std::vector<Cloud> clouds{
      makeCloud({0, 0, 6}, {6, 4, 3}, 120, Eigen::Vector3d::Zero(), random),
      makeCloud({0.5, 0.3, 3}, {0.8, 0.8, 0.5}, 40, {-0.04, 0, 0.01}, random)};

  mvo::Window window;
  window.last_frame = kFrames - 1;
  for (const Cloud& cloud : clouds)
    for (const Eigen::Vector3d& start : cloud.points) {
      mvo::Tracklet tracklet;
      tracklet.id = static_cast<mvo::TrackletId>(window.tracklets.size());
      for (int k = 0; k < kFrames; ++k) {
        mvo::Observation observation;
        observation.frame = k;
        observation.y = kSensor.project(start + k * (cloud.step - sensor_step));
        for (int i = 0; i < 3; ++i) observation.y(i) += noise(random);
        tracklet.observations.push_back(observation);
      }
      window.tracklets.push_back(tracklet);
    }

  const mvo::Segmentation found = mvo::segmentMotions(window, kSensor, {}, mvo::Options());
  std::vector<int> right(clouds.size(), 0);
  for (std::size_t l = 0; l < found.labeling.labels.size(); ++l) {
    const auto& estimate = found.estimates[l];
    if (!estimate) continue;
    const Eigen::Vector3d moved =
        estimate->trajectory.between(0, kFrames - 1)->translation() / (kFrames - 1);
    std::cout << "motion " << l << ": " << found.labeling.support(static_cast<int>(l)).size()
              << " tracklets, the sensor moves by (" << moved.transpose()
              << ") m per frame before them\n";
    for (std::size_t c = 0; c < clouds.size(); ++c)
      if ((moved - (sensor_step - clouds[c].step)).norm() < 0.002) ++right[c];
  }
  for (const int count : right)
    if (count != 1) {
      std::cerr << "the motions are not those of the wall and the box\n";
      return EXIT_FAILURE;
    }
  return EXIT_SUCCESS;
}
