// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The points of a frame with their labels.
#pragma once

#include <sensor_msgs/PointCloud2.h>

#include "ros/live/odometry_session.hpp"

namespace mvo_ros {

/// x, y, z [m] in the left optical frame, rgb (the motion's colour), label (int32: the motion's id,
/// -1 for outliers) and tracklet (uint32, id modulo 2^32) of every tracklet seen in the frame that
/// is near enough to have a place.
sensor_msgs::PointCloud2 cloudMessage(const Step& step, double min_disparity);

}  // namespace mvo_ros
