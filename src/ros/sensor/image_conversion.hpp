// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Image messages in any usual encoding to the two kinds of image that the library reads: grey and
// depth.
#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <opencv2/core.hpp>

namespace mvo_ros {

/// 8UC1 grey of a mono, colour or Bayer image; 16 bits are scaled by the encoding's full range.
/// Compressed images are decoded as image_transport's "compressed" does it live. Throws
/// std::runtime_error naming the encoding or what is wrong with the data.
cv::Mat greyImage(const sensor_msgs::Image& message);
cv::Mat greyImage(const sensor_msgs::CompressedImage& message);

/// 32FC1 depth [m] of a 16UC1 [mm] or 32FC1 [m] image; holes (0, negative, infinite, NaN) are NaN.
/// Throws std::runtime_error naming the encoding or what is wrong with the data.
cv::Mat depthImage(const sensor_msgs::Image& message);
cv::Mat depthImage(const sensor_msgs::CompressedImage& message);

}  // namespace mvo_ros
