// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "frontend/circle_matching.hpp"
#include "frontend/klt.hpp"
#include "mvo/frame.hpp"
#include "stopwatch.hpp"

namespace mvo {

namespace {

std::string sizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

// What is wrong with an image of a frame, or an empty string.
std::string complaintOf(const cv::Mat& image, const char* name, int type, const char* type_name,
                        const StereoCamera& camera) {
  const std::string the_image = std::string("the ") + name + " image is ";
  if (image.type() != type) return the_image + "not " + type_name;
  if (image.cols == camera.width && image.rows == camera.height) return "";
  return the_image + sizeText(image.cols, image.rows) + ", the calibration says " +
         sizeText(camera.width, camera.height);
}

// What is wrong with a frame's images, or an empty string.
std::string complaintOf(const Frame& frame, const StereoCamera& camera) {
  if (frame.left.empty()) return "the left image is empty";
  if (frame.right.empty() == frame.depth.empty())
    return "a frame needs either a right image or a depth image";
  std::string left = complaintOf(frame.left, "left", CV_8UC1, "8-bit grey", camera);
  if (!left.empty()) return left;
  std::string second = frame.depth.empty()
                           ? complaintOf(frame.right, "right", CV_8UC1, "8-bit grey", camera)
                           : complaintOf(frame.depth, "depth", CV_32FC1, "32-bit float", camera);
  if (!second.empty() || frame.mask.empty()) return second;
  return complaintOf(frame.mask, "mask", CV_8UC1, "8-bit grey", camera);
}

// Points keep half a patch away from what is left out, or they would follow its outline.
void leaveOut(const cv::Mat& mask, int patch, FrameImages& images) {
  if (mask.empty()) return;
  cv::erode(mask, images.mask, cv::Mat::ones(patch, patch, CV_8U));
  std::vector<CornerPeak>& peaks = images.peaks;
  peaks.erase(std::remove_if(peaks.begin(), peaks.end(),
                             [&](const CornerPeak& p) {
                               return !isAllowed(images.mask, {p.u, p.v});
                             }),
              peaks.end());
}

FrameImages imagesOf(const Frame& frame, const FrontendOptions& options) {
  FrameImages images;
  if (options.tracker == Tracker::kDescriptor) {
    images = describedImages(frame, options);
  } else {
    cv::parallel_for_(cv::Range(0, frame.right.empty() ? 1 : 2), [&](const cv::Range& eyes) {
      for (int eye = eyes.start; eye < eyes.end; ++eye)
        (eye == 0 ? images.left : images.right) =
            buildPyramid(eye == 0 ? frame.left : frame.right, options);
    });
    images.depth = frame.depth;
  }
  images.peaks = findCornerPeaks(images.left.front());
  leaveOut(frame.mask, options.patch, images);
  return images;
}

}  // namespace

PreparedFrame prepareFrame(const Frame& frame, const StereoCamera& camera,
                           const FrontendOptions& options) {
  Stopwatch watch;
  PreparedFrame prepared;
  prepared.stamp_ns = frame.stamp_ns;
  prepared.problem = complaintOf(frame, camera);
  if (prepared.problem.empty())
    prepared.images = std::make_shared<FrameImages>(imagesOf(frame, options));
  watch.lap("prepare");
  prepared.prepare_ms = watch.total();
  return prepared;
}

}  // namespace mvo
