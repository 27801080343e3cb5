// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/camera/error_report.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "frontend/camera/error_advice.hpp"
#include "frontend/camera/learnt_errors.hpp"

namespace mvo {

namespace {

constexpr int kColumns = 16;  // places over the image
constexpr int kRows = 12;
constexpr double kDegrees = 180 / 3.14159265358979323846;

using Fields = Eigen::Matrix<double, 2, kErrorTerms>;

// Of a point at infinity.
Fields fieldsAt(const StereoCamera& camera, double u, double v) {
  return errorFields(camera, {u, v, u}, Eigen::Vector2d::Zero());
}

Measured linear(const ErrorVector& factors, const ErrorEstimate& estimate) {
  return {factors.dot(estimate.mean),
          std::sqrt(std::max(0.0, factors.dot(estimate.covariance * factors)))};
}

Measured rms(const ErrorMatrix& mean_square, const ErrorEstimate& estimate) {
  return {std::sqrt(std::max(0.0, estimate.mean.dot(mean_square * estimate.mean))),
          std::sqrt(std::max(0.0, (mean_square * estimate.covariance).trace()))};
}

// The mean over the image of the fields' products: of columns, and of rows.
std::array<ErrorMatrix, 2> meanSquares(const StereoCamera& camera) {
  std::array<ErrorMatrix, 2> squares{ErrorMatrix::Zero(), ErrorMatrix::Zero()};
  for (int i = 0; i < kColumns; ++i)
    for (int j = 0; j < kRows; ++j) {
      const Fields fields =
          fieldsAt(camera, (i + 0.5) / kColumns * camera.width, (j + 0.5) / kRows * camera.height);
      for (int k = 0; k < 2; ++k)
        squares[k] += fields.row(k).transpose() * fields.row(k) / (kColumns * kRows);
    }
  return squares;
}

// The mounting and focal length that together come nearest to the shifts over the whole image.
void addMounting(const ErrorMatrix& mean_square, const ErrorEstimate& estimate,
                 CameraErrorReport& report) {
  constexpr std::array<ErrorTerm, 4> kMounting{kTurn, kTilt, kRoll, kScale};
  Eigen::Matrix4d products;
  Eigen::Matrix<double, 4, kErrorTerms> projections;
  for (int i = 0; i < 4; ++i) {
    projections.row(i) = mean_square.row(kMounting[i]);
    for (int j = 0; j < 4; ++j) products(i, j) = mean_square(kMounting[i], kMounting[j]);
  }
  projections = products.ldlt().solve(projections).eval();
  const auto of = [&](int i, double unit) -> Measured {
    return linear(unit * projections.row(i).transpose(), estimate);
  };
  // What is seen moves against the camera.
  report.yaw = of(0, -kDegrees);
  report.pitch = of(1, kDegrees);
  report.roll = of(2, -kDegrees);
  report.focal = of(3, 100);
  ErrorMatrix rest = ErrorMatrix::Identity();
  for (int i = 0; i < 4; ++i) rest.row(kMounting[i]) -= projections.row(i);
  report.rest_rms = rms(rest.transpose() * mean_square * rest, estimate);
}

}  // namespace

double CameraErrorReport::largest() const {
  return std::max(
      {std::abs(disparity.value), disparity_rms.value, std::abs(rows.value), rows_rms.value});
}

CameraErrorReport errorReport(const StereoCamera& camera, const ErrorEstimate& estimate) {
  CameraErrorReport report;
  report.learnt = learntErrors(camera, estimate);
  for (int i = 0; i < kErrorTerms; ++i)
    report.terms.push_back(
        {termName(i),
         termUnit(i),
         {estimate.mean[i], std::sqrt(std::max(0.0, estimate.covariance(i, i)))}});
  const Fields middle = fieldsAt(camera, 0.5 * camera.width, 0.5 * camera.height);
  const std::array<ErrorMatrix, 2> squares = meanSquares(camera);
  report.disparity = linear(-middle.row(0).transpose(), estimate);
  report.disparity_rms = rms(squares[0], estimate);
  report.rows = linear(middle.row(1).transpose(), estimate);
  report.rows_rms = rms(squares[1], estimate);
  addMounting(squares[0] + squares[1], estimate, report);
  report.delay = linear(1e3 * ErrorVector::Unit(kDelay), estimate);
  report.advice = errorAdvice(report);
  report.significant = !report.advice.empty();
  return report;
}

}  // namespace mvo
