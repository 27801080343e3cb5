// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Images to compressed messages and back, in the words of compressed_image_transport, so that
// either side may be its.
#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

namespace mvo_ros {

constexpr int kUsualJpegQuality = 90;

/// JPEG of 8 bits per channel, PNG (lossless) of 16. `jpeg_quality` is in [1, 100]. Throws
/// std::runtime_error naming the encoding that cannot be compressed.
sensor_msgs::CompressedImage compressImage(const sensor_msgs::Image& message, int jpeg_quality);

/// The image in the encoding it had before. Throws std::runtime_error if the data are broken or cut
/// short.
sensor_msgs::ImagePtr decompressImage(const sensor_msgs::CompressedImage& message);

}  // namespace mvo_ros
