// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The bag tool as its user meets it: files, exit codes and sentences.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>

#include "io/labels_csv.hpp"
#include "io/stamp.hpp"
#include "io/timing_csv.hpp"
#include "mvo/trajectory_files.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_bag.hpp"
#include "tools/bag/bag_cli.hpp"
#include "tools/bag/bag_run.hpp"

namespace mvo::test {
namespace {

namespace fs = std::filesystem;

struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

std::string contentOf(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

class BagTool : public ::testing::Test {
 protected:
  // What main() does, without the cost of a process.
  static Outcome run(const std::string& arguments) {
    std::istringstream stream("bag " + arguments);
    const std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
    std::vector<const char*> argv;
    for (const std::string& word : words) argv.push_back(word.c_str());
    Outcome outcome{0, "", ""};
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    try {
      const auto command = mvo_tools::parseBagCommand(static_cast<int>(argv.size()), argv.data());
      if (command) mvo_tools::runBag(*command, [] { return false; });
    } catch (const std::exception& error) {
      std::cerr << "bag: " << error.what() << '\n';
      outcome.exit_code = 1;
    }
    outcome.out = ::testing::internal::GetCapturedStdout();
    outcome.err = ::testing::internal::GetCapturedStderr();
    return outcome;
  }

  // The tool itself; a signal is sent once it is at work.
  Outcome runProcess(const std::vector<std::string>& words, int signal_number = 0) const {
    std::vector<char*> argv = {const_cast<char*>("bag")};
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    const fs::path err = scratch_ / "stderr";
    const pid_t child = fork();
    if (child == 0) {
      if (std::freopen(err.c_str(), "w", stderr) != nullptr) execv(MVO_BAG_TOOL, argv.data());
      _exit(99);
    }
    if (signal_number != 0) {
      const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
      while (folder_.files().empty() && std::chrono::steady_clock::now() < deadline)
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      EXPECT_FALSE(folder_.files().empty());
      kill(child, signal_number);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, "", contentOf(err)};
  }

  // Not zero, one sentence that holds the words, nothing written.
  void expectRefused(const std::string& arguments, const std::vector<std::string>& words) const {
    const auto before = folder_.files();
    const Outcome outcome = run(arguments + " --quiet");
    EXPECT_EQ(outcome.exit_code, 1) << arguments;
    const std::string last = lastLine(outcome.err);
    EXPECT_EQ(last.substr(0, 5), "bag: ") << outcome.err;
    for (const std::string& word : words)
      EXPECT_NE(last.find(word), std::string::npos) << last << "\nlacks: " << word;
    EXPECT_EQ(folder_.files(), before) << arguments;
  }

  static std::string lastLine(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    std::string last;
    while (std::getline(lines, line)) last = line;
    return last;
  }

  std::string slidingBag(int frames) const {
    return writeSlidingBag(scratch_ / "slide.bag", frames);
  }

  std::string bagOfPairs(const std::vector<std::pair<cv::Mat, cv::Mat>>& pairs) const {
    TestBag bag(scratch_ / "pairs.bag");
    writeInfos(bag);
    for (std::size_t k = 0; k < pairs.size(); ++k)
      writePair(bag, stampOf(static_cast<int>(k)), pairs[k].first, pairs[k].second);
    bag.close();
    return bag.path();
  }

  std::string output() const { return (folder_ / "run").string(); }
  nlohmann::json summary() const {
    return nlohmann::json::parse(contentOf(folder_ / "run" / "summary.json"));
  }

  TemporaryFolder folder_;   // for output, nothing else
  TemporaryFolder scratch_;  // for input
};

void expectSlides(const std::vector<StampedPose>& poses, int frames) {
  ASSERT_EQ(poses.size(), static_cast<std::size_t>(frames));
  for (int k = 0; k < frames; ++k) {
    EXPECT_EQ(poses[k].stamp_ns, 100'000'000'000 + k * 100'000'000LL);
    EXPECT_NEAR(poses[k].T_world_body.translation().x(), k * kStep, 0.002) << k;
    EXPECT_NEAR(poses[k].T_world_body.translation().y(), 0, 0.002) << k;
    EXPECT_NEAR(poses[k].T_world_body.translation().z(), 0, 0.005) << k;
  }
}

TEST_F(BagTool, LooksAtNothingThatTheMaskLeavesOut) {
  constexpr int kFrames = 4;
  const std::string bag = slidingBag(kFrames);
  cv::Mat mask(kHeight, kWidth, CV_8U, cv::Scalar(255));
  mask.rowRange(kHeight / 2, kHeight).setTo(0);
  const std::string path = scratch_ / "mask.png";
  cv::imwrite(path, mask);
  const Outcome outcome = run(bag + " --output " + output() + " --mask " + path);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto labels = readLabels(folder_ / "run" / "labels.csv");
  EXPECT_GT(labels.size(), 100U);
  for (const LabelRow& row : labels) EXPECT_LT(row.v, kHeight / 2);
  expectSlides(readTum(folder_ / "run" / "camera.tum"), kFrames);
}

TEST_F(BagTool, MasksThatDoNotFitAreNamed) {
  const std::string arguments = slidingBag(2) + " --output " + output() + " --mask ";
  const std::string path = scratch_ / "mask.png";
  expectRefused(arguments + path, {path, "there is no such file"});
  cv::imwrite(path, cv::Mat::ones(48, 64, CV_8U));
  expectRefused(arguments + path,
                {path, "64x48", std::to_string(kWidth) + "x" + std::to_string(kHeight)});
}

TEST_F(BagTool, WritesTrajectoriesLabelsTimingsAndSummary) {
  constexpr int kFrames = 6;
  const Outcome outcome = run(slidingBag(kFrames) + " --output " + output());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("100 %  6/6 frames"), std::string::npos) << outcome.err;
  EXPECT_EQ(folder_.files(), std::vector<std::string>{"run"});  // nothing temporary is left

  expectSlides(readTum(folder_ / "run" / "camera.tum"), kFrames);

  const auto labels = readLabels(folder_ / "run" / "labels.csv");
  EXPECT_GT(labels.size(), 500U);
  std::set<std::int64_t> labelled;
  int moving = 0;
  for (const LabelRow& row : labels) {
    labelled.insert(row.stamp_ns);
    moving += row.motion_id > 0;
  }
  EXPECT_EQ(labelled.size(), kFrames - 1U);  // the first frame has no tracklet of length 2
  EXPECT_EQ(moving, 0);

  std::map<std::string, int> stages;
  for (const TimingRow& row : readTimings(folder_ / "run" / "timing.csv")) ++stages[row.stage];
  for (const std::string stage : {"decode", "rectify", "track", "total"})
    EXPECT_EQ(stages[stage], kFrames) << stage;

  const auto report = summary();
  EXPECT_EQ(report["frames"], kFrames);
  EXPECT_EQ(report["estimated"], kFrames);
  EXPECT_EQ(report["without_estimate"], 0);
  EXPECT_EQ(report["unpaired_images"], 0);
  EXPECT_EQ(report["frames_of_motion"], nlohmann::json({{"0", kFrames}}));
  EXPECT_EQ(report["options"]["window.frames"], "48");
  EXPECT_GT(report["step_ms"]["median"], 0);
  const auto& errors = report["camera_errors"];
  EXPECT_FALSE(errors["significant"]) << errors;
  EXPECT_LT(std::abs(errors["disparity_px"]["value"].get<double>()), 0.5);
  EXPECT_GT(errors["disparity_px"]["sd"], 0);
  EXPECT_EQ(errors["terms"].size(), 13U);
  EXPECT_EQ(errors["terms"]["delay"]["unit"], "s");
  EXPECT_TRUE(report["versions"].contains("ceres"));
}

// The right image one row lower than the calibration says.
TEST_F(BagTool, SaysThatTheRightCameraLooksElsewhere) {
  std::vector<std::pair<cv::Mat, cv::Mat>> pairs;
  for (int k = 0; k < 6; ++k) {
    cv::Mat lower;
    cv::copyMakeBorder(slidingView(k, 1).rowRange(0, kHeight - 1), lower, 1, 0, 0, 0,
                       cv::BORDER_REPLICATE);
    pairs.emplace_back(slidingView(k, 0), lower);
  }
  const std::string bag = bagOfPairs(pairs);
  const Outcome outcome = run(bag + " -o " + output());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto errors = summary()["camera_errors"];
  EXPECT_TRUE(errors["significant"]) << errors;
  EXPECT_NEAR(errors["rows_px"]["value"].get<double>(), 1, 0.1);
  const std::string advice = errors["advice"];
  EXPECT_NE(advice.find("upwards"), std::string::npos) << advice;
  EXPECT_EQ(lastLine(outcome.err), "bag: " + advice);
  const std::string twin = (folder_ / "twin").string();
  EXPECT_EQ(run(bag + " --quiet -o " + twin).err, "");
  EXPECT_EQ(run(bag + " --camera.errors off -o " + twin + " --force").exit_code, 0);
  EXPECT_FALSE(nlohmann::json::parse(contentOf(folder_ / "twin" / "summary.json"))
                   .contains("camera_errors"));
}

TEST_F(BagTool, GoesOnFromWhatAnEarlierRunLearntOfTheCamera) {
  const std::string bag = slidingBag(4);
  const std::string file = (folder_ / "pair.json").string();
  ASSERT_EQ(run(bag + " --quiet --save-camera-errors " + file + " -o " + output()).exit_code, 0);
  const double first = summary()["camera_errors"]["disparity_px"]["sd"];
  const std::string start = bag + " --camera-errors " + file + " -o ";
  ASSERT_EQ(run(start + output() + " --quiet --force").exit_code, 0);
  EXPECT_LT(summary()["camera_errors"]["disparity_px"]["sd"], 0.95 * first);

  const std::string other = (folder_ / "other").string();
  expectRefused(bag + " --save-camera-errors " + file + " -o " + other, {file, "--force"});
  EXPECT_EQ(run(start + other + " --quiet --save-camera-errors " + file).exit_code, 0);
  const std::string inside = (folder_ / "inside").string();
  EXPECT_EQ(run(bag + " --quiet -o " + inside + " --save-camera-errors " + inside + "/pair.json")
                .exit_code,
            0);
  EXPECT_FALSE(contentOf(folder_ / "inside" / "pair.json").empty());
  expectRefused(bag + " --save-camera-errors " + file + "/a.json -o " + (folder_ / "x").string(),
                {"--save-camera-errors", "pair.json is no folder"});
  expectRefused(start + (folder_ / "x").string() + " --camera.errors off",
                {"--camera-errors", "--camera.errors auto"});
  expectRefused(start + (folder_ / "x").string() + " --input rgbd",
                {"--camera-errors", "--input stereo"});
  std::string text = contentOf(file);
  const std::size_t place = text.find("250.0");
  ASSERT_NE(place, std::string::npos) << text;
  std::ofstream(file) << text.replace(place, 5, "251.0");
  expectRefused(start + (folder_ / "x").string(),
                {file, "another camera: its fx is 251, this camera's is 250"});
  expectRefused(bag + " --camera-errors " + file + ".none -o " + (folder_ / "x").string(),
                {"cannot read", ".none"});
}

TEST_F(BagTool, SameBagSameBytes) {
  const std::string bag = slidingBag(5);
  ASSERT_EQ(run(bag + " --quiet -o " + output()).exit_code, 0);
  for (const std::string threads : {"1", "2", "3"}) {
    const auto twin = folder_ / ("threads_" + threads);
    std::string arguments = bag;
    arguments.append(" --quiet --threads ").append(threads).append(" -o ").append(twin.string());
    ASSERT_EQ(run(arguments).exit_code, 0);
    for (const char* name : {"camera.tum", "labels.csv"})
      EXPECT_EQ(contentOf(folder_ / "run" / name), contentOf(twin / name)) << name;
    EXPECT_EQ(nlohmann::json::parse(contentOf(twin / "summary.json"))["threads"],
              std::stoi(threads));
  }
}

TEST_F(BagTool, SmoothedPosesAreThoseOfTheLastWindow) {
  const std::string bag = slidingBag(6);
  ASSERT_EQ(run(bag + " --quiet -o " + output()).exit_code, 0);
  const auto smoothed = folder_ / "smoothed";
  ASSERT_EQ(run(bag + " --quiet --smoothed -o " + smoothed.string()).exit_code, 0);
  expectSlides(readTum(smoothed / "camera.tum"), 6);
  EXPECT_NE(contentOf(smoothed / "camera.tum"), contentOf(folder_ / "run" / "camera.tum"));
  EXPECT_EQ(contentOf(smoothed / "labels.csv"), contentOf(folder_ / "run" / "labels.csv"));
}

TEST_F(BagTool, ReadsRgbdAlsoWithHoles) {
  TestBag bag(scratch_ / "rgbd.bag");
  bag.write("/camera/rgb/camera_info", kFirstStamp, cameraInfo(0));
  cv::Mat depth;
  slidingDepth().convertTo(depth, CV_16U, 1000);
  depth(cv::Rect(100, 60, 80, 60)).setTo(0);
  for (int k = 0; k < 5; ++k) {
    bag.write("/camera/rgb/image_rect_color", stampOf(k), imageMessage(slidingView(k, 0), "mono8"));
    bag.write("/camera/depth_registered/image_rect", stampOf(k), imageMessage(depth, "16UC1"));
  }
  bag.close();
  const Outcome outcome = run(bag.path() + " --input rgbd --quiet -o " + output());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expectSlides(readTum(folder_ / "run" / "camera.tum"), 5);
}

TEST_F(BagTool, TopicsCanBeNamedAndTheirCalibrationIsBesideThem) {
  TestBag bag(scratch_ / "named.bag");
  for (const auto& [side, eye] : {std::pair("/rig/a", 0), std::pair("/rig/b", 1)}) {
    bag.write(std::string(side) + "/camera_info", kFirstStamp, cameraInfo(eye * kBaseline));
    for (int k = 0; k < 3; ++k)
      bag.write(std::string(side) + "/image", stampOf(k),
                imageMessage(slidingView(k, eye), "mono8"));
  }
  bag.close();
  const Outcome outcome =
      run(bag.path() + " --left /rig/a/image --right /rig/b/image --quiet -o " + output());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST_F(BagTool, DrawsVideoAndPictures) {
  const Outcome outcome = run(slidingBag(3) + " --quiet -o " + output() + " --overlay " + output() +
                              "/slide.mp4 --overlay-frames " + (folder_ / "png").string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(folder_.files(), (std::vector<std::string>{"png", "run"}));
  EXPECT_GT(fs::file_size(folder_ / "run" / "slide.mp4"), 10'000U);
  cv::Mat picture;
  for (const char* name : {"000000.png", "000001.png", "000002.png"}) {
    picture = cv::imread((folder_ / "png" / name).string());
    EXPECT_EQ(picture.size(), cv::Size(960, 752)) << name;
  }
  expectRefused(slidingBag(3) + " -o " + (folder_ / "b").string() + " --overlay " +
                    (folder_ / "b.txt").string(),
                {"overlay video", ".mp4"});
}

TEST_F(BagTool, MeasuresTheYardstick) {
  ASSERT_EQ(run(slidingBag(3) + " --yardstick --quiet -o " + output()).exit_code, 0);
  const auto yardstick = summary()["yardstick"];
  EXPECT_GT(yardstick["Y_ms"], 0);
  EXPECT_GT(yardstick["median_step_over_Y"], 0);
}

TEST_F(BagTool, GoesOnAfterFramesWithoutEstimate) {
  const cv::Mat black = cv::Mat::zeros(kHeight, kWidth, CV_8U);
  std::vector<std::pair<cv::Mat, cv::Mat>> pairs;
  for (int k = 0; k < 8; ++k) pairs.emplace_back(slidingView(k, 0), slidingView(k, 1));
  pairs[4] = {black, black};
  const Outcome outcome = run(bagOfPairs(pairs) + " --quiet -o " + output());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("bag: no estimate in frame 4: "), std::string::npos) << outcome.err;
  const auto report = summary();
  EXPECT_EQ(report["frames"], 8);
  EXPECT_GE(report["without_estimate"], 1);
  EXPECT_FALSE(report["problems"].empty());
  ASSERT_EQ(report["notices"].size(), 1U) << report["notices"];
  EXPECT_GT(report["notices"].front().front(), 4) << "the frame in which it is found again";
  EXPECT_LE(report["world_changes"], 1);
  const auto poses = readTum(folder_ / "run" / "camera.tum");
  EXPECT_EQ(poses.size(), report["estimated"].get<std::size_t>());
  for (const StampedPose& pose : poses) EXPECT_NE(formatStamp(pose.stamp_ns), "100.400000000");
}

TEST_F(BagTool, RefusesImagesThatShowNothing) {
  const auto constant = [](int grey) { return cv::Mat(kHeight, kWidth, CV_8U, cv::Scalar(grey)); };
  for (const int grey : {0, 128, 255}) {
    const std::vector<std::pair<cv::Mat, cv::Mat>> pairs(4, {constant(grey), constant(grey)});
    expectRefused(bagOfPairs(pairs) + " -o " + output(),
                  {"pairs.bag: no estimate in any of 4 frames"});
  }
  std::vector<std::pair<cv::Mat, cv::Mat>> identical;
  for (int k = 0; k < 4; ++k) identical.emplace_back(slidingView(k, 0), slidingView(k, 0));
  expectRefused(bagOfPairs(identical) + " -o " + output(), {"no estimate in any of 4 frames"});
}

TEST_F(BagTool, RefusesDepthThatIsAllHoles) {
  TestBag bag(scratch_ / "holes.bag");
  bag.write("/camera/rgb/camera_info", kFirstStamp, cameraInfo(0));
  const cv::Mat holes(kHeight, kWidth, CV_32F,
                      cv::Scalar::all(std::numeric_limits<double>::quiet_NaN()));
  for (int k = 0; k < 4; ++k) {
    bag.write("/camera/rgb/image_rect_color", stampOf(k), imageMessage(slidingView(k, 0), "mono8"));
    bag.write("/camera/depth_registered/image_rect", stampOf(k), imageMessage(holes, "32FC1"));
  }
  bag.close();
  expectRefused(bag.path() + " --input rgbd -o " + output(), {"no estimate in any of 4 frames"});
}

TEST_F(BagTool, RefusesBadInputFiles) {
  const std::string to = " -o " + output();
  expectRefused((scratch_ / "none.bag").string() + to, {"none.bag does not exist"});
  std::ofstream(scratch_ / "text.bag") << "not a bag\n";
  expectRefused((scratch_ / "text.bag").string() + to, {"text.bag is not a bag"});
  const std::string bag = slidingBag(3);
  expectRefused(bag + " --raw" + to,
                {"topic /stereo/left/image_raw is not in", "/stereo/left/image_rect"});
  expectRefused(bag + " --start 60" + to, {"--start", "60"});
  fs::resize_file(bag, fs::file_size(bag) / 2);
  expectRefused(bag + to, {"slide.bag", "cut off"});
}

TEST_F(BagTool, SaysWhenNoImagesArePaired) {
  TestBag bag(scratch_ / "skewed.bag");
  writeInfos(bag);
  for (int k = 0; k < 3; ++k) {
    bag.write("/stereo/left/image_rect", stampOf(k), imageMessage(slidingView(k, 0), "mono8"));
    bag.write("/stereo/right/image_rect", stampOf(k) + 0.01,
              imageMessage(slidingView(k, 1), "mono8"));
  }
  bag.close();
  expectRefused(bag.path() + " -o " + output(),
                {"none of 6 images has a partner", "--sync-tolerance"});
  EXPECT_EQ(run(bag.path() + " --sync-tolerance 0.02 --quiet -o " + output()).exit_code, 0);
}

TEST_F(BagTool, RefusesBadOptions) {
  const std::string bag = slidingBag(3);
  const std::string start = bag + " -o " + output() + " ";
  expectRefused("", {"INPUT.bag", "required"});
  expectRefused(bag, {"--output is required"});
  expectRefused(start + "--speed 3", {"--speed"});
  expectRefused(start + "--window.frames 2", {"window.frames", "'2'", "[3, 500]"});
  expectRefused(start + "--window.frames many", {"window.frames", "'many'", "[3, 500]"});
  expectRefused(start + "--solver magic", {"engine.solver", "'magic'", "coral"});
  expectRefused(start + "--engine magic", {"engine.engine", "'magic'", "sequential_ransac"});
  expectRefused(start + "--profile mine", {"mine", "paper"});
  expectRefused(start + "--input lidar", {"--input", "'lidar'", "rgbd"});
  expectRefused(start + "--start -1", {"--start", "-1", "at least 0"});
  expectRefused(start + "--duration 0", {"--duration", "above 0"});
  expectRefused(start + "--depth /d", {"--depth", "--input rgbd"});
}

TEST_F(BagTool, ReadsOptionsFromFiles) {
  const std::string start = slidingBag(3) + " --quiet --force -o " + output() + " --config ";
  const auto file = [this](const std::string& name, const std::string& text) {
    std::ofstream(scratch_ / name) << text;
    return (scratch_ / name).string();
  };
  const auto frames = [&](const std::string& arguments) {
    const Outcome outcome = run(start + arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return summary()["options"]["window.frames"].get<std::string>();
  };
  EXPECT_EQ(frames(file("a.json", R"({"window": {"frames": 20}, "engine.solver": "coral"})")),
            "20");
  EXPECT_EQ(summary()["options"]["engine.solver"], "coral");
  fs::copy_file(folder_ / "run" / "summary.json", scratch_ / "earlier.json");
  EXPECT_EQ(frames((scratch_ / "earlier.json").string()), "20");
  EXPECT_EQ(frames((scratch_ / "earlier.json").string() + " --window.frames 30"), "30");
  EXPECT_EQ(frames(file("b.ini", "# a comment\n[window]\nframes = 21\n")), "21");
  EXPECT_EQ(frames(file("c.yaml", "window.frames: 22\n")), "22");

  expectRefused(start + file("d.ini", "window.size = 3\n"), {"d.ini", "window.size"});
  expectRefused(start + file("e.json", R"({"window": )"), {"e.json"});
  expectRefused(start + file("f.ini", "window.frames = 1\n"),
                {"f.ini", "window.frames", "[3, 500]"});
  expectRefused(start + (scratch_ / "none.ini").string(), {"none.ini", "cannot be read"});
}

TEST_F(BagTool, ReplaysWithTheParametersOfALiveNode) {
  const std::string start = slidingBag(3) + " --force -o " + output() + " --config ";
  const auto run_with = [&](const std::string& arguments) {
    const Outcome outcome = run(start + arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.err;
  };
  // As it is shipped, and with one line changed.
  const std::string shipped = MVO_CONFIG "/mvo.yaml";
  const std::string said = run_with(shipped);
  EXPECT_NE(said.find("mvo.yaml': passed over, as only the live node has them: odom_frame, "),
            std::string::npos)
      << said;
  EXPECT_EQ(said.find("window"), std::string::npos) << said;
  EXPECT_EQ(run_with(shipped + " --quiet"), "");
  std::string text = contentOf(shipped);
  const std::string line = "\n  threshold: 1.9\n";
  ASSERT_NE(text.find(line), std::string::npos);
  text.replace(text.find(line), line.size(), "\n  threshold: 2.25  # wider\n");
  std::ofstream(scratch_ / "mine.yaml") << text;
  run_with((scratch_ / "mine.yaml").string());
  EXPECT_EQ(summary()["options"]["energy.threshold"], "2.25");
  run_with(MVO_CONFIG "/paper.yaml");
  EXPECT_EQ(summary()["options"]["energy.label_cost"], "1000");

  // `rosparam dump` of the node's namespace: what was tuned live was in force.
  std::ofstream(scratch_ / "namespace.yaml") << R"(diagnostic_period: 1.0
energy: {label_cost: 20, adaptive: yes}
live: {energy_label_cost: 45.0, engine_min_frames: 4, publish_tf: true}
queue: all
segmentation:
  compressed: {formats: [jpeg, png]}
)";
  run_with((scratch_ / "namespace.yaml").string());
  EXPECT_EQ(summary()["options"]["energy.label_cost"], "45");
  EXPECT_EQ(summary()["options"]["engine.min_frames"], "4");
  // `dynparam dump` of the live settings.
  std::ofstream(scratch_ / "settings.yaml") << R"(energy_label_cost: 46.0
groups: !!python/object/new:dynamic_reconfigure.encoding.Config
  dictitems: {id: 0, parameters: !!python/object/new:dynamic_reconfigure.encoding.Config {}}
publish_tf: true
)";
  run_with((scratch_ / "settings.yaml").string());
  EXPECT_EQ(summary()["options"]["energy.label_cost"], "46");

  std::ofstream(scratch_ / "unknown.yaml") << "energy:\n  treshold: 2\n";
  expectRefused(start + (scratch_ / "unknown.yaml").string(),
                {"unknown.yaml", "'energy.treshold'", "energy.threshold"});
  std::ofstream(scratch_ / "broken.yaml") << "energy: [1, 2\n";
  expectRefused(start + (scratch_ / "broken.yaml").string(), {"broken.yaml"});
}

TEST_F(BagTool, KeepsExistingOutputUnlessForced) {
  const std::string start = slidingBag(3) + " --quiet -o " + output();
  ASSERT_EQ(run(start).exit_code, 0);
  const std::string first = contentOf(folder_ / "run" / "summary.json");
  expectRefused(start, {"run' exists already", "--force"});
  EXPECT_EQ(contentOf(folder_ / "run" / "summary.json"), first);
  std::ofstream(folder_ / "run" / "notes.txt") << "old";
  ASSERT_EQ(run(start + " --force --seed 5").exit_code, 0);
  EXPECT_EQ(summary()["options"]["seed"], "5");
  EXPECT_FALSE(fs::exists(folder_ / "run" / "notes.txt"));
  EXPECT_EQ(folder_.files(), std::vector<std::string>{"run"});
}

TEST_F(BagTool, NeverReplacesAFolderThatIsNoRun) {
  fs::create_directory(output());
  std::ofstream(folder_ / "run" / "thesis.tex") << "years";
  expectRefused(slidingBag(3) + " --force -o " + output(), {"is not replaced", "summary.json"});
  EXPECT_EQ(contentOf(folder_ / "run" / "thesis.tex"), "years");
}

TEST_F(BagTool, RefusesOutputThatCannotBeWritten) {
  std::ofstream(scratch_ / "file") << "no folder";
  expectRefused(slidingBag(3) + " -o " + (scratch_ / "file").string() + "/run",
                {"cannot be written", "file/run"});
  expectRefused(slidingBag(3) + " -o /proc/mvo_run", {"cannot be written", "/proc/mvo_run"});
}

TEST_F(BagTool, CreatesParentsOnlyForSuccess) {
  const std::string deep = (folder_ / "a").string() + "/b/run/";
  expectRefused((scratch_ / "none.bag").string() + " -o " + deep, {"does not exist"});
  const std::vector<std::pair<cv::Mat, cv::Mat>> black(
      2, {cv::Mat::zeros(kHeight, kWidth, CV_8U), cv::Mat::zeros(kHeight, kWidth, CV_8U)});
  expectRefused(bagOfPairs(black) + " -o " + deep, {"no estimate"});
  EXPECT_EQ(run(slidingBag(3) + " --quiet -o " + deep).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "a" / "b" / "run" / "camera.tum"));
}

TEST_F(BagTool, ProcessReportsByExitCode) {
  EXPECT_EQ(runProcess({slidingBag(3), "-o", output(), "--quiet"}).exit_code, 0);
  const Outcome refused = runProcess({slidingBag(3), "-o", output(), "--quiet"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_EQ(refused.err, "bag: output '" + output() + "' exists already (--force replaces it)\n");
}

TEST_F(BagTool, LeavesNothingBehindWhenInterrupted) {
  const std::string bag = slidingBag(150);
  for (const int number : {SIGINT, SIGTERM}) {
    const Outcome outcome = runProcess({bag, "-o", output(), "--quiet"}, number);
    EXPECT_EQ(outcome.exit_code, 128 + number);
    EXPECT_EQ(outcome.err, "bag: interrupted, nothing is written\n");
    EXPECT_TRUE(folder_.files().empty());
  }
}

TEST_F(BagTool, ExplainsItself) {
  const Outcome help = run("--help");
  EXPECT_EQ(help.exit_code, 0);
  for (const char* word : {"--output", "--raw", "--window.frames", "--profile", "Example"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  const Outcome table = run("--options");
  EXPECT_EQ(table.exit_code, 0);
  EXPECT_NE(table.out.find("energy.label_cost"), std::string::npos);
  EXPECT_NE(table.out.find("[3, 500]"), std::string::npos);
  EXPECT_EQ(run("--version").exit_code, 0);
}

}  // namespace
}  // namespace mvo::test
