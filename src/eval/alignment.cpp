// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/alignment.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <utility>
#include <vector>

#include "mvo/se3.hpp"

namespace mvo {

namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kLeverArmRidge = 0.01;
constexpr int kMaxAlternations = 2000;
constexpr double kSettled = 1e-10;  // [rad]

struct Pair {
  Isometry3d P;
  Isometry3d G;
};

std::vector<Pair> firstPairs(const FramePoses& estimate, const FramePoses& truth, int poses) {
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < estimate.size() && k < truth.size(); ++k) {
    if (static_cast<int>(pairs.size()) == poses) break;
    if (estimate[k] && truth[k]) pairs.push_back({*estimate[k], *truth[k]});
  }
  return pairs;
}

// B_R from R_P B = B R_G and, the lever arm neglected, t_P = B t_G over all pairs of poses.
Matrix3d handEyeRotation(const std::vector<Pair>& pairs) {
  Matrix3d M = Matrix3d::Zero();
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for (std::size_t j = i + 1; j < pairs.size(); ++j) {
      const Isometry3d P = pairs[i].P.inverse() * pairs[j].P;
      const Isometry3d G = pairs[i].G.inverse() * pairs[j].G;
      M += rotationVector(P.linear()) * rotationVector(G.linear()).transpose();
      M += P.translation() * G.translation().transpose();
    }
  return nearestRotation(M);
}

// a and b of a + A_R P_R b = G_t - A_R P_t in the least squares sense.
void solveTranslations(const std::vector<Pair>& pairs, Alignment& alignment) {
  Matrix6d N = Matrix6d::Zero();
  Vector6d rhs = Vector6d::Zero();
  for (const Pair& pair : pairs) {
    Eigen::Matrix<double, 3, 6> J;
    J << Matrix3d::Identity(), alignment.A.linear() * pair.P.linear();
    N += J.transpose() * J;
    rhs += J.transpose() * (pair.G.translation() - alignment.A.linear() * pair.P.translation());
  }
  N.bottomRightCorner<3, 3>() += kLeverArmRidge * Matrix3d::Identity();
  const Vector6d ab = N.ldlt().solve(rhs);
  alignment.A.translation() = ab.head<3>();
  alignment.B.translation() = ab.tail<3>();
}

}  // namespace

std::optional<Alignment> alignLeft(const FramePoses& estimate, const FramePoses& truth, int poses) {
  const std::vector<Pair> pairs = firstPairs(estimate, truth, poses);
  if (pairs.empty()) return {};
  Vector3d mean_estimate = Vector3d::Zero();
  Vector3d mean_truth = Vector3d::Zero();
  for (const Pair& pair : pairs) {
    mean_estimate += pair.P.translation() / static_cast<double>(pairs.size());
    mean_truth += pair.G.translation() / static_cast<double>(pairs.size());
  }
  Matrix3d M = Matrix3d::Zero();
  for (const Pair& pair : pairs) {
    M += pair.G.linear() * pair.P.linear().transpose();
    M += (pair.G.translation() - mean_truth) * (pair.P.translation() - mean_estimate).transpose();
  }
  Alignment alignment;
  alignment.A.linear() = nearestRotation(M);
  alignment.A.translation() = mean_truth - alignment.A.linear() * mean_estimate;
  return alignment;
}

std::optional<Alignment> alignLeftRight(const FramePoses& estimate, const FramePoses& truth,
                                        int poses) {
  const std::vector<Pair> pairs = firstPairs(estimate, truth, poses);
  if (pairs.empty()) return {};
  Alignment alignment;
  alignment.B.linear() = handEyeRotation(pairs);
  for (int i = 0; i < kMaxAlternations; ++i) {
    Matrix3d M = Matrix3d::Zero();
    for (const Pair& pair : pairs)
      M += pair.G.linear() * (pair.P.linear() * alignment.B.linear()).transpose();
    alignment.A.linear() = nearestRotation(M);
    M.setZero();
    for (const Pair& pair : pairs)
      M += (alignment.A.linear() * pair.P.linear()).transpose() * pair.G.linear();
    const Matrix3d B = nearestRotation(M);
    const double change = angle(B.transpose() * alignment.B.linear());
    alignment.B.linear() = B;
    if (change < kSettled) break;
  }
  solveTranslations(pairs, alignment);
  return alignment;
}

std::optional<Alignment> alignBody(const FramePoses& estimate, const FramePoses& truth,
                                   const Isometry3d& A, int poses) {
  const std::vector<Pair> pairs = firstPairs(estimate, truth, poses);
  if (pairs.empty()) return {};
  Matrix3d M = Matrix3d::Zero();
  Vector3d b = Vector3d::Zero();
  for (const Pair& pair : pairs) {
    const Isometry3d P = A * pair.P;
    M += P.linear().transpose() * pair.G.linear();
    b += P.linear().transpose() * (pair.G.translation() - P.translation());
  }
  Alignment alignment;
  alignment.A = A;
  alignment.B.linear() = nearestRotation(M);
  alignment.B.translation() = b / static_cast<double>(pairs.size());
  return alignment;
}

double misfit(const Alignment& alignment, const FramePoses& estimate, const FramePoses& truth,
              int poses) {
  const std::vector<Pair> pairs = firstPairs(estimate, truth, poses);
  double sum = 0;
  for (const Pair& pair : pairs) {
    const Isometry3d E = pair.G.inverse() * alignment(pair.P);
    sum += E.translation().squaredNorm() + rotationVector(E.linear()).squaredNorm();
  }
  return pairs.empty() ? 0 : std::sqrt(sum / static_cast<double>(pairs.size()));
}

}  // namespace mvo
