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

constexpr int kSampleSteps =
    2;  // Gauss-Newton steps on a sample: depth noise must not rule its pose
constexpr int kRefineSteps = 4;
constexpr int kMinInliers = 3;
constexpr int kMinIterations = 20;  // a clean sample is as good as its points: the best of some

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
  return camera.backProject({y.x(), y.y(), std::min(y.z(), y.x() - 0.05)});
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
                                        const StereoCamera& camera, const LinkResidual& residual,
                                        const ProposalOptions& options, std::uint64_t seed,
                                        const std::optional<Eigen::Isometry3d>& guess) {
  const int n = static_cast<int>(pairs.size());
  if (n < 3) return std::nullopt;
  std::vector<Eigen::Vector3d> a;
  std::vector<Eigen::Vector3d> b;
  for (const StereoPair& pair : pairs) {
    a.push_back(pointOf(pair.y_a, camera));
    b.push_back(pointOf(pair.y_b, camera));
  }

  const PairArrays arrays(pairs, residual);
  const auto threshold = static_cast<float>(options.threshold);
  FrameMotion motion;
  float best = std::numeric_limits<float>::infinity();
  double needed = options.iterations;
  const auto offer = [&](const Eigen::Isometry3d& T) {
    const float cost = arrays.score(T, options.ranking, threshold, best);
    if (!(cost < best)) return;
    best = cost;
    motion.T_b_a = T;
    needed = std::min(needed, iterationsNeeded(1.0 - cost / n, options.confidence));
  };
  if (guess) offer(*guess);

  std::mt19937_64 random(seed);
  MotionFit three(residual);
  for (int i = 0; i < options.iterations && i < needed; ++i) {
    const Sample s = drawSample(random, n);
    const auto T = alignSample(a, b, s);
    if (!T) continue;
    if (options.refine) {
      three.clear();
      for (const int k : s) three.add(pairs[k]);
      offer(three.refine(*T, 10 * options.threshold, kSampleSteps));
    } else {
      offer(*T);
    }
  }
  if (!std::isfinite(best)) return std::nullopt;
  const auto classify = [&] {
    motion.inlier = arrays.inliers(motion.T_b_a, threshold);
    motion.inliers = static_cast<int>(std::count(motion.inlier.begin(), motion.inlier.end(), 1));
  };
  classify();
  if (options.refine && motion.inliers >= kMinInliers) {
    const Eigen::Isometry3d refined = refineMotion(motion.T_b_a, pairs, motion.inlier, residual,
                                                   options.threshold / 2, kRefineSteps);
    // Of equals, the refined one.
    if (arrays.score(refined, options.ranking, threshold,
                     std::nextafter(best, std::numeric_limits<float>::infinity())) <= best) {
      motion.T_b_a = refined;
      classify();
    }
  }
  if (motion.inliers < kMinInliers) return std::nullopt;
  return motion;
}

}  // namespace mvo
