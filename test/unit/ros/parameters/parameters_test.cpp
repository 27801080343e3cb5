// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/parameters/parameters.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "ros/live/live_settings.hpp"

namespace mvo_ros {
namespace {

std::string contentOf(const std::string& path) {
  std::ifstream stream(path);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::string refusalOf(const XmlRpc::XmlRpcValue& tree) {
  try {
    readParameters(tree);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Parameters, ShippedFilesAreWhatTheNodePrints) {
  EXPECT_EQ(contentOf(MVO_CONFIG "/mvo.yaml"), parametersYaml("default"));
  EXPECT_EQ(contentOf(MVO_CONFIG "/paper.yaml"), parametersYaml("paper"));
}

TEST(Parameters, NothingGivenIsTheDefault) {
  EXPECT_EQ(parametersText(readParameters(XmlRpc::XmlRpcValue())), parametersText(Parameters()));
}

TEST(Parameters, NestedKeysOfEveryTypeAreRead) {
  XmlRpc::XmlRpcValue tree;
  tree["base_frame"] = "base_link";
  tree["publish_tf"] = false;
  tree["queue"] = "all";
  tree["max_interval"] = 1;  // a whole number for a real one
  tree["window"]["frames"] = 24;
  tree["energy"]["threshold"] = 2.5;
  tree["engine"]["solver"] = "coral";
  tree["live"]["energy_threshold"] = 77.0;  // the settings' server's own
  tree["segmentation"]["compressed"]["jpeg_quality"] = 80;
  const Parameters p = readParameters(tree);
  EXPECT_EQ(p.node.base_frame, "base_link");
  EXPECT_FALSE(p.node.publish_tf);
  EXPECT_EQ(p.node.queue, QueuePolicy::kAll);
  EXPECT_EQ(p.node.max_interval, 1.0);
  EXPECT_EQ(p.method.window.frames, 24);
  EXPECT_EQ(p.method.energy.threshold, 2.5);
  EXPECT_EQ(p.method.engine.solver, mvo::Solver::kCoral);
}

TEST(Parameters, RefusalsNameKeyValueAndRange) {
  XmlRpc::XmlRpcValue unknown;
  unknown["energy"]["treshold"] = 2.0;
  EXPECT_TRUE(has(refusalOf(unknown), "'energy.treshold' (did you mean 'energy.threshold'?)"))
      << refusalOf(unknown);
  XmlRpc::XmlRpcValue type;
  type["window"]["frames"] = "many";
  EXPECT_TRUE(
      has(refusalOf(type), "window.frames is 'many', it must be a whole number in [3, 500]"))
      << refusalOf(type);
  XmlRpc::XmlRpcValue range;
  range["sync_queue"] = 0;
  EXPECT_TRUE(has(refusalOf(range), "sync_queue is '0', it must be a whole number in [1, 1000]"))
      << refusalOf(range);
  XmlRpc::XmlRpcValue list;
  list["odom_frame"][0] = 1;
  EXPECT_TRUE(has(refusalOf(list), "'odom_frame'")) << refusalOf(list);
  XmlRpc::XmlRpcValue frames;
  frames["base_frame"] = "odom";
  EXPECT_TRUE(has(refusalOf(frames), "base_frame is 'odom'")) << refusalOf(frames);
}

TEST(LiveSettings, DefaultsAndRangesAreThoseOfTheOptions) {
  const Parameters defaults;
  const mvo::MvoConfig cfg = mvo::MvoConfig::__getDefault__();
  EXPECT_EQ(parametersText(withLiveSettings(defaults, cfg)), parametersText(defaults));
  EXPECT_NO_THROW(withLiveSettings(defaults, mvo::MvoConfig::__getMin__()));
  EXPECT_NO_THROW(withLiveSettings(defaults, mvo::MvoConfig::__getMax__()));
}

TEST(LiveSettings, GoThereAndBack) {
  Parameters p;
  p.node.publish_path = false;
  p.method.energy.label_cost = 77;
  p.method.engine.min_frames = 9;
  EXPECT_EQ(parametersText(withLiveSettings(Parameters(), liveSettings(p))), parametersText(p));
}

}  // namespace
}  // namespace mvo_ros
