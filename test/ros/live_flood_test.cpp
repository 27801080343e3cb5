// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A camera far faster than the machine: the node stays current and small.
#include <gtest/gtest.h>
#include <ros/master.h>
#include <ros/network.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include <fstream>

#include "support/live_run.hpp"

namespace mvo_ros {
namespace {

using mvo::test::eventually;

constexpr std::size_t kFrames = 60;
constexpr double kRate = 200;  // Hz

// The process of a node, asked of the node itself.
int processOf(const std::string& node) {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue payload;
  request[0] = "/test";
  request[1] = node;
  if (!ros::master::execute("lookupNode", request, response, payload, false)) return 0;
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(static_cast<std::string>(payload), host, port)) return 0;
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue caller;
  caller[0] = "/test";
  if (!client.execute("getPid", caller, response)) return 0;
  return static_cast<int>(response[2]);
}

// Memory in use [MB].
double residentMegabytes(int process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  std::string word;
  while (status >> word)
    if (word == "VmRSS:") {
      double kilobytes = 0;
      status >> kilobytes;
      return kilobytes / 1024;
    }
  return 0;
}

TEST(LiveFlood, TheNodeStaysCurrentAndSmall) {
  mvo::test::LiveRun live("/mvo", mvo::test::CameraTopics::stereo());
  mvo::sim::SceneOptions options;
  options.rate_hz = 60;
  const auto recording = mvo::test::recordBlocks(kFrames, options);
  std::vector<mvo::test::CameraSet> sets;
  for (std::size_t k = 0; k < kFrames; ++k) sets.push_back(mvo::test::stereoSet(recording, k));
  for (std::size_t k = kFrames - 1; k-- > 1;) sets.push_back(mvo::test::stereoSet(recording, k));
  ASSERT_TRUE(live.connected());
  const int process = processOf("/mvo");
  ASSERT_GT(process, 0);

  std::size_t published = 0;
  const auto dropped = [&live] {
    const std::string text = live.diagnostics.value("frames dropped");
    return text.empty() ? 0 : std::stoi(text);
  };
  // Keeps the camera's pace, or as fast as this machine can.
  const auto flood = [&](const std::function<bool()>& until) {
    ros::SteadyTime next = ros::SteadyTime::now();
    return eventually([&] {
      if (ros::SteadyTime::now() >= next) {
        mvo::test::CameraSet& set = sets[published++ % sets.size()];
        stamp(set, ros::Time::now());
        live.camera.publish(set);
        next += ros::WallDuration(1 / kRate);
      }
      return until();
    });
  };
  ASSERT_TRUE(flood([&] { return live.motions.size() >= 20 && dropped() > 0; }));
  const double before = residentMegabytes(process);
  ASSERT_GT(before, 0);
  const std::size_t until = published + 600;
  const std::size_t first = live.motions.size();
  ASSERT_TRUE(flood([&] { return published >= until; }));
  const ros::Time last_stamp = sets[(published - 1) % sets.size()].left.header.stamp;

  // Nothing is left to work off: the newest frame comes out within a few steps of the last one.
  const std::size_t outputs = live.motions.size();
  ASSERT_GT(outputs, first);
  EXPECT_TRUE(eventually([&] { return live.motions.last()->header.stamp == last_stamp; }));
  EXPECT_LE(live.motions.size() - outputs, 12U)
      << "after the last frame was sent: those in work and in the transport";
  EXPECT_LT(live.motions.size(), published);
  EXPECT_TRUE(eventually([&] {
    return live.diagnostics.value("frames") == std::to_string(live.motions.size()) && dropped() > 0;
  }));
  EXPECT_LT(residentMegabytes(process) - before, 100);
  const auto motions = live.motions.all();
  for (std::size_t i = 1; i < motions.size(); ++i)
    EXPECT_LT(motions[i - 1]->header.stamp, motions[i]->header.stamp);
}

}  // namespace
}  // namespace mvo_ros
