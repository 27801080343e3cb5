// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The time to rectify a raw stereo pair.
#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>
#include <utility>

#include "ros/sensor/camera_info_message.hpp"
#include "ros/sensor/rectification.hpp"

namespace mvo_ros {
namespace {

void rectify(benchmark::State& state) {
  const int width = static_cast<int>(state.range(0));
  const int height = static_cast<int>(state.range(1));
  cv::setNumThreads(static_cast<int>(state.range(2)));
  const double focal_length = 0.8 * width;
  const mvo::StereoCamera camera{focal_length, focal_length, 0.5 * width, 0.5 * height,
                                 0.24,         width,        height};
  sensor_msgs::CameraInfo info = cameraInfo({}, camera, 0);
  info.distortion_model = "plumb_bob";
  info.D = {-0.28, 0.07, 0.0002, -0.0001, 0};
  const Rectification rectification(info, "left/camera_info");
  cv::Mat raw(height, width, CV_8UC1);
  cv::randu(raw, 0, 255);
  for (auto _ : state)
    for (int eye = 0; eye < 2; ++eye) benchmark::DoNotOptimize(rectification.grey(raw));
}

void cases(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"width", "height", "threads"});
  benchmark->Unit(benchmark::kMillisecond)->UseRealTime();
  for (const int threads : {1, 2})
    for (const auto& [width, height] : {std::pair{640, 480}, {1241, 376}, {1280, 960}})
      benchmark->Args({width, height, threads});
}

BENCHMARK(rectify)->Apply(cases);

}  // namespace
}  // namespace mvo_ros
