// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include <opencv2/imgproc.hpp>

#include "mvo/sim.hpp"
#include "sim/photometry.hpp"
#include "sim/truth.hpp"
#include "sim/view.hpp"

namespace mvo::sim {

RenderedFrame render(const Scene& scene, int frame) {
  const double time = scene.time(frame);
  const auto image = [&](const Eye& eye) {
    return develop(light(scene, time, eye), scene, frame, eye);
  };
  RenderedFrame out;
  out.frame = frame;
  out.stamp_ns = scene.stampNs(frame);
  out.T_world_camera = scene.T_world_camera(time);
  for (const Body& body : scene.bodies) out.T_world_bodies.push_back(body.T_world_body(time));
  addTruth(scene, time, out);
  const cv::Mat left = image(leftEye(scene));
  if (scene.options.rgbd) {
    out.color = left;
    cv::cvtColor(left, out.left, cv::COLOR_BGR2GRAY);
  } else {
    out.left = left;
    out.right = image(rightEye(scene));
  }
  return out;
}

Frame toFrame(const RenderedFrame& rendered) {
  Frame frame;
  frame.stamp_ns = rendered.stamp_ns;
  frame.left = rendered.left;
  frame.right = rendered.right;
  if (rendered.right.empty()) frame.depth = rendered.depth;
  return frame;
}

SequenceFrame toSequenceFrame(const RenderedFrame& rendered) {
  constexpr double kFarthest = 65.535;  // of 16-bit millimetres [m]; beyond is a hole
  SequenceFrame frame;
  frame.stamp_ns = rendered.stamp_ns;
  if (rendered.right.empty()) {
    frame.left = rendered.color;
    cv::Mat depth = rendered.depth.clone();
    cv::patchNaNs(depth, 0.0);
    depth.setTo(0, depth > kFarthest);
    depth.convertTo(frame.right, CV_16U, 1000.0);
  } else {
    frame.left = rendered.left;
    frame.right = rendered.right;
  }
  frame.T_world_camera = rendered.T_world_camera;
  for (std::size_t i = 0; i < rendered.T_world_bodies.size(); ++i) {
    frame.T_world_bodies[static_cast<int>(i) + 1] = rendered.T_world_bodies[i];
  }
  frame.mask = rendered.mask;
  frame.objects = rendered.objects;
  return frame;
}

SequenceInfo sequenceInfo(const Scene& scene) {
  return {scene.options.rgbd, scene.camera, scene.options.rate_hz};
}

}  // namespace mvo::sim
