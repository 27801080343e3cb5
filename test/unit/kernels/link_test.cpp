// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Eq. (1)'s two forms against each other, its derivative against differences, lanes against
// numbers.
#include "kernels/link.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mvo/se3.hpp"

namespace mvo {
namespace {

const StereoCamera kCamera{500, 510, 319.5, 239.5, 0.24, 640, 480};
constexpr double kVariance = 1.44;  // of the disparity, relative to that of u

struct RandomLink {
  explicit RandomLink(std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    Vector6d xi;
    for (int j = 0; j < 6; ++j) xi(j) = 0.2 * uniform(random);
    T_b_a = exp(xi);
    const Eigen::Vector3d p(uniform(random), uniform(random), 4 + uniform(random));
    y_a = kCamera.project(p);
    y_b = kCamera.project(T_b_a * p) + 3 * Eigen::Vector3d(uniform(random), uniform(random), 0);
  }
  Eigen::Isometry3d T_b_a;
  Eigen::Vector3d y_a;
  Eigen::Vector3d y_b;
};

void setEntries(const Eigen::Isometry3d& T, double (&entries)[12]) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) entries[4 * row + column] = T(row, column);
}

LinearLink<OneLink> linearized(const RandomLink& link, const Eigen::Isometry3d& T_b_a) {
  double T[12];
  setEntries(T_b_a, T);
  const LinkPoint<OneLink> a(kCamera, link.y_a);
  const Eigen::Vector3d& y = link.y_b;
  const double from[3] = {a.x, a.y, a.d};
  const double seen[3] = {y.x() - kCamera.cu, y.y() - kCamera.cv, y.x() - y.z()};
  return linearizeLink<Portable, OneLink>({kCamera, kVariance}, T, from, seen);
}

Eigen::Vector3d residual(const LinearLink<OneLink>& l) { return {l.e_u, l.e_v, l.e_d}; }

template <typename N>
double squared(const RandomLink& link) {
  double T[12];
  setEntries(link.T_b_a, T);
  typename N::Number entries[12];
  for (int i = 0; i < 12; ++i)
    entries[i] = typename N::Number{} + static_cast<typename N::Scalar>(T[i]);
  const LinkPoint<N> a(kCamera, link.y_a);
  const LinkPoint<N> b(kCamera, link.y_b);
  const typename N::Number zero{};
  const typename N::Number from[3] = {zero + a.x, zero + a.y, zero + a.d};
  const typename N::Number seen[3] = {zero + b.x, zero + b.y, zero + b.d};
  typename N::Number e2;
  squaredResidual<Portable, N, ResidualModel::kWhitened>({kCamera, kVariance}, entries, from, seen,
                                                         e2);
  if constexpr (sizeof e2 == sizeof(typename N::Scalar))
    return e2;
  else
    return e2[5];
}

TEST(Link, JacobianIsTheDifferenceOfThePrediction) {
  std::mt19937 random(5);
  for (int i = 0; i < 50; ++i) {
    const RandomLink link(random);
    const LinearLink<OneLink> l = linearized(link, link.T_b_a);
    Eigen::Matrix3d S;
    S << l.a, 0, -l.a * l.x, 0, l.b, -l.b * l.y, 0, 0, l.c;
    const Eigen::Matrix<double, 3, 6> J = S * odot(Eigen::Vector4d(l.p_x, l.p_y, l.p_z, 1));
    for (int j = 0; j < 6; ++j) {
      constexpr double kStep = 1e-6;
      const Vector6d step = kStep * Vector6d::Unit(j);
      // The prediction falls as the residual rises.
      const Eigen::Vector3d numeric = (residual(linearized(link, exp(-step) * link.T_b_a)) -
                                       residual(linearized(link, exp(step) * link.T_b_a))) /
                                      (2 * kStep);
      EXPECT_LT((J.col(j) - numeric).norm(), 1e-5 * (1 + numeric.norm()));
    }
  }
}

TEST(Link, SquareIsTheResidualsWeightedByItsInformation) {
  std::mt19937 random(6);
  for (int i = 0; i < 50; ++i) {
    const RandomLink link(random);
    const LinearLink<OneLink> l = linearized(link, link.T_b_a);
    const Eigen::Vector3d e = residual(l);
    const double along = Eigen::Vector3d(l.h_u, l.h_v, l.h_d).dot(e);
    const double weighted = l.i_uv * (e.x() * e.x() + e.y() * e.y()) + l.i_d * e.z() * e.z() -
                            along * along * l.inverse_norm;
    EXPECT_NEAR(squared<OneLink>(link), 2 * weighted, 1e-8 * (1 + weighted));
  }
}

TEST(Link, LanesAreNumbers) {
  std::mt19937 random(7);
  for (int i = 0; i < 50; ++i) {
    const RandomLink link(random);
    EXPECT_NEAR(squared<EightLinks>(link), squared<OneLink>(link),
                1e-3 * (1 + squared<OneLink>(link)));
  }
}

}  // namespace
}  // namespace mvo
