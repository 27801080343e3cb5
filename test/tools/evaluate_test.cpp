// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// evaluate and import_dataset as their user meets them: files, exit codes and sentences.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "mvo/sequence.hpp"
#include "mvo/trajectory_files.hpp"
#include "support/labels_file.hpp"
#include "support/temporary_folder.hpp"
#include "support/tool_run.hpp"
#include "support/trajectories.hpp"

namespace mvo::test {
namespace {

namespace fs = std::filesystem;

constexpr bool kHasRos = MVO_HAS_ROS;  // without, there are neither bags nor plots
constexpr int kFrames = 6;
constexpr std::int64_t kStart = 1'500'000'000'000'000'000;
constexpr std::int64_t kPeriod = 100'000'000;

// A small sequence and the perfect estimate of it.
class Tools : public ::testing::Test {
 protected:
  void SetUp() override {
    SequenceInfo info;
    info.camera = {50, 50, 16, 12, 0.2, 32, 24};
    SequenceWriter writer(folder_ / "truth", info);
    const FramePoses camera = handheld(kFrames);
    FramePoses body;
    std::vector<LabelRow> labels;
    for (int k = 0; k < kFrames; ++k) {
      body.emplace_back(transform(0.1 * k, 0, 2));
      SequenceFrame frame;
      frame.stamp_ns = kStart + k * kPeriod;
      frame.left = frame.right = cv::Mat(24, 32, CV_8UC1, cv::Scalar(100));
      frame.T_world_camera = camera[k];
      frame.T_world_bodies[1] = *body[k];
      frame.mask = cv::Mat::zeros(24, 32, CV_8UC1);
      frame.mask.colRange(16, 32).setTo(1);
      frame.objects.push_back({1, 384, 0.5, 384, 1.0, 1.0});
      writer.add(frame);
      for (int i = 0; i < 8; ++i)
        labels.push_back({frame.stamp_ns, i, i < 4 ? 5. : 25., 12, i / 4});
    }
    writer.finish();
    fs::create_directories(folder_ / "estimate");
    writeTum(folder_ / "estimate/camera.tum", stamped(camera, kStart, kPeriod));
    writeTum(folder_ / "estimate/motion_1.tum", stamped(body, kStart, kPeriod));
    writeLabels(folder_ / "estimate/labels.csv", labels);
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  // Exit code 1, one sentence that holds the words, no new file.
  void expectRefused(const std::string& command, const std::string& words) const {
    const auto before = folder_.files();
    const ToolRun run = runTool(command);
    EXPECT_EQ(run.exit_code, 1) << command;
    EXPECT_NE(run.err.find(words), std::string::npos) << run.err << "\nlacks: " << words;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_EQ(folder_.files(), before) << command;
  }

  const std::string evaluate_ = MVO_EVALUATE_TOOL;
  const std::string import_ = MVO_IMPORT_DATASET_TOOL;
  TemporaryFolder folder_;
};

TEST_F(Tools, AFolderItsCopyAndItsBagAreTheSameTruth) {
  std::vector<std::string> truths{"truth", "copy"};
  if (kHasRos) truths.emplace_back("truth.bag");
  std::vector<nlohmann::json> figures;
  for (const std::string& truth : truths) {
    const std::string target = truth == "copy" ? " --folder " : " --bag ";
    if (truth != "truth") {
      const ToolRun imported =
          runTool(import_ + " sequence " + path("truth") + " --quiet" + target + path(truth));
      ASSERT_EQ(imported.exit_code, 0) << imported.err;
    }
    const ToolRun run = runTool(evaluate_ + " " + path("estimate") + " " + path(truth) +
                                " --json " + path("figures.json"));
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("right number in 100.0 % of 6 frames"), std::string::npos) << run.out;
    figures.push_back(nlohmann::json::parse(contentOf(path("figures.json"))));
    EXPECT_EQ(figures.back()["bodies"][0]["ids"], nlohmann::json({1}));
    EXPECT_NEAR(figures.back()["camera"]["errors"]["max_m"].get<double>(), 0, 1e-8);
    EXPECT_NEAR(figures.back()["bodies"][0]["errors"]["max_m"].get<double>(), 0, 1e-8);
    for (const char* key : {"motion_count", "static_world", "frames"})
      EXPECT_EQ(figures.front()[key], figures.back()[key]) << key;
  }
}

TEST_F(Tools, WithoutRosBagsAreRefused) {
  if (kHasRos) GTEST_SKIP() << "this build has ROS";
  expectRefused(import_ + " sequence " + path("truth") + " --quiet --bag " + path("out.bag"),
                "this build has no ROS");
}

TEST_F(Tools, HelpIsNoError) {
  for (const std::string& tool : {evaluate_, import_}) {
    const ToolRun run = runTool(tool + " --help");
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_NE(run.out.find("Usage"), std::string::npos) << run.out;
    EXPECT_TRUE(run.err.empty()) << run.err;
  }
}

TEST_F(Tools, EvaluateRefusesWhatItCannotRead) {
  const std::string json = " --json " + path("figures.json");
  expectRefused(evaluate_ + " " + path("truth") + " " + path("truth") + json,
                "holds no camera.tum");
  expectRefused(evaluate_ + " " + path("estimate") + " " + path("nothing") + json,
                "there is no " + path("nothing"));
  expectRefused(evaluate_ + " " + path("estimate") + " " + path("estimate") + json,
                "is not a sequence with a truth folder");
  expectRefused(evaluate_ + " " + path("estimate") + " " + path("estimate/camera.tum") + json,
                "cannot read the truth from");
  expectRefused(evaluate_ + " " + path("estimate"), "truth is required");
  expectRefused(evaluate_ + " a b --frames some", "--frames");
  expectRefused(evaluate_ + " --quiet " + path("estimate") + " " + path("truth") + " --json " +
                    path("nowhere/figures.json"),
                "cannot write " + path("nowhere/figures.json"));
  std::ofstream(path("truth/truth/body_boxes.csv"))
      << "frame,body,x1,y1,x2,y2,occluded_by\n0,A,1,2,x,4,\n";
  expectRefused(evaluate_ + " " + path("estimate") + " " + path("truth") + json,
                "body_boxes.csv:2: column 'x2': 'x' is not a finite number");
  fs::remove(path("truth/truth/body_boxes.csv"));
  std::ofstream(path("estimate/motion_1.tum")) << "1 2 3\n";
  expectRefused(evaluate_ + " " + path("estimate") + " " + path("truth") + json,
                "motion_1.tum:1: a pose has 8 numbers");
}

TEST_F(Tools, ImportRefusesWhatItCannotReadAndKeepsWhatIsThere) {
  if (!kHasRos) GTEST_SKIP() << "bags need ROS";
  const std::string bag = " --quiet --bag " + path("out.bag");
  expectRefused(import_ + " kitti " + path("truth") + bag,
                "cannot read " + path("truth/calib.txt"));
  expectRefused(import_ + " oxford " + path("truth") + bag, "stereo.csv");
  expectRefused(import_ + " euroc " + path("truth") + bag, "euroc");
  expectRefused(import_ + " sequence " + path("truth") + bag + " --first 6", "has 6 frames");
  std::ofstream(path("out.bag")) << "mine";
  expectRefused(import_ + " sequence " + path("truth") + bag, "--force");
  EXPECT_EQ(contentOf(path("out.bag")), "mine");
  fs::remove(path("truth/right/000003.png"));  // fails on the way
  expectRefused(import_ + " sequence " + path("truth") + bag + " --force", "right/000003");
  EXPECT_EQ(contentOf(path("out.bag")), "mine");
  EXPECT_EQ(runTool(import_ + " sequence " + path("truth") + bag + " --force --count 3").exit_code,
            0);
  EXPECT_NE(contentOf(path("out.bag")), "mine");
}

TEST_F(Tools, PlotsAreDrawn) {
  if (!kHasRos) GTEST_SKIP() << "the plotting script is part of the ROS package";
  const ToolRun run = runTool(evaluate_ + " " + path("estimate") + " " + path("truth") +
                              " --quiet --plot " + path("plots"));
  if (run.err.find("matplotlib") != std::string::npos) GTEST_SKIP() << run.err;
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* name : {"camera.png", "body_1.png", "motion_count.png", "evaluation.json"})
    EXPECT_TRUE(fs::exists(folder_ / "plots" / name)) << name;
}

}  // namespace
}  // namespace mvo::test
