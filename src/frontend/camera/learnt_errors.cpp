// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/camera/learnt_errors.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace mvo {

namespace {

constexpr double kSame = 1e-6;  // relative difference of a calibration's numbers

struct Name {
  const char* name;
  const char* unit;
};

// In the order of ErrorTerm.
constexpr std::array<Name, kErrorTerms> kNames{{{"across", "focal lengths"},
                                                {"down", "focal lengths"},
                                                {"roll", "rad"},
                                                {"scale", "1"},
                                                {"radial", "1"},
                                                {"turn", "rad"},
                                                {"tilt", "rad"},
                                                {"tangential_u", "1"},
                                                {"tangential_v", "1"},
                                                {"width", "1"},
                                                {"shear", "1"},
                                                {"rise", "baselines"},
                                                {"delay", "s"}}};

void requireCamera(const StereoCamera& learnt, const StereoCamera& camera) {
  const auto require = [](const char* name, double theirs, double ours) {
    if (std::abs(theirs - ours) <= kSame * std::abs(ours)) return;
    std::ostringstream text;
    text.precision(9);
    text << "the camera errors belong to another camera: its " << name << " is " << theirs
         << ", this camera's is " << ours;
    throw std::invalid_argument(text.str());
  };
  require("width", learnt.width, camera.width);
  require("height", learnt.height, camera.height);
  require("fx", learnt.fu, camera.fu);
  require("fy", learnt.fv, camera.fv);
  require("cx", learnt.cu, camera.cu);
  require("cy", learnt.cv, camera.cv);
  require("baseline", learnt.baseline, camera.baseline);
}

}  // namespace

const char* termName(int term) { return kNames[term].name; }
const char* termUnit(int term) { return kNames[term].unit; }

LearntCameraErrors learntErrors(const StereoCamera& camera, const ErrorEstimate& estimate) {
  LearntCameraErrors learnt;
  learnt.camera = camera;
  for (const Name& name : kNames) learnt.terms.emplace_back(name.name);
  learnt.mean = estimate.mean;
  learnt.covariance = estimate.covariance;
  return learnt;
}

ErrorEstimate estimateOf(const LearntCameraErrors& learnt, const StereoCamera& camera) {
  const auto require = [](bool good, const std::string& problem) {
    if (!good) throw std::invalid_argument("the camera errors " + problem);
  };
  require(learnt.terms.size() == kErrorTerms && learnt.mean.size() == kErrorTerms &&
              learnt.covariance.rows() == kErrorTerms && learnt.covariance.cols() == kErrorTerms,
          "have " + std::to_string(learnt.terms.size()) + " terms or a covariance of " +
              std::to_string(learnt.covariance.rows()) + "x" +
              std::to_string(learnt.covariance.cols()) + ", there must be " +
              std::to_string(kErrorTerms) + " of each");
  for (int i = 0; i < kErrorTerms; ++i)
    require(learnt.terms[i] == kNames[i].name,
            "have a term '" + learnt.terms[i] + "' where '" + kNames[i].name + "' must be");
  requireCamera(learnt.camera, camera);
  require(learnt.mean.allFinite(), "are not finite");
  const ErrorMatrix covariance = 0.5 * (learnt.covariance + learnt.covariance.transpose());
  // In units of its own deviations: seconds and radians differ by orders of magnitude.
  const ErrorVector scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  require(
      covariance.allFinite() && scale.allFinite() &&
          Eigen::LLT<ErrorMatrix>(scale.asDiagonal() * covariance * scale.asDiagonal()).info() ==
              Eigen::Success,
      "have a covariance that is not positive definite");
  return {learnt.mean, covariance};
}

}  // namespace mvo
