// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/patch_flow.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace mvo {

namespace {

constexpr int kMaxSteps = 20;
constexpr float kConverged = 0.01F;  // [px]
constexpr float kRough = 0.1F;       // where a finer level follows [px]
// Smallest eigenvalue of the gradient matrix, mean over the patch [(grey level / px)^2].
constexpr float kLeastTexture = 0.01F;
constexpr float kLeastGain = 0.05F;  // of an image that shows a patch; keeps steps finite

GreyImage grey(const cv::Mat& image) {
  return {image.data, static_cast<std::ptrdiff_t>(image.step)};
}

// As exactly as a step is known: a point on the first pixel stays there.
bool inside(const cv::Mat& image, const cv::Point2f& p) {
  return p.x >= -kConverged && p.y >= -kConverged &&
         p.x <= static_cast<float>(image.cols - 1) + kConverged &&
         p.y <= static_cast<float>(image.rows - 1) + kConverged;
}

bool isTextured(const FlowPatch& patch, int side) {
  const float mean = 0.5F * (patch.hxx + patch.hyy);
  const float least = mean - std::hypot(0.5F * (patch.hxx - patch.hyy), patch.hxy);
  return least > kLeastTexture * static_cast<float>(side * side);
}

// How much stronger the image's contrast is than the patch's, from the part of the image that a
// shifted patch explains: the correlation alone is less where the patch is not found yet.
float gainOf(const FlowSums& s, const cv::Point2f& step, const FlowPatch& patch) {
  const float explained = s.product * s.product / patch.square - (s.x * step.x + s.y * step.y);
  return std::sqrt(std::max(explained / patch.square, kLeastGain * kLeastGain));
}

float shrink(int level) { return 1.0F / static_cast<float>(1 << level); }

}  // namespace

std::vector<cv::Mat> buildPaddedPyramid(const cv::Mat& image, int side, int levels) {
  const int border = side / 2 + 2 + kFloats;
  std::vector<cv::Mat> pyramid;
  for (int level = 0; level <= levels; ++level) {
    const cv::Size size =
        level == 0 ? image.size()
                   : cv::Size((pyramid.back().cols + 1) / 2, (pyramid.back().rows + 1) / 2);
    if (level > 0 && std::min(size.width, size.height) <= side) break;
    cv::Mat padded(size.height + 2 * border, size.width + 2 * border, CV_8U);
    cv::Mat inner = padded(cv::Rect(cv::Point(border, border), size));
    if (level == 0)
      cv::copyMakeBorder(image, padded, border, border, border, border, cv::BORDER_REFLECT_101);
    else {
      cv::pyrDown(pyramid.back(), inner, size);
      cv::copyMakeBorder(inner, padded, border, border, border, border,
                         cv::BORDER_REFLECT_101 | cv::BORDER_ISOLATED);
    }
    pyramid.push_back(inner);
  }
  return pyramid;
}

void PatchFlow::take(const std::vector<cv::Mat>& pyramid, const cv::Point2f& p, int levels) {
  levels_ = std::min(levels, static_cast<int>(pyramid.size()) - 1);
  const int area = side_ * paddedToLanes(side_);
  if (static_cast<int>(patches_.size()) <= levels_)
    patches_.resize(static_cast<std::size_t>(levels_) + 1);
  room_.resize(static_cast<std::size_t>(flowRoom(side_)));
  for (int l = 0; l <= levels_; ++l) {
    Level& level = patches_[static_cast<std::size_t>(l)];
    const cv::Mat& image = pyramid[static_cast<std::size_t>(l)];
    const cv::Point2f centre = shrink(l) * p;
    level.usable = inside(image, centre);
    if (!level.usable) continue;
    level.memory.resize(static_cast<std::size_t>(3) * area);
    level.patch.values = level.memory.data();
    level.patch.gx = level.patch.values + area;
    level.patch.gy = level.patch.gx + area;
    takeFlowPatch(grey(image), centre.x, centre.y, side_, room_.data(), level.patch);
    level.usable = isTextured(level.patch, side_);
  }
}

bool PatchFlow::follow(const std::vector<cv::Mat>& pyramid, cv::Point2f& q) const {
  if (levels_ < 0 || !patches_.front().usable) return false;
  for (int l = std::min(levels_, static_cast<int>(pyramid.size()) - 1); l >= 0; --l) {
    const Level& level = patches_[static_cast<std::size_t>(l)];
    if (!level.usable) continue;
    cv::Point2f at = shrink(l) * q;
    const bool ended_inside = descend(pyramid[static_cast<std::size_t>(l)], level.patch,
                                      l == 0 ? kConverged : kRough, at);
    if (ended_inside)
      q = static_cast<float>(1 << l) * at;
    else if (l == 0)
      return false;
  }
  return true;
}

bool PatchFlow::descend(const cv::Mat& image, const FlowPatch& patch, float small,
                        cv::Point2f& q) const {
  const float inverse = 1.0F / (patch.hxx * patch.hyy - patch.hxy * patch.hxy);
  cv::Point2f last(0, 0);
  for (int i = 0; i < kMaxSteps; ++i) {
    if (!inside(image, q)) return false;
    const FlowSums s = flowSums(grey(image), q.x, q.y, side_, patch);
    cv::Point2f step(inverse * (patch.hxy * s.y - patch.hyy * s.x),
                     inverse * (patch.hxy * s.x - patch.hxx * s.y));
    step *= 1.0F / gainOf(s, step, patch);
    q += step;
    if (step.dot(step) <= small * small) break;
    if (i > 0 && std::abs(step.x + last.x) < small && std::abs(step.y + last.y) < small) {
      q -= 0.5F * step;  // to and fro
      break;
    }
    last = step;
  }
  return inside(image, q);
}

}  // namespace mvo
