// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The live node, as a nodelet or alone: topics in, topics, TF, services and diagnostics out. One
// thread prepares a frame's images while another estimates the motions of the frame before.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <dynamic_reconfigure/server.h>
#include <mvo/GetMovingObjects.h>
#include <mvo/MvoConfig.h>
#include <mvo/SaveTrajectories.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "edges/frame_queue.hpp"
#include "edges/load_shedding.hpp"
#include "edges/mask_file.hpp"
#include "ros/live/camera_error_outputs.hpp"
#include "ros/live/health.hpp"
#include "ros/live/odometry_session.hpp"
#include "ros/live/publisher.hpp"
#include "ros/live/synchronized_input.hpp"
#include "ros/live/trajectory_log.hpp"

namespace mvo_ros {

class LiveNode {
 public:
  /// Subscribes and begins. Throws std::invalid_argument, one sentence, for parameters that are
  /// unknown, of the wrong type or out of range.
  LiveNode(Sensor sensor, const ros::NodeHandle& nh, const ros::NodeHandle& pnh);
  ~LiveNode();
  LiveNode(const LiveNode&) = delete;
  LiveNode& operator=(const LiveNode&) = delete;

 private:
  // What the callbacks ask of the worker.
  struct Requests {
    std::optional<std::string> reset;
    std::optional<Parameters> parameters;
  };

  void onSet(const InputSet& set);
  void onMask(const sensor_msgs::ImageConstPtr& image);
  void onSettings(mvo::MvoConfig& settings);
  void onTimer();
  bool onReset(std_srvs::Trigger::Response& response);
  bool onPause(bool pause, std_srvs::Trigger::Response& response);
  bool onSave(mvo::SaveTrajectories::Request& request, mvo::SaveTrajectories::Response& response);
  bool onMovingObjects(mvo::GetMovingObjects::Request& request,
                       mvo::GetMovingObjects::Response& response);

  void prepare(QueuePolicy policy);
  void work();
  void process(PreparedSet set);
  void refuse(const std::exception& error);
  void serveRequests();
  // Learns from how long a step took, and changes what is in force.
  void keepUp(const Step& step, double step_ms);
  // As many features and as much time as the load allows.
  mvo::Options underLoad() const;
  // Where the camera is on the robot; waits for it with queue all. Throws std::runtime_error naming
  // the transform that is missing.
  const Mount& mount(const std::string& camera_frame);
  void advertiseServices();

  ros::NodeHandle nh_;
  ros::NodeHandle pnh_;
  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_;
  Health health_;
  diagnostic_updater::Updater updater_;

  // The worker's own.
  SensorTopics topics_;
  Parameters working_;
  LoadShedding shedding_;
  double time_limit_ms_ = 0;  // of the shedding
  std::unique_ptr<OdometrySession> session_;
  std::unique_ptr<Publisher> publisher_;
  std::optional<Mount> mount_;
  std::unique_ptr<CameraErrorOutputs> camera_errors_;

  std::mutex mutex_;  // of the following
  Parameters parameters_;
  Requests requests_;
  bool paused_ = false;
  mvo::MotionArray motions_;
  std::optional<TrajectoryLog> log_;
  FramePeriod period_;
  std::optional<Mask> new_mask_;

  ros::WallTime last_warning_;
  std::unique_ptr<SetPreparation> preparation_;  // its thread's own
  std::unique_ptr<FrameQueue<InputSet>> queue_;
  FrameQueue<PreparedSet> prepared_{1};
  std::vector<ros::ServiceServer> services_;
  boost::recursive_mutex settings_mutex_;
  std::unique_ptr<dynamic_reconfigure::Server<mvo::MvoConfig>> settings_;
  ros::WallTimer timer_;
  std::unique_ptr<SynchronizedInput> input_;
  ros::Subscriber mask_input_;
  std::thread preparer_;
  std::thread worker_;
};

}  // namespace mvo_ros
