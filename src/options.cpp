// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/options.hpp"

#include <stdexcept>

#include "option_table.hpp"

namespace mvo {

std::vector<OptionEntry> optionTable(Options& o) {
  OptionTable t;
  t.number<std::uint64_t>("seed", o.seed, 0, 1000000000, "",
                          "seed of every random choice; the same bag gives the same bytes");

  t.number("window.frames", o.window.frames, 3, 500, "frames", "K, length of the sliding window");
  t.number("window.max_gap", o.window.max_gap, 0, 10, "frames",
           "frames that a tracklet may miss and still go on");

  auto& f = o.frontend;
  t.choice("frontend.tracker", f.tracker, {"klt", "descriptor"}, "how points are followed");
  t.number("frontend.max_features", f.max_features, 10, 20000, "", "tracklets alive at once");
  t.number("frontend.spacing", f.spacing, 3.0, 200.0, "px",
           "distance of points at 640x480, scales with the image");
  t.number(
      "frontend.min_contrast", f.min_contrast, 0.0, 255.0, "grey levels",
      "least contrast of a patch in its weakest direction; in dim images less, down to a quarter");
  t.number("frontend.patch", f.patch, 5, 51, "px", "side of a patch");
  t.number("frontend.pyramid_levels", f.pyramid_levels, 0, 8, "",
           "pyramid levels above the image itself");
  t.number("frontend.max_forward_backward", f.max_forward_backward, 0.01, 10.0, "px",
           "largest distance after tracking there and back");
  t.number("frontend.max_epipolar", f.max_epipolar, 0.1, 10.0, "px",
           "largest |v_left - v_right| of a stereo match");
  t.number("frontend.max_circle", f.max_circle, 0.1, 10.0, "px",
           "largest error of the circle left, right, next right, next left");
  t.flag("frontend.second_look", f.second_look,
         "KLT: points that a texture which repeats itself may have moved by a period are looked at "
         "again, and dropped if that does not settle it");
  t.number("frontend.min_disparity", f.min_disparity, 0.0, 10.0, "px",
           "least disparity of a point that is kept");
  t.number("frontend.max_disparity", f.max_disparity, 0.01, 1.0, "image widths",
           "largest disparity that is searched");
  t.number("frontend.virtual_baseline", f.virtual_baseline, 0.001, 10.0, "m",
           "RGB-D: baseline of the virtual right camera");
  t.number("frontend.min_depth", f.min_depth, 0.01, 100.0, "m",
           "RGB-D: nearest depth that is used");
  t.number("frontend.max_depth", f.max_depth, 0.1, 1000.0, "m",
           "RGB-D: farthest depth that is used");
  t.choice("frontend.shutter", f.shutter, {"auto", "global", "rolling"},
           "how rows are exposed: auto finds the readout time out while frames go by");
  t.number("frontend.readout", f.readout, -1.0, 1.0, "s",
           "from the first to the last row, if the shutter is rolling; auto needs none");

  t.choice("camera.errors", o.camera.errors, {"auto", "off"},
           "auto finds the stereo pair's calibration errors out while frames go by and corrects "
           "them; off trusts the calibration");

  t.number("noise.left", o.noise.left, 0.001, 10.0, "px",
           "standard deviation of u and v in the left image (R_jk)");
  t.number("noise.disparity", o.noise.disparity, 0.001, 10.0, "px",
           "standard deviation of u_left - u_right (R_jk)");

  t.number("graph.neighbors", o.graph.neighbors, 1, 100, "",
           "k of the nearest-neighbour graph (III-A)");

  auto& p = o.proposal;
  t.number("proposal.iterations", p.iterations, 1, 1000000, "",
           "RANSAC iterations per frame pair, at most (III-B)");
  t.number("proposal.threshold", p.threshold, 0.01, 100.0, "px",
           "e_th of a frame-to-frame link (III-B)");
  t.choice("proposal.ranking", p.ranking, {"msac", "count"},
           "how RANSAC ranks hypotheses: truncated residuals or number of inliers");
  t.number("proposal.confidence", p.confidence, 0.5, 1.0, "",
           "RANSAC stops early at this confidence; 1 = never");
  t.flag("proposal.warm_start", p.warm_start,
         "labels that explain their support are kept, not proposed anew");
  t.flag("proposal.refine", p.refine, "refine each link on its inliers by reprojection");
  t.number("proposal.min_support", p.min_support, 3, 1000, "tracklets",
           "least component that proposes a label");

  auto& e = o.energy;
  t.choice("energy.residual", e.residual, {"whitened", "image_distance"},
           "Eq. (1) weighted by the measurements' propagated covariance, or as printed");
  t.flag("energy.adaptive", e.adaptive,
         "thresholds and costs grow with the residuals that the images show");
  t.number("energy.typical_residual", e.typical_residual, 0.01, 100.0, "px",
           "median residual up to which nothing is scaled");
  t.flag("energy.long_pairs", e.long_pairs,
         "residuals of longer pairs beside the consecutive ones");
  t.number("energy.dead_zone", e.dead_zone, 0.0, 100.0, "px",
           "residual that costs nothing in Eq. (2)");
  t.number("energy.threshold", e.threshold, 0.01, 100.0, "px", "e_th of sanitization (III-E)");
  t.number("energy.smoothness", e.smoothness, 0.0, 1e6, "px", "lambda of Eq. (2)");
  t.number("energy.label_cost", e.label_cost, 0.0, 1e9, "px", "gamma of Eq. (2)");
  t.number("energy.outlier_scale", e.outlier_scale, 0.0, 1e9, "px", "alpha of the outlier label");
  t.number("energy.outlier_decay", e.outlier_decay, 0.001, 1000.0, "px",
           "beta of the outlier label");

  auto& g = o.engine;
  t.choice("engine.engine", g.engine, {"multimotion", "sequential_ransac"},
           "the method, or the paper's comparison (Torr)");
  t.choice("engine.solver", g.solver, {"alpha_expansion", "coral"}, "who minimises Eq. (2)");
  t.number("engine.max_rounds", g.max_rounds, 1, 100, "", "rounds of propose, assign, merge");
  t.number("engine.time_budget_ms", g.time_budget_ms, 0.0, 1e6, "ms",
           "of a step from its images on: then the label loop and the batch end with the best so "
           "far, so results depend on the machine's speed; 0 = no limit");
  t.number("engine.min_tracklets", g.min_tracklets, 3, 1000, "tracklets",
           "least support of a label (III-E)");
  t.number("engine.min_frames", g.min_frames, 2, 500, "frames", "least length of a label (III-E)");

  t.number("coral.max_iterations", o.coral.max_iterations, 1, 1000000, "",
           "primal-dual iterations, at most");
  t.number("coral.tolerance", o.coral.tolerance, 1e-12, 1.0, "",
           "gap to the lower bound that ends the iteration, relative");

  auto& b = o.bundle_adjustment;
  t.choice("bundle_adjustment.backend", b.backend, {"ceres", "schur"},
           "who minimises J: Ceres, or the package's own dense elimination of the landmarks");
  t.choice("bundle_adjustment.damping", b.damping, {"levenberg_marquardt", "gauss_newton"},
           "damped steps, or the paper's plain ones (III-F)");
  t.number("bundle_adjustment.max_iterations", b.max_iterations, 1, 1000, "",
           "iterations of a cold start, at most");
  t.number("bundle_adjustment.warm_iterations", b.warm_iterations, 1, 1000, "",
           "iterations of a warm start, at most");
  t.number("bundle_adjustment.robust_scale", b.robust_scale, 0.0, 1000.0, "standard deviations",
           "width of Cauchy's loss; 0 = plain squares");
  t.number("bundle_adjustment.function_tolerance", b.function_tolerance, 0.0, 1.0, "",
           "relative change of the cost that ends the iteration");
  t.number("bundle_adjustment.min_observations", b.min_observations, 3, 1000, "",
           "observations of a label in a frame, for a pose to exist");

  auto& w = o.trajectory;
  t.choice("trajectory.static_world", w.static_world, {"evidence", "support"},
           "which motion is the static world: the one that goes on, surrounds and lies behind, or "
           "the one with the most tracklets");
  t.number("trajectory.static_hysteresis", w.static_hysteresis, 1.0, 100.0, "",
           "times more support that a label needs to take over as the static world by support");
  t.number("trajectory.max_acceleration", w.max_acceleration, 0.0, 1e6, "m/s^2",
           "of the camera: a step that needs more is not believed; 0 = every step is");
  t.number("trajectory.max_angular_acceleration", w.max_angular_acceleration, 0.001, 1e6, "rad/s^2",
           "the same of its rotation");
  t.number("trajectory.extrapolation", w.extrapolation, 0.0, 60.0, "s",
           "a lost camera is taken to go on as it did for so long, then to stand");
  return t.rows;
}

void requireSameMemory(const Options& before, const Options& after) {
  Options a = before;
  Options b = after;
  const auto rows_a = optionTable(a);
  const auto rows_b = optionTable(b);
  for (std::size_t i = 0; i < rows_a.size(); ++i) {
    const std::string& name = rows_a[i].name;
    for (const char* fixed :
         {"seed", "window.", "frontend.tracker", "frontend.patch", "frontend.pyramid_levels",
          "frontend.virtual_baseline", "frontend.shutter", "frontend.readout", "camera."})
      if (name.rfind(fixed, 0) == 0 && rows_a[i].get() != rows_b[i].get())
        throw std::invalid_argument("option " + name + " cannot change from " + rows_a[i].get() +
                                    " to " + rows_b[i].get() + " while running");
  }
}

void setOption(Options& options, const std::string& name, const std::string& value) {
  setRow(optionTable(options), name, value);
}

void Options::validate() const {
  Options copy = *this;
  for (auto& row : optionTable(copy)) row.set(row.get());
  if (frontend.patch % 2 == 0)
    throw std::invalid_argument("option frontend.patch is '" + std::to_string(frontend.patch) +
                                "', it must be odd [px]");
  if (frontend.min_depth >= frontend.max_depth)
    throw std::invalid_argument(
        "option frontend.min_depth is '" + OptionTable::text(frontend.min_depth) +
        "', it must be below frontend.max_depth = " + OptionTable::text(frontend.max_depth) + " m");
}

Options paperOptions() {
  Options o;
  o.frontend.second_look = false;
  o.frontend.shutter = Shutter::kGlobal;
  o.camera.errors = CameraErrorMode::kOff;
  o.proposal.threshold = 4;
  o.proposal.ranking = Ranking::kCount;
  o.proposal.confidence = 1;
  o.proposal.warm_start = false;
  o.proposal.refine = false;
  o.proposal.min_support = 3;
  o.energy.residual = ResidualModel::kImageDistance;
  o.energy.adaptive = false;
  o.energy.long_pairs = false;
  o.energy.dead_zone = 0;
  o.energy.threshold = 4;
  o.energy.smoothness = 1;
  o.energy.label_cost = 1000;
  o.energy.outlier_scale = 100;
  o.energy.outlier_decay = 2;
  o.engine.solver = Solver::kCoral;
  o.bundle_adjustment.damping = DampingMethod::kGaussNewton;
  o.bundle_adjustment.robust_scale = 0;
  o.bundle_adjustment.min_observations = 3;
  o.bundle_adjustment.max_iterations = 10;
  o.bundle_adjustment.warm_iterations = 3;
  o.trajectory.static_world = WorldRule::kSupport;
  o.trajectory.max_acceleration = 0;
  return o;
}

Options optionsOfProfile(const std::string& profile) {
  if (profile == "default") return {};
  if (profile == "paper") return paperOptions();
  throw std::invalid_argument("there is no profile '" + profile +
                              "'; the profiles are: default, paper");
}

}  // namespace mvo
