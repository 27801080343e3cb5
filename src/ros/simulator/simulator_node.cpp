// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// rosrun mvo simulator: a stereo or RGB-D camera in a scene whose every motion is known, live.
#include <ros/ros.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <string>
#include <vector>

#include "edges/run_tool.hpp"
#include "ros/simulator/frame_source.hpp"
#include "ros/simulator/simulated_sensor.hpp"
#include "ros/simulator/simulator_options.hpp"

namespace {

constexpr double kProgress = 5;  // s between messages
constexpr double kPoll = 0.02;   // s

constexpr char kHelp[] = R"(A camera in a simulated scene, live.

Publishes left/image_rect left/camera_info right/image_rect right/camera_info, or with
_sensor:=rgbd rgb/image_rect_color rgb/camera_info depth_registered/image_rect; the camera's mount
on the base in /tf_static; ~truth/odometry (of the base in odom, the first one is the identity) and
~truth/bodies (poses in odom, one per body).

Parameters, _name:=value:
  scene      blocks (default), spin, static, occlusion, cars, street, people, passing, twelve,
             corridor, slow
  sensor     stereo (default), rgbd
  seed       of textures, layout and motions (1)
  rate       frames per second (15, street: 10)
  width      of the images [px] (640, street: 1241)
  height     of the images [px] (480, street: 376)
  noise      of a pixel [grey levels] (1.5)
  gain       brightness of the right image relative to the left (1.02)
  blur       exposure time as a share of the frame period (0)
  frames     to publish (0: without end)
  prerender  frames to render first and then play to and fro, which leaves the processor to others
             (0: render as they are shown, the scene goes on for ever)
  wait       true: the first frame waits for a subscriber of every image (false)
  odom_frame (odom), base_frame (base_link)
  right_yaw right_pitch right_roll right_focal right_center_u right_center_v right_radial
  right_tangential right_delay readout exposure exposure_frame flicker flicker_hz defocus jpeg hood dots
             what sets the cameras apart from their calibration: see rosrun mvo simulate --help)";

void waitForSubscribers(const mvo_ros::SimulatedSensor& sensor) {
  const ros::WallTime begin = ros::WallTime::now();
  while (ros::ok() && !sensor.isWatched()) {
    ROS_INFO_STREAM_DELAYED_THROTTLE(kProgress, "waits for subscribers of its images since "
                                                    << (ros::WallTime::now() - begin).sec << " s");
    ros::WallDuration(kPoll).sleep();
  }
}

void run() {
  const ros::NodeHandle nh;
  const ros::NodeHandle pnh("~");
  XmlRpc::XmlRpcValue tree;
  ros::param::get(pnh.getNamespace(), tree);
  const mvo_ros::SimulatorOptions options = mvo_ros::simulatorOptions(tree);
  const auto scene =
      mvo::sim::makeScene(options.scene, static_cast<std::uint64_t>(options.seed), options.camera);
  mvo_ros::FrameSource frames(scene, options.prerender, [&](int done) {
    ROS_INFO_STREAM_THROTTLE(
        kProgress, "renders " << options.prerender << " frames first, " << done << " done");
    return ros::ok();
  });
  mvo_ros::SimulatedSensor sensor(options, mvo::sim::sequenceInfo(scene), nh, pnh);
  ros::AsyncSpinner spinner(1);
  spinner.start();
  if (options.wait) waitForSubscribers(sensor);
  ros::WallRate rate(options.camera.rate_hz);
  for (int k = 0; ros::ok() && (options.frames == 0 || k < options.frames);) {
    const mvo::SequenceFrame frame = frames.next();
    if (!rate.sleep())
      ROS_WARN_STREAM_THROTTLE(kProgress, "takes " << rate.cycleTime().toSec()
                                                   << " s per frame, rate is "
                                                   << options.camera.rate_hz
                                                   << " Hz: lower rate or size, or set prerender");
    sensor.publish(frame, ros::Time::now());
    if (options.frames > 0) ++k;
  }
}

}  // namespace

int main(int argc, char** argv) {
  return mvo::runTool("simulator", [&] {
    CLI::App app(kHelp);
    app.name("simulator");
    // Before ros::init, which needs a home to log to: help needs none.
    std::vector<std::string> words;
    ros::removeROSArgs(argc, argv, words);
    try {
      app.parse(std::vector<std::string>(words.rbegin(), words.rend() - 1));  // last first
    } catch (const CLI::ParseError& error) {
      return app.exit(error);
    }
    ros::init(argc, argv, "simulator");
    run();
    return EXIT_SUCCESS;
  });
}
