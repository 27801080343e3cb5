// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/live/live_node.hpp"

#include <tf2_eigen/tf2_eigen.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

#include <opencv2/core/utility.hpp>
#include <stdexcept>
#include <utility>

#include "mvo/camera_error_files.hpp"
#include "ros/live/live_settings.hpp"
#include "ros/live/moving_objects.hpp"
#include "ros/sensor/image_conversion.hpp"

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

Mask maskOf(const NodeOptions& options) {
  if (options.mask.empty()) return {};
  try {
    return readMask(options.mask);
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(std::string("option mask: ") + error.what());
  }
}

void loadCameraErrors(const NodeOptions& options, Sensor sensor, SetPreparation& preparation) {
  if (options.camera_errors.empty()) return;
  const std::string source = "option camera_errors: " + options.camera_errors;
  if (sensor == Sensor::kRgbd) throw std::invalid_argument(source + ": there is no stereo pair");
  try {
    preparation.setCameraErrors(mvo::readCameraErrors(options.camera_errors), source);
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(std::string("option camera_errors: ") + error.what());
  }
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
  if (options.threads > 0) cv::setNumThreads(options.threads);
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
  preparation_ = std::make_unique<SetPreparation>(setup, working_.method);
  preparation_->setMask(maskOf(options));
  loadCameraErrors(options, sensor, *preparation_);
  camera_errors_ = std::make_unique<CameraErrorOutputs>(pnh_);
  mask_input_ = nh_.subscribe("mask", 1, &LiveNode::onMask, this);
  session_ = std::make_unique<OdometrySession>(topics_, working_.method);

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
  preparer_ = std::thread([this, policy = options.queue] { prepare(policy); });
  worker_ = std::thread([this] { work(); });
}

// Callbacks first, then the work under way; what both use goes last.
LiveNode::~LiveNode() {
  queue_->close();
  prepared_.close();
  timer_.stop();
  input_.reset();
  mask_input_.shutdown();
  services_.clear();
  camera_errors_->shutdown();
  settings_.reset();
  preparer_.join();
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
    period_.add(set.left->header.stamp.toSec(), ros::Time::now().toSec(), set.arrival.toSec());
  }
  queue_->push(set);
}

void LiveNode::onMask(const sensor_msgs::ImageConstPtr& image) {
  const std::string source = "topic " + nh_.resolveName("mask");
  try {
    const Mask mask{greyImage(*image).clone(), source};
    const std::lock_guard<std::mutex> lock(mutex_);
    new_mask_ = mask;
  } catch (const std::runtime_error& error) {
    ROS_ERROR_STREAM(pnh_.getNamespace() << ": " << source << ": " << error.what());
  }
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
  health_.dropped(queue_->dropped() + prepared_.dropped());
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
  if (pause) {
    queue_->clear();
    prepared_.clear();
  }
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

void LiveNode::refuse(const std::exception& error) {
  health_.refused(error.what());
  ROS_ERROR_STREAM_THROTTLE(kPatience, pnh_.getNamespace() << ": " << error.what());
}

// Of the frames prepared, too, the newest replaces the one that waits, or waits for its turn.
void LiveNode::prepare(QueuePolicy policy) {
  while (const auto set = queue_->pop()) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (new_mask_) preparation_->setMask(*std::exchange(new_mask_, std::nullopt));
    }
    try {
      PreparedSet prepared = preparation_->prepare(*set);
      if (policy == QueuePolicy::kNewest)
        prepared_.push(std::move(prepared));
      else
        prepared_.pushInTurn(std::move(prepared));
    } catch (const std::exception& error) {
      refuse(error);
    }
  }
}

void LiveNode::work() {
  while (auto set = prepared_.pop()) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (paused_) continue;
    }
    try {
      serveRequests();
      process(std::move(*set));
    } catch (const std::exception& error) {
      refuse(error);
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
  working_ = *requests.parameters;
  session_->setOptions(underLoad());
}

mvo::Options LiveNode::underLoad() const {
  mvo::Options options = working_.method;
  options.frontend.max_features = shedding_.features(options.frontend.max_features);
  double& budget = options.engine.time_budget_ms;
  if (time_limit_ms_ > 0) budget = budget > 0 ? std::min(budget, time_limit_ms_) : time_limit_ms_;
  return options;
}

void LiveNode::keepUp(const Step& step, double step_ms) {
  const NodeOptions& options = working_.node;
  const mvo::Options before = underLoad();
  std::optional<double> period;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    period = period_.seconds();
  }
  if (!options.realtime || options.queue != QueuePolicy::kNewest) {
    shedding_.reset();
    time_limit_ms_ = 0;
  } else if (period) {
    shedding_.step(step_ms, 1e3 * *period, working_.method.frontend.max_features);
    time_limit_ms_ = shedding_.budget(1e3 * *period, step.before_ms);
  }
  const mvo::Options after = underLoad();
  if (after.frontend.max_features != before.frontend.max_features ||
      after.engine.time_budget_ms != before.engine.time_budget_ms)
    session_->setOptions(after);
  health_.load(after.frontend.max_features, working_.method.frontend.max_features, time_limit_ms_);
}

const Mount& LiveNode::mount(const std::string& camera_frame) {
  const NodeOptions& options = working_.node;
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

void LiveNode::process(PreparedSet set) {
  const Mount& mounted = mount(set.set.left->header.frame_id);
  const Step step = session_->add(std::move(set));
  const ros::WallTime estimated = ros::WallTime::now();
  if (!step.notice.empty()) ROS_WARN_STREAM(pnh_.getNamespace() << ": " << step.notice);
  if (!step.estimate.valid)
    ROS_WARN_STREAM_THROTTLE(kPatience, pnh_.getNamespace() << ": lost: " << step.estimate.problem);
  const mvo::MotionArray motions = publisher_->publish(step, mounted, working_);
  camera_errors_->step(step);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    motions_ = motions;
    log_->add(step);
  }
  const ros::WallTime now = ros::WallTime::now();
  health_.step(step, (ros::Time::now() - step.stamp).toSec(), (now - step.arrival).toSec());
  keepUp(step, step.total_ms + 1e3 * (now - estimated).toSec());
}

}  // namespace mvo_ros
