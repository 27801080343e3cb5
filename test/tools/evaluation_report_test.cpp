// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluation_report.hpp"

#include <gtest/gtest.h>

#include "eval/motion_count.hpp"

namespace mvo_tools {
namespace {

mvo::Evaluation cameraOnly() {
  mvo::Evaluation evaluation;
  evaluation.frames = 50;
  evaluation.camera.emplace();
  evaluation.camera->errors.max = 0.25;
  evaluation.camera->errors.max_angle = M_PI / 180;
  evaluation.camera->steps = {49, 0.01, 0.5, 0.001, M_PI / 90, 17, 18};
  evaluation.camera->scale = 0.97;
  evaluation.camera->drift.emplace();
  evaluation.camera->drift->angle_per_metre = M_PI / 1800;
  evaluation.camera->curve = {{3, {0.1, 0.2, 0.3}, {0, 0, M_PI / 2}, M_PI / 2, 0}};
  return evaluation;
}

TEST(Json, HasMetresAndDegrees) {
  const auto json = toJson(cameraOnly());
  EXPECT_EQ(json["frames"], 50);
  EXPECT_DOUBLE_EQ(json["camera"]["errors"]["max_m"], 0.25);
  EXPECT_DOUBLE_EQ(json["camera"]["errors"]["max_deg"], 1.0);
  EXPECT_DOUBLE_EQ(json["camera"]["end_drift"]["deg_per_m"], 0.1);
  EXPECT_DOUBLE_EQ(json["camera"]["rpe"]["max_m"], 0.5);
  EXPECT_EQ(json["camera"]["rpe"]["max_frame"], 17);
  EXPECT_DOUBLE_EQ(json["camera"]["rpe"]["max_deg"], 2.0);
  EXPECT_EQ(json["camera"]["rpe"]["max_deg_frame"], 18);
  EXPECT_DOUBLE_EQ(json["camera"]["scale"], 0.97);
  EXPECT_EQ(json["curves"]["camera"]["frame"], nlohmann::ordered_json({3}));
  EXPECT_DOUBLE_EQ(json["curves"]["camera"]["rpy_deg"][0][2], 90.0);
}

TEST(Json, WhatTheTruthCannotTellHasNoKey) {
  const auto json = toJson(cameraOnly());
  for (const char* key :
       {"motion_count", "bodies", "static_world", "third_party_motion", "box_label", "timing_ms"})
    EXPECT_FALSE(json.contains(key)) << key;
}

TEST(Json, HasAllThatIsThere) {
  mvo::Evaluation evaluation = cameraOnly();
  mvo::BodyEvaluation body;
  body.body = 3;
  body.ids = {7, 9};
  body.has_masks = body.has_visibility = true;
  body.segmentation = {9, 1, 3, 3};
  evaluation.bodies.push_back(body);
  evaluation.counts = {{5, 4, 5, true, false}, {0, 1, 1, false, false}};
  evaluation.rates = mvo::rightNumberRates(evaluation.counts);
  evaluation.third_party_frames = 5;
  evaluation.boxes = mvo::BoxScore{19, 17};
  evaluation.times = {{"step", 2, 10, 11, 12, 13}};
  const auto json = toJson(evaluation);
  EXPECT_EQ(json["bodies"][0]["ids"], nlohmann::ordered_json({7, 9}));
  EXPECT_DOUBLE_EQ(json["bodies"][0]["segmentation"]["precision_pct"], 90.0);
  EXPECT_DOUBLE_EQ(json["bodies"][0]["segmentation"]["recall_without_outliers_pct"], 100.0);
  EXPECT_DOUBLE_EQ(json["motion_count"]["right_number_pct"], 50.0);
  EXPECT_EQ(json["motion_count"]["histogram"]["5"], 1);
  EXPECT_EQ(json["curves"]["motion_count"]["found"], nlohmann::ordered_json({5, 0}));
  EXPECT_DOUBLE_EQ(json["third_party_motion"]["pct"], 10.0);
  EXPECT_DOUBLE_EQ(json["box_label"]["pct"], 100.0 * 17 / 19);
  EXPECT_DOUBLE_EQ(json["timing_ms"]["step"]["median"], 10.0);
}

TEST(Table, SaysTheSameInWords) {
  mvo::Evaluation evaluation = cameraOnly();
  evaluation.boxes = mvo::BoxScore{19, 17};
  evaluation.notes = {"beware"};
  const std::string table = toTable(evaluation);
  EXPECT_NE(table.find("max 0.2500 m"), std::string::npos) << table;
  EXPECT_NE(table.find("in 17 of 19 frames (89.5 %)"), std::string::npos) << table;
  EXPECT_NE(table.find("worst step  0.5000 m in frame 17, 2.000 deg in frame 18"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("scale       0.9700"), std::string::npos) << table;
  EXPECT_NE(table.find("note: beware\n"), std::string::npos) << table;
  EXPECT_EQ(table.find("motions  right"), std::string::npos) << table;
}

}  // namespace
}  // namespace mvo_tools
