// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/unambiguous.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "frontend/reference_patch.hpp"
#include "frontend/rivals.hpp"

namespace mvo {

namespace {

constexpr double kLeastLogOdds = 4.6;  // a rival is a hundred times less likely
constexpr double kFreedom = 3;  // of Student's distribution of places: some points go other ways
constexpr double kIndependent = 0.25;  // share of a patch's pixels; the others repeat them
constexpr double kLeastMisfit = 1e-4;  // of a patch, relative: what rounding leaves
constexpr int kSteps = 6;              // of an alignment

// Logarithm of the density of a point's place, up to a constant.
class Prior {
 public:
  explicit Prior(const ExpectedPlace& expected)
      : expected_(expected.uv), information_(expected.covariance.inverse()) {}

  double at(const Eigen::Vector2d& place) const {
    const Eigen::Vector2d d = place - expected_;
    return ofSquare(d.dot(information_ * d));
  }
  /// Places farther than that from `place` are less likely than it by kLeastLogOdds [px].
  double reach(const Eigen::Vector2d& place) const {
    const double square = std::expm1((at(place) - kLeastLogOdds) / (-0.5 * (kFreedom + 2)));
    return (place - expected_).norm() + std::sqrt(kFreedom * square / leastInformation());
  }

 private:
  static double ofSquare(double square) {
    return -0.5 * (kFreedom + 2) * std::log1p(square / kFreedom);
  }
  double leastInformation() const {
    const double mean = 0.5 * information_.trace();
    return mean - std::sqrt(std::max(0.0, mean * mean - information_.determinant()));
  }

  Eigen::Vector2d expected_;
  Eigen::Matrix2d information_;
};

// Share of a patch's variance that an image around a place does not explain; none if they cannot be
// compared.
std::optional<double> misfit(const std::optional<ReferencePatch>& patch, const cv::Mat& image,
                             const Eigen::Vector2f& place) {
  if (!patch) return std::nullopt;
  const auto found = patch->align(image, {Eigen::Matrix2f::Identity(), place}, kSteps);
  if (!found || !(found->correlation > 0)) return std::nullopt;
  return std::max(kLeastMisfit, 1.0 - found->correlation * found->correlation);
}

}  // namespace

bool isUnambiguous(const Sight& from, const Sight& to, const ExpectedPlace& expected, int side) {
  const Eigen::Vector2f q(to.place.x, to.place.y);
  const Prior prior(expected);
  const double reach = prior.reach(q.cast<double>());
  if (reach < kNearestRival) return true;
  const std::vector<Eigen::Vector2f> rivals = findRivals(from.pyramid, from.place, reach);
  if (rivals.empty()) return true;
  const auto patch = ReferencePatch::take(from.pyramid.front(), {from.place.x, from.place.y}, side);
  const cv::Mat& image = to.pyramid.front();
  const double own_prior = prior.at(q.cast<double>());
  const auto own_misfit = misfit(patch, image, q);
  // A point that has been mistaken for a rival is where q lies as the rival does from the point.
  for (const Eigen::Vector2f& d : rivals)
    for (const Eigen::Vector2f& place : {Eigen::Vector2f(q - d), Eigen::Vector2f(q + d)}) {
      const double odds = own_prior - prior.at(place.cast<double>());
      if (odds > kLeastLogOdds) continue;
      if (!own_misfit) return false;
      const auto other = misfit(patch, image, place);
      // The noise of the images is not known: likelihoods are those of the likeliest noise.
      if (other &&
          odds + 0.5 * kIndependent * side * side * std::log(*other / *own_misfit) <= kLeastLogOdds)
        return false;
    }
  return true;
}

}  // namespace mvo
