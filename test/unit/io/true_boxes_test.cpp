// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/true_boxes.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "support/temporary_folder.hpp"

namespace mvo {
namespace {

using test::errorOf;
using test::TemporaryFolder;

const std::vector<FrameTime> kTimes{{4, 1'000}, {5, 1'100}, {7, 1'300}};
const std::string kBoxHead = "frame,body,x1,y1,x2,y2,occluded_by\n";
const std::string kVelocityHead = "first,last,body,vx,vz,sd\n";

class TrueBoxes : public ::testing::Test {
 protected:
  std::vector<TrueBox> boxes(const std::string& content) {
    std::ofstream(path_) << content;
    return readBodyBoxes(path_, kTimes);
  }
  std::vector<TrueVelocity> velocities(const std::string& content) {
    std::ofstream(path_) << content;
    return readVelocities(path_, kTimes, {{1'000, 0, 0, 1, 1, "A", ""}});
  }

  TemporaryFolder folder_;
  const std::string path_ = (folder_ / "a.csv").string();
};

TEST_F(TrueBoxes, BothFormatsAreTheSameBoxes) {
  std::ofstream(path_) << "frame,x,y,width,height\n5,10,20,30,40\n";
  const TrueBox plain = readBoxes(path_, kTimes).at(0);
  const auto named = boxes(kBoxHead + "5,A,10,20,40,60,\n7,A,-1300,-5,2,1,pole\r\n");
  ASSERT_EQ(named.size(), 2u);
  for (const TrueBox& box : {plain, named[0]}) {
    EXPECT_EQ(box.stamp_ns, 1'100);
    EXPECT_DOUBLE_EQ(box.x, 10);
    EXPECT_DOUBLE_EQ(box.y, 20);
    EXPECT_DOUBLE_EQ(box.width, 30);
    EXPECT_DOUBLE_EQ(box.height, 40);
    EXPECT_TRUE(box.occluded_by.empty());
  }
  EXPECT_EQ(plain.body, "");
  EXPECT_EQ(named[0].body, "A");
  EXPECT_EQ(named[1].occluded_by, "pole");
  EXPECT_DOUBLE_EQ(named[1].width, 1302);  // it leaves the image
}

TEST_F(TrueBoxes, ErrorsNameFileLineColumnAndValue) {
  const auto error = [&](const std::string& row) {
    const std::string text = errorOf([&] { boxes(kBoxHead + "4,A,1,2,3,4,\n" + row + "\n"); });
    EXPECT_EQ(text.rfind(path_ + ":3: ", 0), 0u) << text;
    return text.substr(path_.size() + 4);
  };
  EXPECT_EQ(error("6,A,1,2,3,4,"), "column 'frame': frame 6 is not in times.txt");
  EXPECT_EQ(error("x,A,1,2,3,4,"), "column 'frame': 'x' is not a whole number");
  EXPECT_EQ(error("5,,1,2,3,4,"), "column 'body': '' names no body");
  EXPECT_EQ(error("5,A,1,inf,3,4,"), "column 'y1': 'inf' is not a finite number");
  EXPECT_EQ(error("5,A,3,2,1,4,"), "column 'x2': 1 is not above 3");
  EXPECT_EQ(error("5,A,1,4,3,4,"), "column 'y2': 4 is not above 4");
  EXPECT_EQ(error("5,A,1,2,3,4,A"), "column 'occluded_by': 'A' cannot hide itself");
  EXPECT_EQ(error("4,A,1,2,3,4,"), "column 'body': 'A' has a box in frame 4 already");
  EXPECT_EQ(error("5,A,1,2,3,4"), "6 fields where the header has 7");
  EXPECT_EQ(error("5,A,1,2,3,4,5,"), "8 fields where the header has 7");
  EXPECT_EQ(errorOf([&] { boxes("frame,body,x1,y1,x2,y2\n"); }),
            path_ + ":1: no column 'occluded_by' in the header");
  EXPECT_EQ(errorOf([&] { boxes(""); }), path_ + " is empty");
}

TEST_F(TrueBoxes, AnOldBoxHasASize) {
  std::ofstream(path_) << "frame,x,y,width,height\n5,10,20,0,40\n";
  EXPECT_EQ(errorOf([&] { readBoxes(path_, kTimes); }),
            path_ + ":2: column 'width': 0 is not above 0");
}

TEST_F(TrueBoxes, VelocitiesAreOfBodiesWithBoxes) {
  const auto read = velocities(kVelocityHead + "4,7,A,6.9,-0.7,0.2\n");
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].body, "A");
  EXPECT_EQ(read[0].first_ns, 1'000);
  EXPECT_EQ(read[0].last_ns, 1'300);
  EXPECT_DOUBLE_EQ(read[0].vx, 6.9);
  EXPECT_DOUBLE_EQ(read[0].vz, -0.7);
  EXPECT_DOUBLE_EQ(read[0].sd, 0.2);
  const auto error = [&](const std::string& row) {
    return errorOf([&] { velocities(kVelocityHead + row + "\n"); }).substr(path_.size());
  };
  EXPECT_EQ(error("4,7,E,6,0,1"), ":2: column 'body': 'E' has no box in body_boxes.csv");
  EXPECT_EQ(error("7,4,A,6,0,1"), ":2: column 'last': frame 4 is not after frame 7");
  EXPECT_EQ(error("4,6,A,6,0,1"), ":2: column 'last': frame 6 is not in times.txt");
  EXPECT_EQ(error("4,7,A,fast,0,1"), ":2: column 'vx': 'fast' is not a finite number");
  EXPECT_EQ(error("4,7,A,6,0,-1"), ":2: column 'sd': -1 is not above 0");
}

}  // namespace
}  // namespace mvo
