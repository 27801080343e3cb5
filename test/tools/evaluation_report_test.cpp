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

// A walker whom the world's label takes in two frames, and a car that is too fast.
mvo::BoxEvaluation boxes() {
  mvo::BoxEvaluation boxes;
  boxes.own_label = {19, 17};
  mvo::BoxedBody walker;
  walker.body = "P1";
  walker.frames = 20;
  walker.clear_frames = 10;
  walker.found = 6;
  walker.found_clear = 5;
  walker.found_without_outliers = 8;
  walker.first_found = 3;
  walker.ids = {2, 4};
  walker.id_switches = 1;
  walker.labels = {200, 50, 10};
  walker.static_frames = {7, 8, 11};
  walker.placement = mvo::BoxPlacement{9, 8};
  boxes.bodies.push_back(walker);
  boxes.background = {{100, 75, 5}, 18, {12}};
  mvo::VelocityScore fast;
  fast.truth = {"A", 0, 500'000'000, 7.0, -1.0, 0.2};
  fast.last = 5;
  mvo::VelocityScore unknown = fast;
  fast.id = 3;
  fast.velocity = {7.5, 0, -1.0};
  fast.displacement_error = 0.25;
  fast.depth = 22;
  fast.implied_depth = mvo::ImpliedDepth{20, 1};
  boxes.velocities = {fast, unknown};
  return boxes;
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
  for (const char* key : {"motion_count", "bodies", "static_world", "third_party_motion",
                          "box_label", "boxed_bodies", "outside_boxes", "velocities", "timing_ms"})
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
  evaluation.boxes = boxes();
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

TEST(Json, HasWhatIsKnownByBoxes) {
  mvo::Evaluation evaluation = cameraOnly();
  evaluation.boxes = boxes();
  const auto json = toJson(evaluation);
  const auto& body = json["boxed_bodies"][0];
  EXPECT_EQ(body["body"], "P1");
  EXPECT_DOUBLE_EQ(body["found_clear_pct"], 50.0);
  EXPECT_DOUBLE_EQ(body["found_pct"], 30.0);
  EXPECT_EQ(body["first_found_frame"], 3);
  EXPECT_DOUBLE_EQ(body["labels"]["static_pct"], 25.0);
  EXPECT_DOUBLE_EQ(body["labels"]["moving_pct"], 70.0);
  EXPECT_EQ(body["static_frames"], nlohmann::ordered_json({7, 8, 11}));
  EXPECT_EQ(body["pose_in_box"]["inside_frames"], 8);
  EXPECT_DOUBLE_EQ(json["outside_boxes"]["labels"]["static_pct"], 75.0);
  EXPECT_EQ(json["outside_boxes"]["not_static_frames"], nlohmann::ordered_json({12}));
  const auto& velocity = json["velocities"][0];
  EXPECT_DOUBLE_EQ(velocity["error_vx_m_s"], 0.5);
  EXPECT_DOUBLE_EQ(velocity["displacement_error_m"], 0.25);
  EXPECT_DOUBLE_EQ(velocity["implied_depth_m"], 20.0);
  EXPECT_FALSE(json["velocities"][1].contains("error_vx_m_s"));
}

TEST(Table, TellsOfBoxesInOneLineEach) {
  mvo::Evaluation evaluation = cameraOnly();
  evaluation.boxes = boxes();
  const std::string table = toTable(evaluation);
  for (const char* line :
       {"boxed P1  found in 5 of 10 clear frames (50.0 %; 8 without outliers), in 6 of all 20, ids "
        "{2, 4}, 1 switches; "
        "25.0 % labelled 0, most in 3 frames: 7-8, 11; pose in the box in 8 of 9 frames\n",
        "outside the boxes 75.0 % labelled 0 (5.0 % outliers), most not in 1 of 18 frames: 12\n",
        "velocity known in 1 of 2 stretches, off by 0.50 m/s in x and 0.00 in z (RMS), "
        "displacement by 0.25 m at most; depth within 2 sd of what boxes tell in 1 of 1\n"})
    EXPECT_NE(table.find(line), std::string::npos) << table << "lacks " << line;
}

TEST(Table, SaysTheSameInWords) {
  mvo::Evaluation evaluation = cameraOnly();
  evaluation.boxes = boxes();
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
