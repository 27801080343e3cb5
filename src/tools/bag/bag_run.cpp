// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bag/bag_run.hpp"

#include <Eigen/Core>
#include <chrono>
#include <fstream>
#include <opencv2/core/utility.hpp>
#include <opencv2/core/version.hpp>
#include <stdexcept>

#include "edges/mask_file.hpp"
#include "mvo/camera_error_files.hpp"
#include "mvo/odometry.hpp"
#include "statistics.hpp"
#include "tools/bag/camera_errors_summary.hpp"
#include "tools/bag/overlay_output.hpp"
#include "tools/bag/run_writer.hpp"
#include "tools/progress.hpp"
#include "tools/staged_output.hpp"
#include "tools/yardstick.hpp"

namespace mvo_tools {

namespace {

constexpr char kSummary[] = "summary.json";
constexpr std::size_t kYardstickPairs = 3;
constexpr std::size_t kYardstickEvery = 5;  // frames

nlohmann::ordered_json versions() {
  const auto eigen = std::to_string(EIGEN_WORLD_VERSION) + "." +
                     std::to_string(EIGEN_MAJOR_VERSION) + "." +
                     std::to_string(EIGEN_MINOR_VERSION);
  return {
      {"mvo", MVO_VERSION}, {"opencv", CV_VERSION}, {"ceres", MVO_CERES_VERSION}, {"eigen", eigen}};
}

nlohmann::ordered_json optionsInForce(mvo::Options options) {
  nlohmann::ordered_json out;
  for (const mvo::OptionEntry& entry : mvo::optionTable(options)) out[entry.name] = entry.get();
  return out;
}

// Step times in units of Y. The step is wall time; Y and the CPU step are CPU time.
class Yardstick {
 public:
  // Frames far enough apart to be different, near enough to be in every bag.
  void add(const mvo::Frame& frame, double cpu_step_ms) {
    if (cpu_steps_ms_.size() % kYardstickEvery == 0 && pairs_.size() < kYardstickPairs) {
      if (!frame.right.empty())
        pairs_.emplace_back(frame.left, frame.right);
      else if (!last_left_.empty())
        pairs_.emplace_back(last_left_, frame.left);
    }
    last_left_ = frame.left;
    cpu_steps_ms_.push_back(cpu_step_ms);
  }

  nlohmann::ordered_json report(double median_step_ms) const {
    const double y = yardstickMilliseconds(pairs_);
    const double cpu_step = mvo::quantile(cpu_steps_ms_, 0.5);
    nlohmann::ordered_json out = {{"Y_ms", y}, {"median_cpu_step_ms", cpu_step}};
    if (y > 0) {
      out["median_step_over_Y"] = median_step_ms / y;
      out["median_cpu_step_over_Y"] = cpu_step / y;
    }
    return out;
  }

 private:
  std::vector<std::pair<cv::Mat, cv::Mat>> pairs_;
  cv::Mat last_left_;
  std::vector<double> cpu_steps_ms_;
};

// Says why frames have no estimate, but not for each of a hundred in a row.
class Warnings {
 public:
  void add(const mvo::MultimotionEstimate& estimate, Progress& progress) {
    const auto now = std::chrono::steady_clock::now();
    if (estimate.valid || (said_ && now - *said_ < std::chrono::seconds(5))) return;
    progress.message("bag: no estimate in frame " + std::to_string(estimate.frame) + ": " +
                     estimate.problem);
    said_ = now;
  }

 private:
  std::optional<std::chrono::steady_clock::time_point> said_;
};

void requireEstimates(const BagCommand& command, const mvo_ros::BagFrames& bag,
                      const RunWriter& writer) {
  if (writer.frames() == 0 && bag.unpaired() > 0)
    throw std::runtime_error(command.input + ": none of " + std::to_string(bag.unpaired()) +
                             " images has a partner within --sync-tolerance " +
                             std::to_string(command.request.sync_tolerance) + " s");
  if (writer.frames() == 0)
    throw std::runtime_error(command.input + ": no images " +
                             std::to_string(command.request.start) +
                             " s (--start) after the first");
  // The first frame's pose is the origin by definition and estimates nothing.
  if (writer.estimated() == 0 || (writer.frames() > 1 && writer.estimatedAfterFirst() == 0))
    throw std::runtime_error(command.input + ": no estimate in any of " +
                             std::to_string(writer.frames()) +
                             " frames (last: " + writer.lastProblem() + ")");
}

mvo_ros::Mask maskOf(const BagCommand& command, const mvo::StereoCamera& camera) {
  if (command.mask.empty()) return {};
  mvo_ros::Mask mask = mvo_ros::readMask(command.mask);
  mvo_ros::requireSize(mask, {camera.width, camera.height});
  return mask;
}

void startFrom(const std::string& file, mvo::MultimotionOdometry& odometry) {
  if (file.empty()) return;
  try {
    odometry.setCameraErrors(mvo::readCameraErrors(file));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
}

// A file is replaced with --force, or if it is the one that the run started from. Known before the
// work: the folder must be there, or be the output's.
void requireWritable(const BagCommand& command) {
  namespace fs = std::filesystem;
  const fs::path file = command.save_camera_errors;
  if (file.empty()) return;
  if (fs::exists(file) && !command.force && file != command.camera_errors)
    throw std::runtime_error(file.string() + " exists, --force replaces it");
  const fs::path folder = fs::absolute(file).lexically_normal().parent_path();
  const fs::path output = fs::absolute(command.output + "/").lexically_normal().parent_path();
  if (!fs::is_directory(folder) && folder != output)
    throw std::runtime_error("option --save-camera-errors is '" + file.string() + "', but " +
                             folder.string() + " is no folder");
}

void writeSummary(const std::filesystem::path& path, const nlohmann::ordered_json& summary) {
  mvo::AtomicFile file(path);
  file.stream() << summary.dump(2) << '\n';
  file.commit();
}

}  // namespace

void runBag(const BagCommand& command, const std::function<bool()>& interrupted) {
  if (command.threads > 0) cv::setNumThreads(command.threads);
  mvo_ros::BagFrames bag(command.input, command.request);
  const mvo_ros::Mask mask = maskOf(command, bag.camera());
  mvo::MultimotionOdometry odometry(bag.camera(), command.options);
  startFrom(command.camera_errors, odometry);
  requireWritable(command);
  StagedOutput output(command.output, StagedOutput::Kind::kFolder, command.force, kSummary);
  RunWriter writer(output.path(),
                   command.smoothed ? RunWriter::Poses::kSmoothed : RunWriter::Poses::kCausal);
  OverlayOutput overlay({command.overlay, command.overlay_frames, command.force}, output,
                        {bag.camera().width, bag.camera().height}, bag.rate());
  Progress progress(std::filesystem::path(command.input).filename(), "frames", bag.size(),
                    command.quiet);
  Yardstick yardstick;
  Warnings warnings;
  while (auto next = bag.next()) {
    if (interrupted()) throw std::runtime_error("interrupted, nothing is written");
    next->frame.mask = mask.image;
    const double cpu_start = cpuMilliseconds();
    const auto start = std::chrono::steady_clock::now();
    const mvo::MultimotionEstimate estimate = odometry.addFrame(next->frame);
    const std::chrono::duration<double, std::milli> step = std::chrono::steady_clock::now() - start;
    yardstick.add(next->frame, cpuMilliseconds() - cpu_start);
    writer.add(estimate, {{"decode", next->decode_ms}, {"rectify", next->rectify_ms}},
               step.count() + next->rectify_ms);
    overlay.add(next->frame.left, estimate);
    warnings.add(estimate, progress);
    progress.update(bag.position());
  }
  requireEstimates(command, bag, writer);

  nlohmann::ordered_json summary = writer.summary();
  summary["unpaired_images"] = bag.unpaired();
  if (command.yardstick)
    summary["yardstick"] = yardstick.report(summary["step_ms"]["median"].get<double>());
  const auto camera_errors = odometry.cameraErrors();
  if (camera_errors) summary["camera_errors"] = cameraErrorsSummary(*camera_errors);
  summary["input"] = std::filesystem::path(command.input).filename();
  summary["poses"] = command.smoothed ? "smoothed" : "causal";
  summary["profile"] = command.profile;
  summary["threads"] = cv::getNumThreads();
  summary["versions"] = versions();
  summary["options"] = optionsInForce(command.options);
  writer.finish();
  writeSummary(output.path() / kSummary, summary);
  overlay.commit();
  output.commit();
  if (camera_errors && !command.save_camera_errors.empty())
    mvo::writeCameraErrors(command.save_camera_errors, camera_errors->learnt);
  if (camera_errors && camera_errors->significant && !command.quiet) {
    progress.message("bag: " + camera_errors->advice);
    progress.update(bag.position());  // the message stands above the bar
  }
}

}  // namespace mvo_tools
