// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/camera/rolling_shutter.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace mvo {

namespace {

// Frames between the two observations of a pair to learn from: long enough that velocities differ
// and that neither depends on the other observation's noise.
constexpr int kPair = 4;
constexpr int kMinPoints = 30;            // of a pair
constexpr double kRegularisation = 1e-9;  // of a pair's motion, far below any information
constexpr double kStep = 1e-3;            // of the numeric derivative by the readout [s]
constexpr int kReweightings = 3;          // of robust least squares
constexpr int kMinPairs = 3;              // before anything is decided
constexpr double kCertain = 8;            // standard deviations from a global shutter
constexpr double kExplained = 0.10;  // share of the squared residuals that a readout must explain
constexpr double kVisible = 0.1;     // skew by a readout of one period, for a pair to count [px]
constexpr double kMinReadout = 0.1;  // less does not matter, of the frame period

// y at its frame's time: on the parabola through the observation and its neighbours, each at its
// row's time, or on the line through two. Parabolas beyond the newest observation would be ruled by
// noise.
Eigen::Vector3d atFrameTime(const Tracklet& tracklet, std::size_t j, const FrameTimes& times,
                            const StereoCamera& camera, double readout, bool sensed_depth) {
  const auto& o = tracklet.observations;
  const std::size_t first = j > 0 ? j - 1 : j;
  const std::size_t last = std::min(j + 1, o.size() - 1);
  const double now = times.at(o[j].frame);
  const auto row_time = [&](std::size_t i) {
    return times.at(o[i].frame) - now + readout * (o[i].y.y() / camera.height - 0.5);
  };
  Eigen::Vector3d y = Eigen::Vector3d::Zero();
  for (std::size_t i = first; i <= last; ++i) {
    double weight = 1;
    for (std::size_t k = first; k <= last; ++k)
      if (k != i) weight *= row_time(k) / (row_time(k) - row_time(i));
    y += weight * o[i].y;
  }
  if (sensed_depth) y.z() = y.x() - (o[j].y.x() - o[j].y.z());
  return y;
}

// Index of a tracklet's observation in a frame, if there is one before and one after it.
std::optional<std::size_t> innerIndex(const Tracklet& tracklet, FrameId frame) {
  const Observation* at = tracklet.find(frame);
  if (at == nullptr) return std::nullopt;
  const auto j = static_cast<std::size_t>(at - tracklet.observations.data());
  if (j == 0 || j + 1 == tracklet.observations.size()) return std::nullopt;
  return j;
}

}  // namespace

Window withGlobalShutter(const Window& seen, const FrameTimes& times, const StereoCamera& camera,
                         double readout, bool sensed_depth) {
  Window window = seen;
  for (std::size_t p = 0; p < window.tracklets.size(); ++p)
    for (std::size_t j = 0; j < window.tracklets[p].observations.size(); ++j) {
      window.tracklets[p].observations[j].y =
          atFrameTime(seen.tracklets[p], j, times, camera, readout, sensed_depth);
    }
  return window;
}

void RollingShutter::addFrame(FrameId frame, double time, bool sensed_depth, int frames) {
  times_[frame] = time;
  times_.erase(times_.begin(), times_.lower_bound(frame - frames - kPair));
  sensed_depth_ = sensed_depth;
}

double RollingShutter::readout(const FrontendOptions& options) const {
  return options.shutter == Shutter::kRolling ? options.readout : learnt_;
}

std::optional<Window> RollingShutter::withGlobalShutter(const Window& seen,
                                                        const StereoCamera& camera,
                                                        const FrontendOptions& options) const {
  if (readout(options) == 0) return std::nullopt;
  return mvo::withGlobalShutter(seen, times_, camera, readout(options), sensed_depth_);
}

void RollingShutter::learn(const Window& seen, const Trajectory& world,
                           const std::vector<int>& support, const LinkResidual& residual,
                           double threshold, const FrontendOptions& options) {
  if (options.shutter != Shutter::kAuto) return;
  const std::vector<Row> rows = rowsOf(seen, world, support, residual);
  if (static_cast<int>(rows.size()) < kMinPoints) return;
  const auto pair = evidenceOf(rows, threshold);
  if (!pair) return;
  // Pairs at rest say nothing and would only dilute what others explain.
  const double period = meanPeriod();
  if (pair->information * period * period < kVisible * kVisible * pair->measurements) return;
  // The pair's evidence is about a change of the present readout; the sum's is about the readout.
  evidence_.cost += pair->cost + 2 * pair->slope * learnt_ + pair->information * learnt_ * learnt_;
  evidence_.slope += pair->slope + pair->information * learnt_;
  evidence_.information += pair->information;
  evidence_.measurements += pair->measurements;
  ++evidence_.pairs;
  decide();
}

// The static world's points that are seen in the two frames of the newest pair that has a later
// frame, with neighbours on both sides in time.
std::vector<RollingShutter::Row> RollingShutter::rowsOf(const Window& seen, const Trajectory& world,
                                                        const std::vector<int>& support,
                                                        const LinkResidual& residual) const {
  const FrameId b = seen.last_frame - 1;
  const FrameId a = b - kPair;
  const auto T_b_a = world.between(b, a);
  if (!T_b_a) return {};
  std::vector<Row> rows;
  for (const int p : support) {
    const Tracklet& t = seen.tracklets[p];
    const auto at_a = innerIndex(t, a);
    const auto at_b = innerIndex(t, b);
    if (!at_a || !at_b) continue;
    const auto linearize = [&](double readout, Link* link) {
      const auto y = [&](std::size_t j) {
        return atFrameTime(t, j, times_, residual.camera(), readout, sensed_depth_);
      };
      return residual.linearize(*T_b_a, y(*at_a), y(*at_b), link);
    };
    Row row;
    Link later;
    if (!linearize(learnt_, &row.link) || !linearize(learnt_ + kStep, &later)) continue;
    row.by_time = (later.residual - row.link.residual) / kStep;
    rows.push_back(row);
  }
  return rows;
}

// Least squares over the pair's motion xi and a change of the readout, reweighted; the motion is
// eliminated. None as long as nothing is known of the readout.
std::optional<RollingShutter::Evidence> RollingShutter::evidenceOf(const std::vector<Row>& rows,
                                                                   double threshold) const {
  Vector6d xi = Vector6d::Zero();
  double change = 0;
  Evidence pair;
  for (int i = 0; i < kReweightings; ++i) {
    Matrix6d A = Matrix6d::Identity() * kRegularisation;
    Vector6d g = Vector6d::Zero();
    Vector6d c = Vector6d::Zero();
    pair = {};
    for (const Row& row : rows) {
      const auto& J = row.link.jacobian;
      const Eigen::Vector3d e = row.link.residual - J * xi + change * row.by_time;
      const double weight = 1.0 / (1.0 + e.dot(row.link.information * e) / (threshold * threshold));
      const Eigen::Matrix3d W = weight * row.link.information;
      A += J.transpose() * W * J;
      g += J.transpose() * W * row.link.residual;
      c -= J.transpose() * W * row.by_time;
      pair.cost += row.link.residual.dot(W * row.link.residual);
      pair.slope -= row.by_time.dot(W * row.link.residual);
      pair.information += row.by_time.dot(W * row.by_time);
      pair.measurements += 3 * weight;
    }
    const Eigen::LDLT<Matrix6d> solver(A);
    pair.cost -= g.dot(solver.solve(g));
    pair.slope -= c.dot(solver.solve(g));
    pair.information -= c.dot(solver.solve(c));
    const double information = evidence_.information + pair.information;
    if (!(information > 0)) return std::nullopt;
    change = (evidence_.slope + pair.slope - evidence_.information * learnt_) / information;
    xi = solver.solve(g - change * c);
  }
  return pair;
}

double RollingShutter::meanPeriod() const {
  return (times_.rbegin()->second - times_.begin()->second) /
         static_cast<double>(times_.size() - 1);
}

void RollingShutter::decide() {
  if (evidence_.pairs < kMinPairs) return;
  const double period = meanPeriod();
  const double best = evidence_.slope / evidence_.information;
  const double explained = best * evidence_.slope;
  const double variance =
      (evidence_.cost - explained) / evidence_.measurements / evidence_.information;
  const bool rolls = std::abs(best) > kCertain * std::sqrt(variance) &&
                     explained > kExplained * evidence_.cost &&
                     std::abs(best) > kMinReadout * period;
  learnt_ = rolls ? std::clamp(best, -period, period) : 0;
}

}  // namespace mvo
