// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/bag/truth_bag.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud.h>

#include <filesystem>

#include "mvo/sim.hpp"
#include "ros/bag/bag_frames.hpp"

namespace mvo_ros {
namespace {

class TruthBagTest : public testing::Test {
 protected:
  ~TruthBagTest() override { std::filesystem::remove(path_); }

  static mvo::sim::Scene scene(bool rgbd) {
    mvo::sim::SceneOptions options;
    options.width = 160;
    options.height = 120;
    options.rgbd = rgbd;
    return mvo::sim::makeScene("occlusion", 1, options);
  }

  void writeFrames(const mvo::sim::Scene& scene, int frames) const {
    TruthBag bag(path_, mvo::sim::sequenceInfo(scene));
    for (int i = 0; i < frames; ++i) bag.add(toSequenceFrame(mvo::sim::render(scene, i)));
    bag.close();
  }

  template <typename Message>
  std::vector<typename Message::ConstPtr> read(const std::string& topic) const {
    rosbag::Bag bag(path_, rosbag::bagmode::Read);
    rosbag::View view(bag, rosbag::TopicQuery(topic));
    std::vector<typename Message::ConstPtr> messages;
    for (const rosbag::MessageInstance& entry : view) {
      messages.push_back(entry.instantiate<Message>());
    }
    return messages;
  }

  std::string path_ = testing::TempDir() + "mvo_truth_bag_test.bag";
};

TEST_F(TruthBagTest, FramesComeBackAsTheyWereRendered) {
  const auto made = scene(false);
  writeFrames(made, 2);
  BagFrames frames(path_, {});
  EXPECT_DOUBLE_EQ(frames.camera().baseline, 0.24);
  EXPECT_DOUBLE_EQ(frames.camera().cu, made.camera.cu);
  frames.next();
  const auto second = frames.next();
  ASSERT_TRUE(second);
  const auto rendered = mvo::sim::render(made, 1);
  EXPECT_EQ(second->frame.stamp_ns, rendered.stamp_ns);
  EXPECT_EQ(cv::norm(second->frame.left, rendered.left, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(second->frame.right, rendered.right, cv::NORM_INF), 0);
  EXPECT_FALSE(frames.next());
}

TEST_F(TruthBagTest, RgbdComesBackInMetres) {
  const auto made = scene(true);
  writeFrames(made, 1);
  BagRequest request;
  request.setup.sensor = Sensor::kRgbd;
  request.setup.topics = usualTopics(Sensor::kRgbd, false);
  const auto frame = BagFrames(path_, request).next();
  ASSERT_TRUE(frame);
  const auto rendered = mvo::sim::render(made, 0);
  EXPECT_LE(cv::norm(frame->frame.depth, rendered.depth, cv::NORM_INF), 0.00051);
}

TEST_F(TruthBagTest, TruthHasPosesMasksAndVisibility) {
  const auto made = scene(false);
  writeFrames(made, 2);
  const auto rendered = mvo::sim::render(made, 1);

  const auto poses = read<geometry_msgs::PoseStamped>("/truth/object_2");
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[1]->header.stamp.toNSec(), static_cast<std::uint64_t>(rendered.stamp_ns));
  EXPECT_EQ(poses[1]->pose.position.x, rendered.T_world_bodies[1].translation().x());
  EXPECT_EQ(read<geometry_msgs::PoseStamped>("/truth/camera").size(), 2U);

  const auto masks = read<sensor_msgs::Image>("/truth/mask");
  ASSERT_EQ(masks.size(), 2U);
  EXPECT_EQ(masks[1]->encoding, "mono8");
  EXPECT_TRUE(std::equal(masks[1]->data.begin(), masks[1]->data.end(), rendered.mask.data));

  const auto objects = read<sensor_msgs::PointCloud>("/truth/objects");
  ASSERT_EQ(objects.size(), 2U);
  ASSERT_EQ(objects[1]->points.size(), 2U);
  const std::vector<std::string> names = {
      "frame",         "id",           "visible_px",  "visible_image_frac",
      "silhouette_px", "inframe_frac", "visible_frac"};
  ASSERT_EQ(objects[1]->channels.size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(objects[1]->channels[i].name, names[i]);
    EXPECT_EQ(objects[1]->channels[i].values.size(), 2U);
  }
  EXPECT_EQ(objects[1]->channels[0].values[0], 1);
  EXPECT_EQ(objects[1]->channels[1].values[1], 2);
  EXPECT_EQ(objects[1]->channels[2].values[1], rendered.objects[1].visible_px);
  EXPECT_FLOAT_EQ(objects[1]->channels[6].values[1],
                  static_cast<float>(rendered.objects[1].visible_share));
  const Eigen::Vector3d p_camera =
      rendered.T_world_camera.inverse() * rendered.T_world_bodies[1].translation();
  EXPECT_FLOAT_EQ(objects[1]->points[1].z, static_cast<float>(p_camera.z()));
}

TEST_F(TruthBagTest, UnwritablePathIsNamed) {
  try {
    const TruthBag bag("/no/such/folder/x.bag", {});
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/no/such/folder/x.bag"), std::string::npos);
  }
}

}  // namespace
}  // namespace mvo_ros
