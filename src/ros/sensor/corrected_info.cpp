// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/sensor/corrected_info.hpp"

#include <sensor_msgs/distortion_models.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <stdexcept>
#include <vector>

#include "frontend/camera/learnt_errors.hpp"

namespace mvo_ros {

namespace {

constexpr char kEquidistant[] = "equidistant";
constexpr int kColumns = 16;  // places over the image
constexpr int kRows = 12;
constexpr int kIterations = 4;
constexpr double kStep = 1e-3;  // of a numeric derivative [px]
// What a pixel's worth of a parameter costs, against a pixel of error in one place: next to
// nothing, and least for a turn.
constexpr double kTurnCost = 1e-4;
constexpr double kLensCost = 1e-2;

using Pixels = Eigen::VectorXd;  // u, v of each place

// A calibration as a vector of changes, each in pixels of a focal length's size.
class Calibration {
 public:
  explicit Calibration(const sensor_msgs::CameraInfo& info) : info_(info) {
    if (info_.K[0] <= 0)  // only the rectified camera is said
      info_.K = {info.P[0], 0, info.P[2], 0, info.P[5], info.P[6], 0, 0, 1};
    if (std::all_of(info_.R.begin(), info_.R.end(), [](double r) { return r == 0; }))
      info_.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    fisheye_ = info_.distortion_model == kEquidistant;
    const bool polynomial =
        info_.distortion_model.empty() ||
        info_.distortion_model == sensor_msgs::distortion_models::PLUMB_BOB ||
        info_.distortion_model == sensor_msgs::distortion_models::RATIONAL_POLYNOMIAL;
    if (!fisheye_ && !polynomial)
      throw std::runtime_error("the distortion model '" + info_.distortion_model +
                               "' is unknown: give plumb_bob, rational_polynomial or equidistant");
    if (fisheye_) {
      info_.D.resize(4, 0.0);
      lens_ = {0};
    } else {
      if (info_.D.size() < 5) info_.D.resize(5, 0.0);
      if (info_.distortion_model.empty())
        info_.distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
      lens_ = {0, 2, 3};  // k1, p1, p2
    }
  }

  Eigen::Index size() const { return 7 + static_cast<Eigen::Index>(lens_.size()); }

  Eigen::VectorXd costs() const {
    Eigen::VectorXd costs = Eigen::VectorXd::Constant(size(), kLensCost);
    costs.head<3>().setConstant(kTurnCost);
    return costs;
  }

  sensor_msgs::CameraInfo changed(const Eigen::VectorXd& change) const {
    sensor_msgs::CameraInfo out = info_;
    const double focal = info_.K[0];
    const Eigen::Vector3d turn = change.head<3>() / focal;
    using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    Eigen::Map<RowMajor> R(out.R.data());
    if (turn.norm() > 0)
      R = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * RowMajor(R);
    out.K[0] += change[3];
    out.K[4] += change[4];
    out.K[2] += change[5];
    out.K[5] += change[6];
    for (std::size_t i = 0; i < lens_.size(); ++i)
      out.D[lens_[i]] += change[7 + static_cast<Eigen::Index>(i)] / focal;
    return out;
  }

  // Where the raw image has what the rectified camera sees along rays.
  Pixels raw(const std::vector<cv::Point3d>& rays, const Eigen::VectorXd& change) const {
    const sensor_msgs::CameraInfo info = changed(change);
    const cv::Matx33d back = cv::Matx33d(info.R.data()).t();
    std::vector<cv::Point3d> turned;
    turned.reserve(rays.size());
    for (const cv::Point3d& ray : rays) turned.push_back(back * ray);
    const cv::Matx33d K(info.K.data());
    std::vector<cv::Point2d> pixels;
    if (fisheye_)
      cv::fisheye::projectPoints(turned, pixels, cv::Affine3d::Identity(), K, info.D);
    else
      cv::projectPoints(turned, cv::Vec3d(), cv::Vec3d(), K, info.D, pixels);
    Pixels out(2 * static_cast<Eigen::Index>(pixels.size()));
    for (std::size_t i = 0; i < pixels.size(); ++i)
      out.segment<2>(2 * static_cast<Eigen::Index>(i)) << pixels[i].x, pixels[i].y;
    return out;
  }

 private:
  sensor_msgs::CameraInfo info_;
  bool fisheye_ = false;
  std::vector<std::size_t> lens_;  // coefficients that may change
};

double rms(const Pixels& errors) {
  return std::sqrt(2 * errors.squaredNorm() / static_cast<double>(errors.size()));
}

}  // namespace

CorrectedInfo correctedRight(const sensor_msgs::CameraInfo& right,
                             const mvo::LearntCameraErrors& learnt) {
  const mvo::StereoCamera& camera = learnt.camera;
  const mvo::ErrorVector errors = mvo::estimateOf(learnt, camera).mean;
  std::vector<cv::Point3d> seen;   // where the calibration in force has what the image shows
  std::vector<cv::Point3d> exact;  // where it is
  for (int i = 0; i < kColumns; ++i)
    for (int j = 0; j < kRows; ++j) {
      const double u = (i + 0.5) / kColumns * camera.width;
      const double v = (j + 0.5) / kRows * camera.height;
      const Eigen::Vector2d shift =
          mvo::errorFields(camera, {u, v, u}, Eigen::Vector2d::Zero()) * errors;
      const double x = (u - camera.cu) / camera.fu;
      const double y = (v - camera.cv) / camera.fv;
      seen.emplace_back(x, y, 1);
      exact.emplace_back(x - shift.x() / camera.fu, y - shift.y() / camera.fv, 1);
    }
  const Calibration calibration(right);
  const Eigen::Index size = calibration.size();
  Eigen::VectorXd change = Eigen::VectorXd::Zero(size);
  const Pixels target = calibration.raw(seen, change);
  CorrectedInfo out;
  out.before_rms = rms(calibration.raw(exact, change) - target);
  const Eigen::MatrixXd costs = calibration.costs().asDiagonal();
  for (int k = 0; k < kIterations; ++k) {
    const Pixels now = calibration.raw(exact, change);
    Eigen::MatrixXd J(now.size(), size);
    for (Eigen::Index c = 0; c < size; ++c)
      J.col(c) =
          (calibration.raw(exact, change + kStep * Eigen::VectorXd::Unit(size, c)) - now) / kStep;
    change +=
        (J.transpose() * J + costs).ldlt().solve(J.transpose() * (target - now) - costs * change);
  }
  out.right = calibration.changed(change);
  out.after_rms = rms(calibration.raw(exact, change) - target);
  return out;
}

}  // namespace mvo_ros
