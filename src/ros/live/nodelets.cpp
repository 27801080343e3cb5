// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// mvo/StereoNodelet and mvo/RgbdNodelet.
#include <nodelet/nodelet.h>

#include <memory>
#include <pluginlib/class_list_macros.hpp>

#include "ros/live/live_node.hpp"

namespace mvo_ros {

template <Sensor sensor>
class MultimotionNodelet : public nodelet::Nodelet {
 private:
  // An exception ends the loading, not the manager.
  void onInit() override {
    try {
      node_ = std::make_unique<LiveNode>(sensor, getMTNodeHandle(), getMTPrivateNodeHandle());
    } catch (const std::exception& error) {
      NODELET_FATAL_STREAM(error.what());
      throw;
    }
  }

  std::unique_ptr<LiveNode> node_;
};

using StereoNodelet = MultimotionNodelet<Sensor::kStereo>;
using RgbdNodelet = MultimotionNodelet<Sensor::kRgbd>;

}  // namespace mvo_ros

PLUGINLIB_EXPORT_CLASS(mvo_ros::StereoNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(mvo_ros::RgbdNodelet, nodelet::Nodelet)
