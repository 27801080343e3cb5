// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "live_node.hpp"

#include <tf2_eigen/tf2_eigen.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

#include <stdexcept>

#include "live_settings.hpp"
#include "moving_objects.hpp"

namespace mvo_ros {

namespace {

constexpr double kPatience = 5;           // s without a set before it is said, and between warnings
constexpr double kTimerPeriod = 1;        // s
constexpr double kTransformRetry = 0.05;  // s

Parameters parametersOf(const ros::NodeHandle& pnh) {
  XmlRpc::XmlRpcValue tree;
  ros::param::get(pnh.getNamespace(), tree);
  return readParameters(tree);
}

std::size_t queueLimit(const NodeOptions& options) {
  return options.queue == QueuePolicy::kAll ? static_cast<std::size_t>(options.queue_limit) : 1;
}

}  // namespace

LiveNode::LiveNode(Sensor sensor, const ros::NodeHandle& nh, const ros::NodeHandle& pnh)
    : nh_(nh),
      pnh_(pnh),
      tf_listener_(tf_buffer_),
      updater_(nh, pnh, pnh.getNamespace()),
      working_(parametersOf(pnh)),
      parameters_(working_) {
  ROS_INFO_STREAM(pnh_.getNamespace() << " runs with\n" << parametersText(working_));
  const NodeOptions& options = working_.node;
  log_.emplace(options.history);
  publisher_ = std::make_unique<Publisher>(pnh_, options);
  queue_ = std::make_unique<FrameQueue<InputSet>>(queueLimit(options));
  input_ = std::make_unique<SynchronizedInput>(sensor, options, nh_, pnh_,
                                               [this](const InputSet& set) { onSet(set); });
  SensorSetup setup;
  setup.sensor = sensor;
  setup.raw = options.rectify;
  setup.topics = topics_ = input_->topics();
  setup.virtual_baseline = working_.method.frontend.virtual_baseline;
  session_ = std::make_unique<OdometrySession>(setup, working_.method);

  // Live settings start from the parameters, not from what an earlier run left behind.
  const ros::NodeHandle live(pnh_, "live");
  ros::param::del(live.getNamespace());
  settings_ = std::make_unique<dynamic_reconfigure::Server<mvo::MvoConfig>>(settings_mutex_, live);
  settings_->updateConfig(liveSettings(parameters_));
  settings_->setCallback([this](mvo::MvoConfig& settings, std::uint32_t) { onSettings(settings); });

  advertiseServices();
  updater_.setHardwareID("none");
  updater_.add("multimotion odometry",
               [this](diagnostic_updater::DiagnosticStatusWrapper& s) { health_.report(s); });
  timer_ = nh_.createWallTimer(ros::WallDuration(kTimerPeriod),
                               [this](const ros::WallTimerEvent&) { onTimer(); });
  worker_ = std::thread([this] { work(); });
}

// Callbacks first, then the work under way; what both use goes last.
LiveNode::~LiveNode() {
  queue_->close();
  timer_.stop();
  input_.reset();
  services_.clear();
  settings_.reset();
  worker_.join();
}

void LiveNode::advertiseServices() {
  using Request = std_srvs::Trigger::Request;
  using Response = std_srvs::Trigger::Response;
  const auto trigger = [this](const std::string& name, auto call) {
    services_.push_back(pnh_.advertiseService(
        name, boost::function<bool(Request&, Response&)>(
                  [call](Request&, Response& response) { return call(response); })));
  };
  trigger("reset", [this](Response& response) { return onReset(response); });
  trigger("pause", [this](Response& response) { return onPause(true, response); });
  trigger("resume", [this](Response& response) { return onPause(false, response); });
  services_.push_back(pnh_.advertiseService("save_trajectories", &LiveNode::onSave, this));
  services_.push_back(
      pnh_.advertiseService("get_moving_objects", &LiveNode::onMovingObjects, this));
}

void LiveNode::onSet(const InputSet& set) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (paused_) return;
  }
  queue_->push(set);
}

void LiveNode::onSettings(mvo::MvoConfig& settings) {
  const std::lock_guard<std::mutex> lock(mutex_);
  try {
    parameters_ = withLiveSettings(parameters_, settings);
    requests_.parameters = parameters_;
  } catch (const std::invalid_argument& error) {
    ROS_ERROR_STREAM(pnh_.getNamespace() << ": refused: " << error.what());
    settings = liveSettings(parameters_);
  }
}

void LiveNode::onTimer() {
  const double silence = input_->silence();
  bool paused = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    paused = paused_;
  }
  const ros::WallTime now = ros::WallTime::now();
  if (silence > kPatience && !paused) {
    if ((now - last_warning_).toSec() >= kPatience) {
      const std::string report = input_->report();
      ROS_WARN_STREAM(pnh_.getNamespace() << ": " << report);
      health_.silent(report);
      last_warning_ = now;
    }
  } else {
    health_.silent("");
  }
  health_.dropped(queue_->dropped());
  updater_.force_update();
}

bool LiveNode::onReset(std_srvs::Trigger::Response& response) {
  const std::lock_guard<std::mutex> lock(mutex_);
  requests_.reset = "asked for by service";
  response.success = 1;
  response.message = "the next frame starts a new world";
  return true;
}

bool LiveNode::onPause(bool pause, std_srvs::Trigger::Response& response) {
  const std::lock_guard<std::mutex> lock(mutex_);
  response.success = paused_ != pause;
  response.message =
      std::string(paused_ == pause ? "already " : "") + (pause ? "paused" : "running");
  paused_ = pause;
  if (pause) queue_->clear();
  health_.paused(pause);
  return true;
}

bool LiveNode::onSave(mvo::SaveTrajectories::Request& request,
                      mvo::SaveTrajectories::Response& response) {
  try {
    TrajectoryLog log(0);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      log = *log_;
    }
    for (const std::string& file : log.save(request.folder))
      response.message += (response.message.empty() ? "" : ", ") + file;
    response.success = 1;
  } catch (const std::exception& error) {
    response.message = error.what();
    response.success = 0;
  }
  return true;
}

bool LiveNode::onMovingObjects(mvo::GetMovingObjects::Request& request,
                               mvo::GetMovingObjects::Response& response) {
  mvo::MotionArray motions;
  std::string odom_frame;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    motions = motions_;
    odom_frame = parameters_.node.odom_frame;
  }
  response.success = 0;
  response.header = motions.header;
  response.header.frame_id = odom_frame;
  if (motions.header.stamp.isZero()) {
    response.message = "there is no estimate yet";
    return true;
  }
  geometry_msgs::PointStamped center = request.center;
  const std::string& frame = center.header.frame_id;
  try {
    if (!frame.empty() && frame != odom_frame)
      tf2::doTransform(center, center,
                       tf_buffer_.lookupTransform(odom_frame, frame, center.header.stamp));
  } catch (const tf2::TransformException& error) {
    response.message = "no transform from " + frame + " to " + odom_frame + ": " + error.what();
    return true;
  }
  const Eigen::Vector3d p(center.point.x, center.point.y, center.point.z);
  if (!p.allFinite() || !(request.radius >= 0)) {
    response.message = "the point is not finite or the radius is negative";
    return true;
  }
  response.objects = movingObjects(motions, p, request.radius);
  response.success = 1;
  return true;
}

void LiveNode::work() {
  while (const auto set = queue_->pop()) {
    try {
      serveRequests();
      process(*set);
    } catch (const std::exception& error) {
      health_.refused(error.what());
      ROS_ERROR_STREAM_THROTTLE(kPatience, pnh_.getNamespace() << ": " << error.what());
    }
  }
}

void LiveNode::serveRequests() {
  Requests requests;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::swap(requests, requests_);
  }
  if (requests.reset) session_->reset(*requests.reset);
  if (!requests.parameters) return;
  session_->setOptions(requests.parameters->method);
  working_ = *requests.parameters;
}

const Mount& LiveNode::mount(const InputSet& set) {
  const NodeOptions& options = working_.node;
  const std::string& camera_frame = set.left->header.frame_id;
  if (camera_frame.empty())
    throw std::runtime_error("topic " + topics_.left + ": header.frame_id is empty");
  if (mount_ && mount_->camera_frame == camera_frame) return *mount_;
  if (options.base_frame.empty() || options.base_frame == camera_frame)
    return mount_.emplace(mountAlone(options.odom_frame, camera_frame));
  while (true) {
    try {
      const auto T = tf_buffer_.lookupTransform(options.base_frame, camera_frame, ros::Time(0));
      return mount_.emplace(
          mountOn(options.odom_frame, options.base_frame, camera_frame, tf2::transformToEigen(T)));
    } catch (const tf2::TransformException& error) {
      const std::string problem = "no transform from the camera's frame '" + camera_frame +
                                  "' to base_frame '" + options.base_frame + "': " + error.what();
      if (options.queue == QueuePolicy::kNewest || queue_->closed())
        throw std::runtime_error(problem);
      health_.blocked(problem);
      ROS_ERROR_STREAM_THROTTLE(kPatience, pnh_.getNamespace() << ": " << problem);
      ros::WallDuration(kTransformRetry).sleep();
    }
  }
}

void LiveNode::process(const InputSet& set) {
  const Mount& mounted = mount(set);
  const Step step = session_->add(set);
  if (!step.notice.empty()) ROS_WARN_STREAM(pnh_.getNamespace() << ": " << step.notice);
  if (!step.estimate.valid)
    ROS_WARN_STREAM_THROTTLE(kPatience, pnh_.getNamespace() << ": lost: " << step.estimate.problem);
  const mvo::MotionArray motions = publisher_->publish(step, mounted, working_);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    motions_ = motions;
    log_->add(step);
  }
  health_.step(step, (ros::Time::now() - step.stamp).toSec(),
               (ros::WallTime::now() - step.arrival).toSec());
}

}  // namespace mvo_ros
