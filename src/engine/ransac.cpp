// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/engine/ransac.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <random>

#include "mvo/se3.hpp"

namespace mvo {

namespace {

constexpr int kSampleSteps =
    2;  // Gauss-Newton steps on a sample: depth noise must not rule its pose
constexpr int kRefineSteps = 4;
constexpr int kMinInliers = 3;
constexpr int kMinIterations = 20;

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

// Lower is better; gives up (infinity) as soon as `best` cannot be reached.
double score(const Eigen::Isometry3d& T, const std::vector<StereoPair>& pairs,
             const LinkResidual& residual, const ProposalOptions& options, double best) {
  double sum = 0;
  for (const StereoPair& pair : pairs) {
    const double e = std::min(residual(T, pair.y_a, pair.y_b) / options.threshold, 1.0);
    sum += options.ranking == Ranking::kMsac ? e * e : (e < 1.0 ? 0.0 : 1.0);
    if (sum >= best) return std::numeric_limits<double>::infinity();
  }
  return sum;
}

void classify(FrameMotion& motion, const std::vector<StereoPair>& pairs,
              const LinkResidual& residual, double threshold) {
  motion.inlier.assign(pairs.size(), 0);
  motion.inliers = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (residual(motion.T_b_a, pairs[i].y_a, pairs[i].y_b) < threshold) {
      motion.inlier[i] = 1;
      ++motion.inliers;
    }
}

double iterationsNeeded(double share, double confidence) {
  const double good = std::pow(share, 3);
  if (confidence >= 1 || good < 1e-9) return std::numeric_limits<double>::infinity();
  if (good > 1 - 1e-9) return 1;
  return std::log(1 - confidence) / std::log(1 - good);
}

}  // namespace

Eigen::Isometry3d refineMotion(Eigen::Isometry3d T_b_a, const std::vector<StereoPair>& pairs,
                               const std::vector<char>& use, const LinkResidual& residual,
                               double scale, int iterations) {
  Link link;
  for (int i = 0; i < iterations; ++i) {
    Matrix6d A = Matrix6d::Identity() * 1e-9;
    Vector6d b = Vector6d::Zero();
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if (use[k] == 0 || !residual.linearize(T_b_a, pairs[k].y_a, pairs[k].y_b, &link)) continue;
      const double e2 = link.residual.dot(link.information * link.residual);
      const double weight = 1.0 / (1.0 + e2 / (scale * scale));
      const Eigen::Matrix<double, 6, 3> weighted =
          weight * link.jacobian.transpose() * link.information;
      A += weighted * link.jacobian;
      b += weighted * link.residual;
    }
    const Vector6d step = A.ldlt().solve(b);
    if (!step.allFinite() || step.norm() > 10) break;
    T_b_a = exp(step) * T_b_a;
    if (step.norm() < 1e-9) break;
  }
  return T_b_a;
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

  FrameMotion motion;
  double best = std::numeric_limits<double>::infinity();
  double needed = options.iterations;
  const auto offer = [&](const Eigen::Isometry3d& T) {
    const double cost = score(T, pairs, residual, options, best);
    if (!(cost < best)) return;
    best = cost;
    motion.T_b_a = T;
    // Of MSAC's score, cost <= outliers + truncated noise: a lower bound of the inlier share.
    needed = std::min<double>(
        needed,
        std::max<double>(kMinIterations, iterationsNeeded(1.0 - cost / n, options.confidence)));
  };
  if (guess) offer(*guess);

  std::mt19937_64 random(seed);
  std::vector<StereoPair> three(3);
  const std::vector<char> all(3, 1);
  for (int i = 0; i < options.iterations && i < needed; ++i) {
    Sample s;
    s[0] = static_cast<int>(random() % n);
    do s[1] = static_cast<int>(random() % n);
    while (s[1] == s[0]);
    do s[2] = static_cast<int>(random() % n);
    while (s[2] == s[0] || s[2] == s[1]);
    const auto T = alignSample(a, b, s);
    if (!T) continue;
    if (options.refine) {
      for (int k = 0; k < 3; ++k) three[k] = pairs[s[k]];
      offer(refineMotion(*T, three, all, residual, 10 * options.threshold, kSampleSteps));
    } else {
      offer(*T);
    }
  }
  if (!std::isfinite(best)) return std::nullopt;
  classify(motion, pairs, residual, options.threshold);
  if (options.refine && motion.inliers >= kMinInliers) {
    const Eigen::Isometry3d refined = refineMotion(motion.T_b_a, pairs, motion.inlier, residual,
                                                   options.threshold / 2, kRefineSteps);
    if (score(refined, pairs, residual, options, best) <= best) {
      motion.T_b_a = refined;
      classify(motion, pairs, residual, options.threshold);
    }
  }
  if (motion.inliers < kMinInliers) return std::nullopt;
  return motion;
}

}  // namespace mvo
