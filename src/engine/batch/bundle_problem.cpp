// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/batch/bundle_problem.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace mvo {

namespace {

// Measurements of a frame whose spread across their best line is below this many standard
// deviations do not say how the frame is turned about that line. Lines in space are lines in
// (u, v, disparity), so measurements show it without the noise of depth.
constexpr double kLeastSpread = 3.0;

// Disparity that noise can make of a point at infinity, in standard deviations; a start that is
// farther beyond infinity lies behind its camera.
constexpr double kBeyondInfinity = 4.0;

bool isPose(const Eigen::Isometry3d& T) {
  constexpr double tolerance = 1e-6;
  const Eigen::Matrix3d C = T.linear();
  return T.matrix().allFinite() &&
         (C.transpose() * C - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < tolerance &&
         C.determinant() > 0;
}

Eigen::Vector3d whitened(const Observation& o, const StereoCamera& camera,
                         const NoiseOptions& noise) {
  const Eigen::Array3d per_deviation(1 / noise.left, 1 / noise.left, 1 / noise.disparity);
  return per_deviation *
         Eigen::Array3d(o.y.x() - camera.cu, o.y.y() - camera.cv, o.y.x() - o.y.z());
}

// What landmarks that are seen more than once say about a pose.
struct PoseEvidence {
  int count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();

  void add(const Eigen::Vector3d& h) {
    ++count;
    sum += h;
    squares += h * h.transpose();
  }
  // Enough, spread over more than a line.
  bool isEnough(int min_observations) const {
    if (count < min_observations) return false;
    const Eigen::Vector3d mean = sum / count;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(
        squares / count - mean * mean.transpose(), Eigen::EigenvaluesOnly);
    return spread.eigenvalues()(1) > kLeastSpread * kLeastSpread;
  }
};

// Poses that landmarks connect with each other.
class Connections {
 public:
  explicit Connections(std::size_t poses) : parent_(poses) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  void connect(int a, int b) {
    a = root(a);
    b = root(b);
    parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }
  bool areAll() {
    for (std::size_t k = 0; k < parent_.size(); ++k)
      if (root(static_cast<int>(k)) != 0) return false;
    return true;
  }

 private:
  int root(int pose) {
    while (parent_[static_cast<std::size_t>(pose)] != pose)
      pose = parent_[static_cast<std::size_t>(pose)];
    return pose;
  }
  std::vector<int> parent_;
};

// Inverse depth in the camera of the anchor; from the anchor's measurement where the start cannot
// have been seen there.
Eigen::Vector3d startOf(const Eigen::Vector4d& p_c1, const Eigen::Matrix4d& T_anchor_c1,
                        const Eigen::Vector3d& h, const Eigen::Vector3d& gain) {
  const Eigen::Vector4d q = T_anchor_c1 * p_c1;
  if (std::abs(q.z()) > 1e-12 * q.norm()) {
    Eigen::Vector3d m(q.x() / q.z(), q.y() / q.z(), q.w() / q.z());
    if (gain.z() * m.z() > -kBeyondInfinity) return m;
  }
  return h.cwiseQuotient(gain);
}

// A pose as anchor: its chart, and C_1 seen from it.
struct Anchor {
  explicit Anchor(const Eigen::Isometry3d& T) : T_anchor_c1(T.matrix()) {
    const Eigen::Isometry3d T_c1_anchor = T.inverse();
    chart.B << T_c1_anchor.linear().leftCols<2>(), T_c1_anchor.translation();
    chart.origin = T_c1_anchor.linear().col(2);
  }
  Eigen::Matrix4d T_anchor_c1;
  LandmarkChart chart;
};

// Fills a problem track by track, and notes what the measurements constrain.
class ProblemBuilder {
 public:
  ProblemBuilder(const Bundle& bundle, const StereoCamera& camera, const NoiseOptions& noise,
                 BundleProblem& problem)
      : bundle_(bundle),
        camera_(camera),
        noise_(noise),
        problem_(problem),
        anchors_(bundle.T_ck_c1.begin(), bundle.T_ck_c1.end()),
        evidence_(bundle.T_ck_c1.size()),
        connections_(bundle.T_ck_c1.size()),
        is_tied_(bundle.T_ck_c1.size()) {}

  // False if the track is not finite, out of order or out of the poses' span.
  bool add(std::size_t j) {
    const BatchTrack& track = bundle_.tracks[j];
    if (!track.p_c1.allFinite()) return false;
    if (track.begin == track.end) return true;
    if (track.begin->frame < bundle_.first_frame ||
        poseOf(*(track.end - 1)) >= static_cast<int>(anchors_.size()))
      return false;
    const auto count = track.end - track.begin;
    auto& landmark = problem_.landmarks[j];
    landmark.is_known = track.is_known;
    landmark.first = poseOf(*track.begin);
    landmark.span = poseOf(*(track.end - 1)) - landmark.first + 1;
    landmark.block = static_cast<int>(problem_.blocks.size());
    if (landmark.span < count) return false;  // out of order
    problem_.measurements += static_cast<int>(count);
    problem_.blocks.resize(problem_.blocks.size() + landmark.blocks());
    int last = -1;
    for (const Observation* o = track.begin; o != track.end; ++o) {
      const int pose = poseOf(*o);
      const Eigen::Vector3d h = whitened(*o, camera_, noise_);
      if (pose <= last || pose >= landmark.first + landmark.span || !std::isfinite(h.sum()))
        return false;
      store(landmark, pose, h);
      if (count > 1) evidence_[static_cast<std::size_t>(pose)].add(h);
      tie(last, pose);
      last = pose;
      if (o == track.begin + count / 2) {
        const Anchor& anchor = anchors_[static_cast<std::size_t>(pose)];
        landmark.chart = anchor.chart;
        problem_.start.landmarks[j] = startOf(track.p_c1, anchor.T_anchor_c1, h, problem_.gain);
      }
    }
    return true;
  }

  bool isConstrained(int min_observations) {
    return std::all_of(evidence_.begin(), evidence_.end(),
                       [min_observations](const PoseEvidence& e) {
                         return e.isEnough(min_observations);
                       }) &&
           connections_.areAll();
  }

 private:
  int poseOf(const Observation& o) const { return static_cast<int>(o.frame - bundle_.first_frame); }
  void store(const BundleProblem::Landmark& landmark, int pose, const Eigen::Vector3d& h) {
    const auto slot = static_cast<std::size_t>(pose - landmark.first);
    auto& block = problem_.blocks[static_cast<std::size_t>(landmark.block) + slot / kDoubles];
    block.u[slot % kDoubles] = h.x();
    block.v[slot % kDoubles] = h.y();
    block.d[slot % kDoubles] = h.z();
    block.seen[slot % kDoubles] = 1;
  }
  void tie(int last, int pose) {
    if (last < 0 || (last + 1 == pose && is_tied_[static_cast<std::size_t>(pose)])) return;
    connections_.connect(last, pose);
    if (last + 1 == pose) is_tied_[static_cast<std::size_t>(pose)] = true;
  }

  const Bundle& bundle_;
  const StereoCamera& camera_;
  const NoiseOptions& noise_;
  BundleProblem& problem_;
  std::vector<Anchor> anchors_;
  std::vector<PoseEvidence> evidence_;
  Connections connections_;
  std::vector<bool> is_tied_;  // to the pose before
};

}  // namespace

std::optional<BundleProblem> makeBundleProblem(const Bundle& bundle, const StereoCamera& camera,
                                               const NoiseOptions& noise,
                                               const BundleAdjustmentOptions& options,
                                               BundleProblem memory) {
  BundleProblem problem = std::move(memory);
  const auto& T_ck_c1 = bundle.T_ck_c1;
  const auto& tracks = bundle.tracks;
  problem.gain = {camera.fu / noise.left, camera.fv / noise.left,
                  camera.fu * camera.baseline / noise.disparity};
  if (tracks.empty() || T_ck_c1.size() < 2 || !problem.gain.allFinite() ||
      problem.gain.minCoeff() <= 0 || !std::all_of(T_ck_c1.begin(), T_ck_c1.end(), isPose))
    return std::nullopt;
  problem.robust_scale = options.robust_scale;
  problem.is_warm =
      std::any_of(tracks.begin(), tracks.end(), [](const BatchTrack& t) { return t.is_known; });
  problem.measurements = 0;
  problem.start.T_ck_c1 = T_ck_c1;
  problem.start.landmarks.assign(tracks.size(), Eigen::Vector3d::Zero());
  problem.landmarks.assign(tracks.size(), {});
  problem.blocks.clear();

  ProblemBuilder builder(bundle, camera, noise, problem);
  for (std::size_t j = 0; j < tracks.size(); ++j)
    if (!builder.add(j)) return std::nullopt;
  if (!builder.isConstrained(options.min_observations)) return std::nullopt;
  return problem;
}

std::optional<int> newestWeakPose(const Bundle& bundle, const StereoCamera& camera,
                                  const NoiseOptions& noise, int min_observations) {
  std::vector<PoseEvidence> evidence(bundle.T_ck_c1.size());
  for (const BatchTrack& track : bundle.tracks) {
    if (track.end - track.begin < 2) continue;
    for (const Observation* o = track.begin; o != track.end; ++o)
      evidence[static_cast<std::size_t>(o->frame - bundle.first_frame)].add(
          whitened(*o, camera, noise));
  }
  for (std::size_t k = evidence.size(); k-- > 0;)
    if (!evidence[k].isEnough(min_observations)) return static_cast<int>(k);
  return std::nullopt;
}

LandmarkMeasurements BundleProblem::measured(std::size_t j, const Eigen::Vector3d& m) const {
  const Landmark& landmark = landmarks[j];
  LandmarkMeasurements out;
  Eigen::Map<Eigen::Vector3d>(out.gain.data()) = gain;
  out.inverse_square_scale = robust_scale > 0 ? 1.0 / (robust_scale * robust_scale) : 0.0;
  Eigen::Map<Eigen::Matrix3d>(out.B.data()) = landmark.chart.B;
  Eigen::Map<Eigen::Vector3d>(out.origin.data()) = landmark.chart.origin;
  Eigen::Map<Eigen::Vector3d>(out.m.data()) = m;
  out.blocks = blocks.data() + landmark.block;
  out.count = landmark.blocks();
  return out;
}

void fillPoses(const std::vector<Eigen::Isometry3d>& T_ck_c1, PoseTable& table) {
  table.reset(kPoseRows, T_ck_c1.size());
  for (std::size_t k = 0; k < T_ck_c1.size(); ++k)
    for (Eigen::Index c = 0; c < 4; ++c)
      for (Eigen::Index r = 0; r < 3; ++r)
        table(static_cast<std::size_t>(3 * c + r), k) = T_ck_c1[k](r, c);
}

BundleCost bundleCost(const BundleProblem& problem, const ResidualSums& sums) {
  const double squares = sums.totalSquares();
  const double scale = problem.robust_scale;
  return {0.5 * (scale > 0 ? scale * scale * sums.totalLogarithms() : squares),
          std::sqrt(squares / (3.0 * problem.measurements))};
}

BundleCost bundleCost(const BundleProblem& problem, const BundleState& state) {
  PoseTable poses;
  fillPoses(state.T_ck_c1, poses);
  ResidualSums sums;
  for (std::size_t j = 0; j < problem.landmarks.size(); ++j)
    if (problem.landmarks[j].span > 0)
      addResiduals(problem.measured(j, state.landmarks[j]),
                   poses.at(static_cast<std::size_t>(problem.landmarks[j].first)), poses.stride(),
                   sums);
  return bundleCost(problem, sums);
}

}  // namespace mvo
