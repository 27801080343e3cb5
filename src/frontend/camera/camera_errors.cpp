// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/camera/camera_errors.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "statistics.hpp"

namespace mvo {

namespace {

// Share of what was learnt that a frame forgets: cameras change within minutes, not seconds.
constexpr double kForgetting = 1e-3;
constexpr int kReweightings = 6;         // of robust least squares
constexpr double kLeastRowNoise = 0.05;  // of matching, standard deviation [px]
constexpr double kRowShare = 0.125;      // of a point's row: it errs alike in following frames
constexpr std::array<int, 5> kGaps{1, 2, 4, 8, 16};  // frames between the two of a pair
// Of a pair: a frame ends five of them and begins five, and what the fields do not describe of a
// camera is the same in all.
constexpr double kPairShare = 0.02;
constexpr int kSettled = 24;              // frames in which every pair counts
constexpr std::size_t kLeastPoints = 12;  // of a pair
constexpr double kLeastNoise = 0.05;      // of a pair, standard deviation [px]
constexpr double kRegularisation = 1e-9;  // of a pair's motion, far below any information
constexpr double kStep = 1e-3;            // of a numeric derivative by a column [px]
constexpr double kLeastDisparity = 0.05;  // that a correction leaves [px]
constexpr double kNormalMedian = 0.6745;  // of |x|, in standard deviations
constexpr double kPairMedian = 2.366;     // of the sum of three squares, in variances

// Cauchy's weight of a squared residual in variances, with what the numbers may still explain.
double weightOf(double squared) { return 1.0 / (1.0 + squared / 4.0); }

// A point errs alike in all its frames (its patch is matched with the same pixels again and again),
// so the more often it was seen, the less another frame says.
double newShare(std::ptrdiff_t earlier) { return 1.0 / static_cast<double>(1 + earlier); }

}  // namespace

CameraErrors::CameraErrors(const StereoCamera& camera)
    : camera_(camera), estimate_(expectedErrors(camera)) {
  prior_.information = estimate_.covariance.inverse();
}

void CameraErrors::startFrom(const ErrorEstimate& known) {
  // What the prior does not say already, and where it says more than is known, nothing.
  const Eigen::SelfAdjointEigenSolver<ErrorMatrix> parts(known.covariance.inverse() -
                                                         prior_.information);
  learnt_.information = parts.eigenvectors() * parts.eigenvalues().cwiseMax(0).asDiagonal() *
                        parts.eigenvectors().transpose();
  learnt_.vector = (prior_.information + learnt_.information) * known.mean;
  estimate_ = solved({});
}

void CameraErrors::addFrame(FrameId frame, double time, int frames) {
  if (clock_.empty()) first_ = frame;
  clock_.push_back(time);
  if (static_cast<int>(clock_.size()) > frames + 1) {
    clock_.erase(clock_.begin());
    ++first_;
  }
  ++frames_;
  learnt_.information *= 1 - kForgetting;
  learnt_.vector *= 1 - kForgetting;
}

// Of the right half: the derivative of the parabola through three observations, the one asked for
// in the middle where it has neighbours. Differences of two at a tracklet's end would be late by
// half a period, which looks like a delay between the eyes.
Eigen::Vector2d CameraErrors::velocityOf(const Tracklet& tracklet, std::size_t j) const {
  const auto& o = tracklet.observations;
  const auto time = [&](std::size_t i) { return timeOf(o[i].frame) - timeOf(o[j].frame); };
  const auto seen = [&](std::size_t i) { return Eigen::Vector2d(o[i].y.z(), o[i].y.y()); };
  if (o.size() < 2) return Eigen::Vector2d::Zero();
  if (o.size() == 2) return (seen(1) - seen(0)) / (time(1) - time(0));
  const std::size_t i = std::min(j > 0 ? j - 1 : j, o.size() - 3);
  const double t0 = time(i);
  const double t1 = time(i + 1);
  const double t2 = time(i + 2);
  return -(t1 + t2) / ((t0 - t1) * (t0 - t2)) * seen(i) -
         (t0 + t2) / ((t1 - t0) * (t1 - t2)) * seen(i + 1) -
         (t0 + t1) / ((t2 - t0) * (t2 - t1)) * seen(i + 2);
}

Eigen::Vector3d CameraErrors::corrected(const Tracklet& seen, std::size_t j) const {
  Eigen::Vector3d y = seen.observations[j].y;
  const double du = shiftAcross(camera_, y, velocityOf(seen, j).x(), estimate_.mean);
  y.z() = std::min(y.z() - du, y.x() - kLeastDisparity);
  return y;
}

Window CameraErrors::corrected(const Window& seen) const {
  Window window = seen;
  for (std::size_t p = 0; p < window.tracklets.size(); ++p)
    for (std::size_t j = 0; j < window.tracklets[p].observations.size(); ++j)
      window.tracklets[p].observations[j].y = corrected(seen.tracklets[p], j);
  return window;
}

ErrorEstimate CameraErrors::solved(const Evidence& more) const {
  const ErrorMatrix covariance =
      (prior_.information + learnt_.information + more.information).inverse();
  return {covariance * (learnt_.vector + more.vector), covariance};
}

void CameraErrors::add(const Evidence& more) {
  estimate_ = solved(more);
  learnt_.information += more.information;
  learnt_.vector += more.vector;
}

void CameraErrors::learnRows(const std::vector<Feature>& features, const TrackletWindow& window) {
  struct Match {
    ErrorVector field;
    double difference;  // v_r - v_l [px]
  };
  // Two observations do not tell a velocity from an acceleration.
  const int least_length = std::min(3, window.window().frames());
  std::vector<Match> rows;
  for (const Feature& f : features) {
    const auto index = window.find(window.trackletOf(f.id));
    if (!index) continue;
    const Tracklet& t = window.window().tracklets[*index];
    const auto length = static_cast<int>(t.observations.size());
    if (t.last() != window.window().last_frame || length < least_length) continue;
    const auto velocity = velocityOf(t, t.observations.size() - 1);
    rows.push_back({errorFields(camera_, f.y, velocity).row(1).transpose(), f.v_right - f.y.y()});
  }
  if (rows.size() < kLeastPoints) return;
  // From what is known now to what the rows say; the noise is theirs, too.
  Evidence evidence;
  ErrorEstimate now = estimate_;
  for (int i = 0; i < kReweightings; ++i) {
    std::vector<double> errors;
    errors.reserve(rows.size());
    for (const Match& row : rows)
      errors.push_back(std::abs(row.difference - row.field.dot(now.mean)));
    const double noise = std::max(kLeastRowNoise, median(errors) / kNormalMedian);
    evidence = {};
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const double information =
          kRowShare * weightOf(std::pow(errors[r] / noise, 2)) / (noise * noise);
      evidence.information += information * rows[r].field * rows[r].field.transpose();
      evidence.vector += information * rows[r].difference * rows[r].field;
    }
    now = solved(evidence);
  }
  add(evidence);
}

void CameraErrors::learnMotion(const Window& corrected, const Trajectory& trajectory,
                               const std::vector<int>& world, const LinkResidual& residual) {
  Evidence all;
  const FrameId b = corrected.last_frame;
  // At first every pair counts; later on they take turns.
  const bool in_turn = frames_ > kSettled;
  const double share = in_turn ? kPairShare * kGaps.size() : kPairShare;
  for (std::size_t i = 0; i < kGaps.size(); ++i) {
    if (in_turn && frames_ % static_cast<int>(kGaps.size()) != static_cast<int>(i)) continue;
    const auto T_b_a = trajectory.between(b, b - kGaps[i]);
    if (!T_b_a) continue;
    const auto pair = evidenceOf(rowsOf(corrected, b - kGaps[i], b, *T_b_a, world, residual));
    if (!pair) continue;
    all.information += share * pair->information;
    all.vector += share * pair->vector;
  }
  add(all);
}

std::vector<CameraErrors::Row> CameraErrors::rowsOf(const Window& corrected, FrameId a, FrameId b,
                                                    const Eigen::Isometry3d& T_b_a,
                                                    const std::vector<int>& world,
                                                    const LinkResidual& residual) const {
  std::vector<Row> rows;
  for (const int p : world) {
    const Tracklet& t = corrected.tracklets[p];
    const Observation* at_a = t.find(a);
    const Observation* at_b = t.find(b);
    if (at_a == nullptr || at_b == nullptr) continue;
    Row row;
    Link by_a;
    Link by_b;
    const Eigen::Vector3d column = kStep * Eigen::Vector3d::UnitZ();
    if (!residual.linearize(T_b_a, at_a->y, at_b->y, &row.link) ||
        !residual.linearize(T_b_a, at_a->y + column, at_b->y, &by_a) ||
        !residual.linearize(T_b_a, at_a->y, at_b->y + column, &by_b))
      continue;
    const auto column_by_error = [&](const Observation* at) -> ErrorVector {
      const auto j = static_cast<std::size_t>(at - t.observations.data());
      return errorFields(camera_, at->y, velocityOf(t, j)).row(0).transpose();
    };
    // A larger error moves the corrected column the other way.
    row.by_error = (row.link.residual - by_a.residual) / kStep * column_by_error(at_a).transpose() +
                   (row.link.residual - by_b.residual) / kStep * column_by_error(at_b).transpose();
    row.share = newShare(at_b - t.observations.data());
    rows.push_back(row);
  }
  return rows;
}

std::optional<Eigen::Matrix<double, 6, kErrorTerms>> CameraErrors::motionByErrors(
    const Window& corrected, FrameId a, FrameId b, const Eigen::Isometry3d& T_b_a,
    const std::vector<int>& tracklets, const LinkResidual& residual) const {
  const std::vector<Row> rows = rowsOf(corrected, a, b, T_b_a, tracklets, residual);
  if (rows.size() < kLeastPoints / 2) return std::nullopt;
  Matrix6d A = Matrix6d::Zero();
  Eigen::Matrix<double, 6, kErrorTerms> C = Eigen::Matrix<double, 6, kErrorTerms>::Zero();
  for (const Row& row : rows) {
    const Eigen::Matrix<double, 6, 3> to_motion =
        row.link.jacobian.transpose() * row.link.information;
    A += to_motion * row.link.jacobian;
    C += to_motion * row.by_error;
  }
  const Eigen::LLT<Matrix6d> factor(A);
  if (factor.info() != Eigen::Success) return std::nullopt;
  return factor.solve(C);
}

// Least squares over the pair's motion xi and a change of the numbers, reweighted, with the noise
// measured; the motion is eliminated.
std::optional<CameraErrors::Evidence> CameraErrors::evidenceOf(const std::vector<Row>& rows) const {
  if (rows.size() < kLeastPoints) return std::nullopt;
  Vector6d xi = Vector6d::Zero();
  ErrorVector change = ErrorVector::Zero();
  Evidence evidence;
  const int reweightings = frames_ > kSettled ? kReweightings / 2 : kReweightings;
  for (int i = 0; i < reweightings; ++i) {
    std::vector<double> squares;
    squares.reserve(rows.size());
    for (const Row& row : rows) {
      const Eigen::Vector3d e = row.link.residual - row.link.jacobian * xi + row.by_error * change;
      squares.push_back(e.dot(row.link.information * e));
    }
    const double variance = std::max(kLeastNoise * kLeastNoise, median(squares) / kPairMedian);
    Matrix6d A = Matrix6d::Identity() * kRegularisation;
    Vector6d g = Vector6d::Zero();
    Eigen::Matrix<double, 6, kErrorTerms> C = Eigen::Matrix<double, 6, kErrorTerms>::Zero();
    ErrorMatrix H = ErrorMatrix::Zero();
    ErrorVector h = ErrorVector::Zero();
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const Eigen::Matrix3d W = rows[r].share * weightOf(squares[r] / (3 * variance)) / variance *
                                rows[r].link.information;
      const Eigen::Matrix<double, 6, 3> to_motion = rows[r].link.jacobian.transpose() * W;
      const Eigen::Matrix<double, kErrorTerms, 3> to_error = rows[r].by_error.transpose() * W;
      A += to_motion * rows[r].link.jacobian;
      g += to_motion * rows[r].link.residual;
      C -= to_motion * rows[r].by_error;
      H += to_error * rows[r].by_error;
      h -= to_error * rows[r].link.residual;
    }
    const Eigen::LDLT<Matrix6d> solver(A);
    H -= C.transpose() * solver.solve(C);
    h -= C.transpose() * solver.solve(g);
    evidence = {kPairShare * H, kPairShare * (h + H * estimate_.mean)};
    change = solved(evidence).mean - estimate_.mean;
    xi = solver.solve(g - C * change);
  }
  evidence.information /= kPairShare;
  evidence.vector /= kPairShare;
  return evidence;
}

}  // namespace mvo
