// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/ransac.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "engine/motion_refinement.hpp"
#include "kernels/frame_pairs.hpp"

namespace mvo {

namespace {

// Gauss-Newton steps on a sample: depth noise must not rule its pose.
constexpr int kSampleSteps = 2;
// The loss of a sample's fit is this many thresholds wide: all three points must count.
constexpr double kLooseFit = 10;
constexpr int kRefineSteps = 4;  // Gauss-Newton steps on the inliers; more change nothing
constexpr int kMinInliers = 3;   // a rigid motion's least
// Even a clean sample is only as good as its three points: the best of some is taken.
constexpr int kMinIterations = 20;
constexpr double kMinDisparity = 0.05;  // of a sample's points, which need a place [px]

using Sample = std::array<int, 3>;

// The frame that three points span: a rotation, or none if they are collinear.
std::optional<Eigen::Matrix3d> frameOf(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                                       const Eigen::Vector3d& r) {
  const Eigen::Vector3d e = (q - p).normalized();
  const Eigen::Vector3d n = e.cross(r - p);
  if (!(n.norm() > 1e-3 * (r - p).norm())) return std::nullopt;
  Eigen::Matrix3d F;
  F.col(0) = e;
  F.col(2) = n.normalized();
  F.col(1) = F.col(2).cross(e);
  return F;
}

std::optional<Eigen::Isometry3d> alignSample(const std::vector<Eigen::Vector3d>& a,
                                             const std::vector<Eigen::Vector3d>& b,
                                             const Sample& s) {
  const auto R_a_sample = frameOf(a[s[0]], a[s[1]], a[s[2]]);
  const auto R_b_sample = frameOf(b[s[0]], b[s[1]], b[s[2]]);
  if (!R_a_sample || !R_b_sample) return std::nullopt;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = *R_b_sample * R_a_sample->transpose();
  T.translation() =
      (b[s[0]] + b[s[1]] + b[s[2]] - T.linear() * (a[s[0]] + a[s[1]] + a[s[2]])) / 3.0;
  return T;
}

Eigen::Vector3d pointOf(const Eigen::Vector3d& y, const StereoCamera& camera) {
  return camera.backProject({y.x(), y.y(), std::min(y.z(), y.x() - kMinDisparity)});
}

// Samples after which a clean one has been seen with the wanted probability, given a lower bound of
// the inlier share: of MSAC's score, cost <= outliers + truncated noise.
double iterationsNeeded(double share, double confidence) {
  const double good = std::pow(share, 3);
  if (confidence >= 1 || good < 1e-9) return std::numeric_limits<double>::infinity();
  if (good > 1 - 1e-9) return kMinIterations;
  return std::max<double>(kMinIterations, std::log(1 - confidence) / std::log(1 - good));
}

// Three different numbers below n.
Sample drawSample(std::mt19937_64& random, int n) {
  const auto below = [&random, n] { return static_cast<int>(random() % n); };
  Sample s;
  s[0] = below();
  do s[1] = below();
  while (s[1] == s[0]);
  do s[2] = below();
  while (s[2] == s[0] || s[2] == s[1]);
  return s;
}

// The best of the motions that it is offered.
class BestMotion {
 public:
  BestMotion(const PairArrays& pairs, const ProposalOptions& options, int count)
      : pairs_(pairs), options_(options), count_(count), needed_(options.iterations) {}

  void offer(const Eigen::Isometry3d& T_b_a) {
    const float cost =
        pairs_.score(T_b_a, options_.ranking, static_cast<float>(options_.threshold), cost_);
    if (!(cost < cost_)) return;
    cost_ = cost;
    T_b_a_ = T_b_a;
    needed_ = std::min(needed_, iterationsNeeded(1.0 - cost / count_, options_.confidence));
  }
  // The same, but of equals the one offered now wins.
  bool offerAnEqual(const Eigen::Isometry3d& T_b_a) {
    const float beyond = std::nextafter(cost_, std::numeric_limits<float>::infinity());
    const bool is_as_good = pairs_.score(T_b_a, options_.ranking,
                                         static_cast<float>(options_.threshold), beyond) <= cost_;
    if (is_as_good) T_b_a_ = T_b_a;
    return is_as_good;
  }
  bool wantsMore(int iterations) const {
    return iterations < options_.iterations && iterations < needed_;
  }
  bool exists() const { return std::isfinite(cost_); }

  FrameMotion classified() const {
    FrameMotion motion;
    motion.T_b_a = T_b_a_;
    motion.inlier = pairs_.inliers(T_b_a_, static_cast<float>(options_.threshold));
    motion.inliers = static_cast<int>(std::count(motion.inlier.begin(), motion.inlier.end(), 1));
    return motion;
  }

 private:
  const PairArrays& pairs_;
  const ProposalOptions& options_;
  int count_;
  double needed_;  // samples
  float cost_ = std::numeric_limits<float>::infinity();
  Eigen::Isometry3d T_b_a_ = Eigen::Isometry3d::Identity();
};

// Offers the motions of minimal samples until a clean one has been seen.
void offerSamples(const std::vector<StereoPair>& pairs, const LinkResidual& residual,
                  const ProposalOptions& options, std::uint64_t seed, BestMotion& best) {
  std::vector<Eigen::Vector3d> a;
  std::vector<Eigen::Vector3d> b;
  for (const StereoPair& pair : pairs) {
    a.push_back(pointOf(pair.y_a, residual.camera()));
    b.push_back(pointOf(pair.y_b, residual.camera()));
  }
  std::mt19937_64 random(seed);
  MotionFit three(residual);
  for (int i = 0; best.wantsMore(i); ++i) {
    const Sample s = drawSample(random, static_cast<int>(pairs.size()));
    const auto T_b_a = alignSample(a, b, s);
    if (!T_b_a) continue;
    if (!options.refine) {
      best.offer(*T_b_a);
      continue;
    }
    three.clear();
    for (const int k : s) three.add(pairs[k]);
    best.offer(three.refine(*T_b_a, kLooseFit * options.threshold, kSampleSteps));
  }
}

}  // namespace

Eigen::Isometry3d refineMotion(const Eigen::Isometry3d& T_b_a, const std::vector<StereoPair>& pairs,
                               const std::vector<char>& use, const LinkResidual& residual,
                               double scale, int iterations) {
  MotionFit fit(residual);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (use[i] != 0) fit.add(pairs[i]);
  return fit.refine(T_b_a, scale, iterations);
}

std::optional<FrameMotion> ransacMotion(const std::vector<StereoPair>& pairs,
                                        const LinkResidual& residual,
                                        const ProposalOptions& options, std::uint64_t seed,
                                        const std::optional<Eigen::Isometry3d>& guess) {
  if (pairs.size() < 3) return std::nullopt;
  const PairArrays arrays(pairs, residual);
  BestMotion best(arrays, options, static_cast<int>(pairs.size()));
  if (guess) best.offer(*guess);
  offerSamples(pairs, residual, options, seed, best);
  if (!best.exists()) return std::nullopt;
  FrameMotion motion = best.classified();
  if (options.refine && motion.inliers >= kMinInliers &&
      best.offerAnEqual(refineMotion(motion.T_b_a, pairs, motion.inlier, residual,
                                     options.threshold / 2, kRefineSteps)))
    motion = best.classified();
  if (motion.inliers < kMinInliers) return std::nullopt;
  return motion;
}

}  // namespace mvo
