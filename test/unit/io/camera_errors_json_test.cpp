// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "mvo/camera_error_files.hpp"
#include "support/temporary_folder.hpp"
#include "support/tool_run.hpp"

namespace mvo::test {
namespace {

LearntCameraErrors someErrors() {
  LearntCameraErrors learnt;
  learnt.camera = {700.1, 700.2, 320.3, 240.4, 0.123456789012345, 640, 480};
  learnt.terms = {"turn", "delay"};
  learnt.mean = Eigen::Vector2d(1.0 / 3, -1e-7 / 3);
  learnt.covariance.resize(2, 2);
  learnt.covariance << 1e-5 / 3, 1e-9 / 7, 1e-9 / 7, 2e-6 / 3;
  return learnt;
}

TEST(CameraErrorFiles, ComeBackBitByBit) {
  const TemporaryFolder folder;
  const LearntCameraErrors written = someErrors();
  writeCameraErrors(folder / "camera.json", written);
  writeCameraErrors(folder / "camera.json", written);  // replaces
  EXPECT_EQ(folder.files(), std::vector<std::string>{"camera.json"});
  const LearntCameraErrors read = readCameraErrors(folder / "camera.json");
  EXPECT_EQ(read.terms, written.terms);
  EXPECT_EQ(read.mean, written.mean);
  EXPECT_EQ(read.covariance, written.covariance);
  EXPECT_EQ(read.camera.fu, written.camera.fu);
  EXPECT_EQ(read.camera.fv, written.camera.fv);
  EXPECT_EQ(read.camera.cu, written.camera.cu);
  EXPECT_EQ(read.camera.cv, written.camera.cv);
  EXPECT_EQ(read.camera.baseline, written.camera.baseline);
  EXPECT_EQ(read.camera.width, written.camera.width);
  EXPECT_EQ(read.camera.height, written.camera.height);
}

TEST(CameraErrorFiles, WhatIsNoSuchFileIsNamed) {
  const TemporaryFolder folder;
  const auto complaint = [&](const std::string& text) -> std::string {
    std::ofstream(folder / "camera.json") << text;
    try {
      readCameraErrors(folder / "camera.json");
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  writeCameraErrors(folder / "good.json", someErrors());
  const std::string good = contentOf(folder / "good.json");
  const auto with = [&good](const std::string& from, const std::string& to) {
    std::string text = good;
    EXPECT_NE(text.find(from), std::string::npos) << text;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_EQ(complaint(good), "");
  for (const auto& [text, words] : std::vector<std::pair<std::string, std::string>>{
           {"no json", "parse error"},
           {"[1]", "not a file of camera errors"},
           {"{}", "not a file of camera errors"},
           {with("\"fx\": 700.1", "\"fx\": -1"), "-1"},
           {with("\"delay\"", "\"delay\", \"roll\""), "mean has 2 numbers, there are 3 terms"},
           {with("\"covariance\"", "\"variance\""), "covariance"}}) {
    const std::string said = complaint(text);
    EXPECT_NE(said.find("camera.json"), std::string::npos) << said;
    EXPECT_NE(said.find(words), std::string::npos) << said;
  }
  EXPECT_THROW(readCameraErrors(folder / "none.json"), std::runtime_error);
}

}  // namespace
}  // namespace mvo::test
