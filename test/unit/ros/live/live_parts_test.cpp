// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The live node's parts that need no master: queue, watch, mount, log, health.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <future>

#include "edges/frame_queue.hpp"
#include "mvo/trajectory_files.hpp"
#include "ros/live/health.hpp"
#include "ros/live/input_watch.hpp"
#include "ros/live/trajectory_log.hpp"
#include "ros/sensor/mount.hpp"
#include "support/temporary_folder.hpp"

namespace mvo_ros {
namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(FrameQueue, KeepsTheNewestAndCountsTheOthers) {
  FrameQueue<int> queue(1);
  for (int i = 0; i < 5; ++i) queue.push(i);
  EXPECT_EQ(queue.pop(), 4);
  EXPECT_EQ(queue.dropped(), 4U);
  EXPECT_EQ(queue.size(), 0U);
}

TEST(FrameQueue, KeepsAllWithinItsLimitInOrder) {
  FrameQueue<int> queue(3);
  for (int i = 0; i < 4; ++i) queue.push(i);
  for (int i = 1; i < 4; ++i) EXPECT_EQ(queue.pop(), i);
  EXPECT_EQ(queue.dropped(), 1U);
}

// A call in another thread, and whether it waits: one that did not wait would be back long before.
class Call {
 public:
  explicit Call(std::function<void()> call)
      : done_(std::async(std::launch::async, [this, call = std::move(call)] {
          begun_.set_value();
          call();
        })) {}

  bool waits() {
    begun_.get_future().wait();
    return done_.wait_for(std::chrono::milliseconds(100)) == std::future_status::timeout;
  }
  bool returns() { return done_.wait_for(std::chrono::seconds(30)) == std::future_status::ready; }

 private:
  std::promise<void> begun_;
  std::future<void> done_;
};

TEST(FrameQueue, InTurnMeansWaitingForRoom) {
  FrameQueue<int> queue(1);
  queue.pushInTurn(0);
  Call second([&] { queue.pushInTurn(1); });
  EXPECT_TRUE(second.waits());
  EXPECT_EQ(queue.size(), 1U);
  EXPECT_EQ(queue.pop(), 0);  // makes room
  EXPECT_TRUE(second.returns());

  Call third([&] { queue.pushInTurn(2); });
  EXPECT_TRUE(third.waits());
  queue.clear();  // makes room
  EXPECT_TRUE(third.returns());
  EXPECT_EQ(queue.pop(), 2);
  EXPECT_EQ(queue.dropped(), 0U);
}

TEST(FrameQueue, ClosingWakesWhoWaits) {
  FrameQueue<int> empty(1);
  std::optional<int> popped = 7;
  Call pop([&] { popped = empty.pop(); });
  EXPECT_TRUE(pop.waits());
  empty.close();
  ASSERT_TRUE(pop.returns());
  EXPECT_FALSE(popped);
  empty.push(1);
  EXPECT_EQ(empty.size(), 0U);

  FrameQueue<int> full(1);
  full.push(3);
  Call push([&] { full.pushInTurn(4); });
  EXPECT_TRUE(push.waits());
  full.close();
  EXPECT_TRUE(push.returns());
  EXPECT_EQ(full.size(), 1U);
}

TEST(InputWatch, NamesTopicsPublishersCountsAndGaps) {
  InputWatch watch({"/left", "/right"}, 100);
  watch.message(0, 50.000);
  watch.message(0, 50.100);
  watch.message(1, 49.850);
  EXPECT_EQ(watch.silence(106), 6);
  const std::string report = watch.report({1, 0}, 106);
  EXPECT_TRUE(has(report, "for 6.0 s")) << report;
  EXPECT_TRUE(has(report, "/left: 1 publisher, 2 messages, stamp 0.000 s behind")) << report;
  EXPECT_TRUE(has(report, "/right: no publisher, 1 messages, stamp 0.250 s behind")) << report;
  EXPECT_TRUE(has(watch.report({1, 2}, 107), "/left: 1 publisher, 0 messages"));
  watch.completeSet(108);
  EXPECT_EQ(watch.silence(109), 1);
}

TEST(Mount, AloneTheOdometryFrameHasRosAxes) {
  const Mount mount = mountAlone("odom", "cam");
  EXPECT_EQ(mount.base_frame, "cam");
  EXPECT_TRUE((mount.T_odom_world * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE((mount.T_odom_world * Eigen::Vector3d::UnitX()).isApprox(-Eigen::Vector3d::UnitY()));
  EXPECT_NEAR(mount.T_odom_world.linear().determinant(), 1, 1e-12);
}

TEST(Mount, OnARobotTheBaseBeginsAtTheOrigin) {
  Eigen::Isometry3d T_base_camera = mountAlone("odom", "cam").T_odom_world;
  T_base_camera.translation() << 0.3, 0.1, 1.2;
  const Mount mount = mountOn("odom", "base_link", "cam", T_base_camera);
  EXPECT_TRUE((mount.T_odom_world * mount.T_camera_base).isApprox(Eigen::Isometry3d::Identity()));
}

class TrajectoryLogTest : public ::testing::Test {
 protected:
  Step stepAt(int k) {
    Step step;
    step.estimate.valid = true;
    step.estimate.stamp_ns = k * 100000000LL;
    mvo::MotionEstimate camera;
    camera.T_world_motion.translation().x() = k;
    step.estimate.motions.push_back(camera);
    if (k >= 5) {
      mvo::MotionEstimate body = camera;
      body.id = 3;
      step.estimate.motions.push_back(body);
    }
    return step;
  }

  mvo::test::TemporaryFolder folder_;
};

TEST_F(TrajectoryLogTest, SavesOneFilePerMotionAndOverwritesNone) {
  TrajectoryLog log(100);
  for (int k = 0; k < 10; ++k) log.add(stepAt(k));
  const std::string folder = folder_.path() / "new" / "run";
  EXPECT_EQ(log.save(folder).size(), 2U);
  EXPECT_EQ(mvo::readTum(folder + "/camera.tum").size(), 10U);
  EXPECT_EQ(mvo::readTum(folder + "/motion_3.tum").size(), 5U);
  try {
    log.save(folder);
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_TRUE(has(error.what(), "camera.tum exists and is not overwritten")) << error.what();
  }
}

TEST_F(TrajectoryLogTest, ForgetsWhatIsOldAndWhatWasBeforeAReset) {
  TrajectoryLog log(0.25);
  for (int k = 0; k < 10; ++k) log.add(stepAt(k));
  log.save(folder_.path() / "a");
  EXPECT_EQ(mvo::readTum(folder_.path() / "a" / "camera.tum").size(), 3U);
  Step restarted = stepAt(1);
  restarted.restarted = true;
  log.add(restarted);
  EXPECT_EQ(log.save(folder_.path() / "b").size(), 1U);
}

TEST_F(TrajectoryLogTest, RefusesRelativeAndImpossibleFolders) {
  TrajectoryLog log(100);
  EXPECT_THROW(log.save(folder_.path()), std::runtime_error);  // no poses
  log.add(stepAt(0));
  EXPECT_THROW(log.save("relative/folder"), std::runtime_error);
  EXPECT_THROW(log.save("/proc/no_such_folder"), std::runtime_error);
}

std::string summaryOf(Health& health, int* level = nullptr) {
  diagnostic_updater::DiagnosticStatusWrapper status;
  health.report(status);
  if (level != nullptr) *level = static_cast<unsigned char>(status.level);
  return status.message;
}

TEST(Health, SaysTheWorstFirst) {
  Health health;
  int level = -1;
  EXPECT_EQ(summaryOf(health, &level), "waiting for the first frame");
  EXPECT_EQ(level, diagnostic_msgs::DiagnosticStatus::OK);
  Step good;
  good.estimate.valid = true;
  good.total_ms = 20;
  good.period = 0.1;
  health.step(good, 0.02, 0.02);
  EXPECT_EQ(summaryOf(health, &level), "ok");

  Step slow = good;
  slow.total_ms = 150;
  slow.estimate.timings_ms = {{"track", 30}, {"batch", 110}, {"total", 140}};
  health.step(slow, 0.2, 0.2);
  health.step(good, 0.2, 0.2);
  const std::string overrun = summaryOf(health, &level);
  EXPECT_EQ(level, diagnostic_msgs::DiagnosticStatus::WARN);
  EXPECT_TRUE(has(overrun, "1 of 2 steps") && has(overrun, "stage batch")) << overrun;

  Step lost = good;
  lost.estimate.valid = false;
  lost.estimate.problem = "no texture";
  health.step(lost, 0.02, 0.02);
  EXPECT_EQ(summaryOf(health), "lost: no texture");
  health.silent("no synchronized set for 6.0 s");
  EXPECT_TRUE(has(summaryOf(health), "6.0 s"));
  health.refused("topic /left: bad");
  EXPECT_EQ(summaryOf(health, &level), "topic /left: bad");
  EXPECT_EQ(level, diagnostic_msgs::DiagnosticStatus::ERROR);
  health.silent("");
  health.step(good, 0.02, 0.02);
  EXPECT_EQ(summaryOf(health), "ok");
}

// Reports are rarer than frames.
TEST(Health, AnotherStaticWorldIsSaidOnce) {
  Health health;
  Step step;
  step.estimate.valid = true;
  step.estimate.world_changes = 1;
  step.notice = "another motion is the static world from here on";
  health.step(step, 0.02, 0.02);
  step.notice.clear();
  health.step(step, 0.02, 0.02);
  int level = -1;
  EXPECT_EQ(summaryOf(health, &level), "another motion is the static world from here on");
  EXPECT_EQ(level, diagnostic_msgs::DiagnosticStatus::WARN);
  health.step(step, 0.02, 0.02);
  EXPECT_EQ(summaryOf(health), "ok");
}

TEST(Health, AFrameThatWaitsIsNotRefused) {
  Health health;
  health.blocked("no transform to base_link");
  int level = -1;
  for (int report = 0; report < 2; ++report) {
    diagnostic_updater::DiagnosticStatusWrapper status;
    health.report(status);
    EXPECT_EQ(status.message, "no transform to base_link");
    EXPECT_EQ(status.level, diagnostic_msgs::DiagnosticStatus::ERROR);
    const auto refused = std::find_if(status.values.begin(), status.values.end(),
                                      [](const auto& v) { return v.key == "frames refused"; });
    ASSERT_NE(refused, status.values.end());
    EXPECT_EQ(refused->value, "0");
  }
  Step step;
  step.estimate.valid = true;
  health.step(step, 0.02, 0.02);
  EXPECT_EQ(summaryOf(health, &level), "ok");
  EXPECT_EQ(level, diagnostic_msgs::DiagnosticStatus::OK);
}

TEST(Health, SaysWhatTheLoadCosts) {
  Health health;
  Step step;
  step.estimate.valid = true;
  health.step(step, 0.02, 0.02);
  health.load(430, 700, 0);
  int level = -1;
  EXPECT_EQ(summaryOf(health, &level), "shedding: 430 of 700 features");
  EXPECT_EQ(level, diagnostic_msgs::DiagnosticStatus::WARN);
  step.estimate.cut_short.batch = true;
  health.step(step, 0.02, 0.02);
  EXPECT_EQ(summaryOf(health),
            "shedding: 430 of 700 features; 1 of 1 steps cut short by the time budget: batch");
  step.period = 0.1;
  step.total_ms = 120;
  health.step(step, 0.02, 0.02);
  EXPECT_TRUE(has(summaryOf(health), "1 of 1 steps took longer") &&
              has(summaryOf(health), "shedding: 430 of 700"))
      << "both";
  step.period.reset();
  step.estimate.cut_short = {};
  health.step(step, 0.02, 0.02);
  health.load(700, 700, 0);
  EXPECT_EQ(summaryOf(health, &level), "ok");
  EXPECT_EQ(level, diagnostic_msgs::DiagnosticStatus::OK);
}

TEST(Health, SaysWhatIsWrongWithThePairOfCameras) {
  Health health;
  Step step;
  step.estimate.valid = true;
  step.camera_errors.emplace();
  health.step(step, 0, 0);
  EXPECT_EQ(summaryOf(health), "ok");
  step.camera_errors->significant = true;
  step.camera_errors->advice = "the right camera looks elsewhere";
  step.camera_errors->disparity = {-0.4, 0.02};
  health.step(step, 0, 0);
  int level = -1;
  EXPECT_EQ(summaryOf(health, &level), "the right camera looks elsewhere");
  EXPECT_EQ(level, diagnostic_msgs::DiagnosticStatus::OK);
  step.camera_errors->disparity.value = -0.6;
  health.step(step, 0, 0);
  diagnostic_updater::DiagnosticStatusWrapper status;
  health.report(status);
  EXPECT_EQ(status.level, diagnostic_msgs::DiagnosticStatus::WARN);
  const auto value = std::find_if(status.values.begin(), status.values.end(),
                                  [](const auto& v) { return v.key == "camera disparity error"; });
  ASSERT_NE(value, status.values.end());
  EXPECT_EQ(value->value, "-0.600 +- 0.020 px");
  step.estimate.valid = false;
  step.estimate.problem = "no texture";
  health.step(step, 0, 0);
  EXPECT_EQ(summaryOf(health), "lost: no texture");
}

TEST(Health, ReportsAResetOnce) {
  Health health;
  Step step;
  step.estimate.valid = true;
  step.resets = 1;
  step.notice = "the world starts anew: time went back by 3 s";
  health.step(step, 0, 0);
  step.notice.clear();
  health.step(step, 0, 0);
  EXPECT_TRUE(has(summaryOf(health), "time went back"));
  EXPECT_EQ(summaryOf(health), "ok");
}

}  // namespace
}  // namespace mvo_ros
