// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/rolling_shutter.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "engine/link_residual.hpp"

namespace mvo {

namespace {

// Frames between the two observations of a pair to learn from: long enough that velocities differ
// and that neither depends on the other observation's noise.
constexpr int kPair = 4;
constexpr int kMinPoints = 30;       // of a pair
constexpr double kStep = 1e-3;       // of the numeric derivative by the readout [s]
constexpr int kReweightings = 3;     // of robust least squares
constexpr int kMinPairs = 3;         // before anything is decided
constexpr double kCertain = 8;       // standard deviations from a global shutter
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

RollingShutter::RollingShutter(const StereoCamera& camera, const Options& options)
    : camera_(camera), options_(options) {
  if (options.frontend.shutter == Shutter::kRolling) readout_ = options.frontend.readout;
}

void RollingShutter::addFrame(FrameId frame, double time, bool sensed_depth) {
  times_[frame] = time;
  times_.erase(times_.begin(), times_.lower_bound(frame - options_.window.frames -
                                                  options_.window.max_gap - kPair));
  sensed_depth_ = sensed_depth;
}

Window RollingShutter::withGlobalShutter(const Window& seen) const {
  return mvo::withGlobalShutter(seen, times_, camera_, readout_, sensed_depth_);
}

void RollingShutter::learn(const Window& seen, const Trajectory& world,
                           const std::vector<int>& support) {
  if (options_.frontend.shutter != Shutter::kAuto) return;
  const FrameId b = seen.last_frame - 1;
  const FrameId a = b - kPair;
  const auto T_b_a = world.between(b, a);
  if (!T_b_a) return;

  struct Row {
    Link link;                // at the present readout
    Eigen::Vector3d by_time;  // of the residual, by the readout
  };
  std::vector<Row> rows;
  const LinkResidual residual(camera_, options_.noise, ResidualModel::kWhitened);
  for (const int p : support) {
    const Tracklet& t = seen.tracklets[p];
    const Observation* at[2] = {t.find(a), t.find(b)};
    std::size_t j[2] = {};
    bool complete = true;
    for (int i = 0; i < 2 && complete; ++i) {
      j[i] = static_cast<std::size_t>(at[i] - t.observations.data());
      complete = at[i] != nullptr && j[i] > 0 && j[i] + 1 < t.observations.size();
    }
    if (!complete) continue;
    const auto linearize = [&](double readout, Link* link) {
      return residual.linearize(
          *T_b_a, atFrameTime(t, j[0], times_, camera_, readout, sensed_depth_),
          atFrameTime(t, j[1], times_, camera_, readout, sensed_depth_), link);
    };
    Row row;
    Link later;
    if (!linearize(readout_, &row.link) || !linearize(readout_ + kStep, &later)) continue;
    row.by_time = (later.residual - row.link.residual) / kStep;
    rows.push_back(row);
  }
  if (static_cast<int>(rows.size()) < kMinPoints) return;

  // Least squares over the pair's motion xi and a change of the readout, reweighted; the motion is
  // eliminated.
  Vector6d xi = Vector6d::Zero();
  double change = 0;
  Evidence pair;
  for (int i = 0; i < kReweightings; ++i) {
    Matrix6d A = Matrix6d::Identity() * 1e-9;
    Vector6d g = Vector6d::Zero();
    Vector6d c = Vector6d::Zero();
    pair = {};
    for (const Row& row : rows) {
      const auto& J = row.link.jacobian;
      const Eigen::Vector3d e = row.link.residual - J * xi + change * row.by_time;
      const double scale = options_.energy.threshold;
      const double weight = 1.0 / (1.0 + e.dot(row.link.information * e) / (scale * scale));
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
    if (!(information > 0)) return;
    change = (evidence_.slope + pair.slope - evidence_.information * readout_) / information;
    xi = solver.solve(g - change * c);
  }
  // Pairs at rest say nothing and would only dilute what others explain.
  const double period = meanPeriod();
  if (pair.information * period * period < kVisible * kVisible * pair.measurements) return;
  // From the present readout to none.
  evidence_.cost += pair.cost + 2 * pair.slope * readout_ + pair.information * readout_ * readout_;
  evidence_.slope += pair.slope + pair.information * readout_;
  evidence_.information += pair.information;
  evidence_.measurements += pair.measurements;
  ++evidence_.pairs;
  decide();
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
  readout_ = rolls ? std::clamp(best, -period, period) : 0;
}

}  // namespace mvo
