// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The library without ROS: images in, the motion of the camera and of every body out. The images
// come from the simulator; fill a Frame from cv::imread or a camera instead.
#include <iostream>

#include "mvo/odometry.hpp"
#include "mvo/sim.hpp"

int main() {
  const mvo::sim::Scene scene = mvo::sim::makeScene("blocks", 1);
  mvo::MultimotionOdometry odometry(scene.camera, mvo::Options());
  mvo::MultimotionEstimate estimate;
  for (int k = 0; k < 12; ++k)
    estimate = odometry.addFrame(mvo::sim::toFrame(mvo::sim::render(scene, k)));

  for (const mvo::MotionEstimate& motion : estimate.motions) {
    std::cout << (motion.id == mvo::kStatic ? "camera" : "motion " + std::to_string(motion.id))
              << " is at " << motion.T_world_motion.translation().transpose() << " m, seen in "
              << motion.visible << " tracklets\n";
  }
  return estimate.valid ? 0 : 1;
}
