// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Every constant of the method: one struct per stage, its default in place, and one table that
// gives each its name, unit, range and meaning. Profiles: the default (measured to be best) and the
// paper's own constants.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace mvo {

enum class Tracker { kKlt, kDescriptor };
enum class Shutter { kAuto, kGlobal, kRolling };
enum class CameraErrorMode { kAuto, kOff };
enum class Solver { kAlphaExpansion, kCoral };
enum class Engine { kMultimotion, kSequentialRansac };
enum class BatchBackend { kCeres, kSchur };
enum class DampingMethod { kLevenbergMarquardt, kGaussNewton };
enum class Ranking { kMsac, kCount };
enum class ResidualModel { kWhitened, kImageDistance };
enum class WorldRule { kEvidence, kSupport };

struct WindowOptions {
  int frames = 48;  ///< K
  int max_gap = 1;  ///< frames a tracklet may miss and still go on
};

struct FrontendOptions {
  Tracker tracker = Tracker::kKlt;
  int max_features = 700;  ///< tracklets alive at once
  double spacing = 16;     ///< least distance of new points at 640x480, scales with the image [px]
  /// Smallest eigenvalue of a patch's gradient matrix, RMS [grey levels]; in dim images less, down
  /// to a quarter.
  double min_contrast = 2;
  int patch = 13;                     ///< side of a KLT patch [px]
  int pyramid_levels = 3;             ///< levels above the image itself
  double max_forward_backward = 0.5;  ///< [px]
  double max_epipolar = 1.0;          ///< |v_l - v_r| of a stereo match [px]
  double max_circle = 1.0;            ///< left-right-time closure of the circle [px]
  /// KLT: points that a texture which repeats itself may have moved by a period are looked at again
  /// once the others are found, and dropped if that does not settle it.
  bool second_look = true;
  double min_disparity = 0.3;      ///< [px]
  double max_disparity = 0.4;      ///< share of the image width
  double virtual_baseline = 0.05;  ///< of the virtual right camera for RGB-D [m]
  double min_depth = 0.2;          ///< RGB-D [m]
  double max_depth = 10.0;         ///< RGB-D [m]
  Shutter shutter = Shutter::kAuto;
  double readout = 0.033;  ///< first to last row of a rolling shutter, if it is known [s]
};

struct CameraOptions {
  /// The pair's own error is found out while frames go by and corrected, or the calibration is
  /// taken to be exact.
  CameraErrorMode errors = CameraErrorMode::kAuto;
};

struct NoiseOptions {
  double left = 0.10;       ///< standard deviation of u_l and v [px]
  double disparity = 0.12;  ///< standard deviation of u_l - u_r [px]
};

struct GraphOptions {
  int neighbors = 5;  ///< k
};

struct ProposalOptions {
  int iterations = 1000;   ///< RANSAC iterations per frame pair, at most
  double threshold = 1.0;  ///< e_th of a frame-to-frame link [px]
  Ranking ranking = Ranking::kMsac;
  double confidence =
      0.999;  ///< RANSAC stops early at this probability of having seen a clean sample; 1 = never
  bool warm_start = true;  ///< labels that explain their support are kept, not proposed anew
  bool refine = true;      ///< refine on the inliers by reprojection
  int min_support = 6;     ///< tracklets in a component that proposes a label
};

struct EnergyOptions {
  ResidualModel residual = ResidualModel::kWhitened;
  bool adaptive = true;  ///< scale thresholds and costs with the measured residuals
  double typical_residual =
      0.35;                   ///< median rho of the static world up to which nothing is scaled [px]
  bool long_pairs = true;     ///< test pairs k-d .. k with d > 1 too
  double dead_zone = 0.6;     ///< residual that costs nothing [px]
  double threshold = 1.9;     ///< e_th of III-E and cost of a pair without a transform [px]
  double smoothness = 0.3;    ///< lambda
  double label_cost = 30;     ///< gamma
  double outlier_scale = 10;  ///< alpha
  double outlier_decay = 0.85;  ///< beta [px]
};

struct EngineOptions {
  Engine engine = Engine::kMultimotion;
  Solver solver = Solver::kAlphaExpansion;
  int max_rounds = 4;
  double time_budget_ms = 0;  ///< of a step from its prepared images on; 0 = no limit
  int min_tracklets = 10;     ///< III-E
  int min_frames = 3;         ///< III-E
};

struct CoralOptions {
  int max_iterations = 2000;
  double tolerance = 1e-4;  ///< gap to the lower bound that ends the iteration, relative
};

struct BundleAdjustmentOptions {
  BatchBackend backend = BatchBackend::kSchur;
  DampingMethod damping = DampingMethod::kLevenbergMarquardt;
  int max_iterations = 5;            ///< of a cold start
  int warm_iterations = 1;           ///< when poses and landmarks come from the last window
  double robust_scale = 0.5;         ///< Cauchy's width in standard deviations; 0 = plain squares
  double function_tolerance = 1e-4;  ///< relative change of the cost that ends the iteration
  int min_observations = 5;          ///< of a label in a frame, for a pose to exist
};

struct TrajectoryOptions {
  WorldRule static_world = WorldRule::kEvidence;
  /// How many times more support a label needs to take over as the static world by kSupport.
  double static_hysteresis = 1.5;
  double max_acceleration = 20;           ///< of the camera; 0 = any motion is believed [m/s^2]
  double max_angular_acceleration = 100;  ///< of the camera [rad/s^2]
  double extrapolation = 0.5;  ///< a lost camera is taken to keep its twist for so long [s]
};

struct Options {
  std::uint64_t seed = 1;
  WindowOptions window;
  FrontendOptions frontend;
  CameraOptions camera;
  NoiseOptions noise;
  GraphOptions graph;
  ProposalOptions proposal;
  EnergyOptions energy;
  EngineOptions engine;
  CoralOptions coral;
  BundleAdjustmentOptions bundle_adjustment;
  TrajectoryOptions trajectory;

  /// Throws std::invalid_argument: one sentence with the option's name, value and range.
  void validate() const;
};

/// The constants of the paper's section IV.
Options paperOptions();
/// "default" or "paper"; throws std::invalid_argument that lists the profiles.
Options optionsOfProfile(const std::string& profile);

/// One row of the option table. Names are "<stage>.<field>".
struct OptionEntry {
  std::string name;
  std::string unit;   ///< empty for pure numbers and choices
  std::string range;  ///< as printed: "[3, 500]" or "klt | descriptor"
  std::string help;   ///< meaning and the paper's symbol
  std::function<std::string()> get;
  std::function<void(const std::string&)>
      set;  ///< throws std::invalid_argument naming option, value and range
};

/// The table over an Options object, which must outlive it.
std::vector<OptionEntry> optionTable(Options& options);

/// Throws std::invalid_argument naming the first option that differs but cannot change while frames
/// are remembered: the seed, the window, the tracker and its images.
void requireSameMemory(const Options& before, const Options& after);

/// Sets one option by name; throws std::invalid_argument for unknown names, wrong types and values
/// out of range.
void setOption(Options& options, const std::string& name, const std::string& value);

}  // namespace mvo
