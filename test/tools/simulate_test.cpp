// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// rosrun mvo simulate as its user meets it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "support/temporary_folder.hpp"
#include "support/tool_run.hpp"

namespace mvo {
namespace {

using test::contentOf;
using test::runTool;
using test::TemporaryFolder;
using test::ToolRun;

ToolRun simulate(const std::string& arguments) {
  return runTool(std::string(MVO_SIMULATE_TOOL) + " " + arguments + " --quiet --frames 1");
}

TEST(Simulate, SceneBringsItsCameraSizeAndRate) {
  const TemporaryFolder scratch;
  ASSERT_EQ(simulate("street --folder " + (scratch / "street").string()).exit_code, 0);
  const auto street = nlohmann::json::parse(contentOf(scratch / "street/calib.json"));
  EXPECT_EQ(street["width"], 1241);
  EXPECT_EQ(street["height"], 376);
  EXPECT_EQ(street["fps"], 10);
  EXPECT_NEAR(street["fx"], 718.9, 1e-6);
  ASSERT_EQ(
      simulate("street --width 310 --rate 20 --folder " + (scratch / "small").string()).exit_code,
      0);
  const auto small = nlohmann::json::parse(contentOf(scratch / "small/calib.json"));
  EXPECT_EQ(small["width"], 310);
  EXPECT_EQ(small["height"], 376);
  EXPECT_EQ(small["fps"], 20);
}

TEST(Simulate, ImperfectionsAreInTheImagesAndNotInTheCalibration) {
  const TemporaryFolder scratch;
  const auto folder = [&](const std::string& name, const std::string& options) {
    const ToolRun run = simulate("blocks --width 160 --height 120 --folder " +
                                 (scratch / name).string() + " " + options);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return scratch / name;
  };
  const auto exact = folder("exact", "");
  const auto turned = folder("turned", "--right_yaw 0.4 --right_delay=0.003");
  for (const char* same : {"calib.json", "left/000000.png", "truth/camera.tum",
                           "truth/masks/000000.png", "truth/objects.csv"})
    EXPECT_EQ(contentOf(exact / same), contentOf(turned / same)) << same;
  EXPECT_NE(contentOf(exact / "right/000000.png"), contentOf(turned / "right/000000.png"));
}

TEST(Simulate, BadOptionsAreNamed) {
  const TemporaryFolder scratch;
  const std::string folder = " --folder " + (scratch / "none").string();
  const ToolRun turned = simulate("blocks --right_yaw 9" + folder);
  EXPECT_NE(turned.exit_code, 0);
  EXPECT_EQ(turned.err, "simulate: option right_yaw is '9', it must be in [-5, 5] deg\n");
  const ToolRun unknown = simulate("moon" + folder);
  EXPECT_NE(unknown.exit_code, 0);
  EXPECT_NE(unknown.err.find("unknown scene \"moon\", known are: blocks"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(scratch / "none"));
}

}  // namespace
}  // namespace mvo
