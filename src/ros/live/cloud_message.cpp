// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/live/cloud_message.hpp"

#include <sensor_msgs/point_cloud2_iterator.h>

#include "edges/motion_color.hpp"

namespace mvo_ros {

sensor_msgs::PointCloud2 cloudMessage(const Step& step, double min_disparity) {
  std::vector<const mvo::LabeledPoint*> points;
  for (const mvo::LabeledPoint& point : step.estimate.points)
    if (point.y.x() - point.y.z() > min_disparity) points.push_back(&point);

  using Field = sensor_msgs::PointField;
  sensor_msgs::PointCloud2 cloud;
  cloud.header.frame_id = step.camera_frame_id;
  cloud.header.stamp = step.stamp;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2Fields(6, "x", 1, Field::FLOAT32, "y", 1, Field::FLOAT32, "z", 1,
                                Field::FLOAT32, "rgb", 1, Field::FLOAT32, "label", 1, Field::INT32,
                                "tracklet", 1, Field::UINT32);
  modifier.resize(points.size());
  cloud.is_dense = 1;
  if (points.empty()) return cloud;  // the iterators need a byte to point at
  sensor_msgs::PointCloud2Iterator<float> xyz(cloud, "x");
  sensor_msgs::PointCloud2Iterator<std::uint8_t> rgb(cloud, "rgb");
  sensor_msgs::PointCloud2Iterator<std::int32_t> label(cloud, "label");
  sensor_msgs::PointCloud2Iterator<std::uint32_t> tracklet(cloud, "tracklet");
  for (const mvo::LabeledPoint* point : points) {
    const Eigen::Vector3f p = step.camera.backProject(point->y).cast<float>();
    std::copy(p.data(), p.data() + 3, &xyz[0]);
    const auto [red, green, blue] = mvo::motionColor(point->id);
    rgb[0] = blue;
    rgb[1] = green;
    rgb[2] = red;
    rgb[3] = 0;
    *label = point->id;
    *tracklet = static_cast<std::uint32_t>(point->tracklet);
    ++xyz;
    ++rgb;
    ++label;
    ++tracklet;
  }
  return cloud;
}

}  // namespace mvo_ros
