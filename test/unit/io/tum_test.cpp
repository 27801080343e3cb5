// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "io/labels_csv.hpp"
#include "io/stamp.hpp"
#include "io/timing_csv.hpp"
#include "mvo/trajectory_files.hpp"
#include "support/labels_file.hpp"
#include "support/temporary_folder.hpp"

namespace mvo {
namespace {

using test::errorOf;
using test::TemporaryFolder;

TEST(Stamp, NineDecimalsAreExactBothWays) {
  EXPECT_EQ(parseStamp("1500000000.066666603"), 1500000000066666603LL);
  EXPECT_EQ(formatStamp(1500000000066666603LL), "1500000000.066666603");
  for (const std::int64_t ns : {0LL, 1LL, 999999999LL, 1000000000LL, 1500000000000000001LL, -5LL})
    EXPECT_EQ(parseStamp(formatStamp(ns)), ns);
}

TEST(Stamp, OtherWritingsOfANumber) {
  EXPECT_EQ(parseStamp("12"), 12000000000LL);
  EXPECT_EQ(parseStamp("0.5"), 500000000LL);
  EXPECT_EQ(parseStamp("1.0362240e-01"), 103622400LL);
  EXPECT_EQ(parseStamp("0.1234567894"), 123456789LL);
  EXPECT_EQ(parseStamp("0.9999999996"), 1000000000LL);
}

TEST(Stamp, WhatIsNoNumberIsNone) {
  for (const char* text : {"", ".", "-", "abc", "1.2.3", "1 2", "99999999999999", "nan", "1e400"})
    EXPECT_FALSE(parseStamp(text)) << text;
}

TEST(Tum, WhatIsWrittenIsRead) {
  const TemporaryFolder folder;
  std::vector<StampedPose> poses(3);
  for (int k = 0; k < 3; ++k) {
    poses[k].stamp_ns = 1500000000066666603LL + k;
    poses[k].T_world_body = Eigen::Translation3d(1.23456789012 * k, -1e-7, 1e3) *
                            Eigen::AngleAxisd(3.0 * k, Eigen::Vector3d(1, 2, 3).normalized());
  }
  writeTum(folder / "a.tum", poses);
  const auto read = readTum(folder / "a.tum");
  ASSERT_EQ(read.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(read[k].stamp_ns, poses[k].stamp_ns);
    EXPECT_TRUE(read[k].T_world_body.isApprox(poses[k].T_world_body, 1e-11));
  }
  EXPECT_EQ(folder.files(), std::vector<std::string>{"a.tum"});  // no temporary file stays
}

TEST(Tum, CommentsEmptyLinesAndForeignLineEndsAreRead) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.tum") << "# stamp ...\n\n1.5  1 2 3\t0 0 0 1\r\n";
  const auto poses = readTum(folder / "a.tum");
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_EQ(poses[0].stamp_ns, 1500000000LL);
  EXPECT_EQ(poses[0].T_world_body.translation(), Eigen::Vector3d(1, 2, 3));
}

TEST(Tum, ErrorsNameFileAndLine) {
  const TemporaryFolder folder;
  const std::string path = (folder / "a.tum").string();
  const auto error = [&](const std::string& line) {
    std::ofstream(path) << "1.0 0 0 0 0 0 0 1\n" << line << '\n';
    return errorOf([&] { readTum(path); });
  };
  EXPECT_EQ(error("2.0 0 0 0 0 0 0"),
            path + ":2: a pose has 8 numbers (timestamp tx ty tz qx qy qz qw), not 7");
  EXPECT_EQ(error("2.0 0 0 x 0 0 0 1"), path + ":2: 'x' is not a finite number");
  EXPECT_EQ(error("2.0 0 0 nan 0 0 0 1"), path + ":2: 'nan' is not a finite number");
  EXPECT_EQ(error("2.0 0 0 0 0 0 0 0"), path + ":2: the quaternion has no unit length");
  EXPECT_EQ(error("1.0 0 0 0 0 0 0 1"), path + ":2: the stamp does not increase");
  EXPECT_EQ(error("soon 0 0 0 0 0 0 1"), path + ":2: 'soon' is not a time stamp");
  EXPECT_EQ(errorOf([&] { readTum(folder / "none.tum"); }),
            "cannot read " + (folder / "none.tum").string());
}

TEST(Tum, AnUnwritableFileIsAnErrorAndLeavesNothing) {
  const TemporaryFolder folder;
  const auto path = folder / "missing" / "a.tum";
  EXPECT_EQ(errorOf([&] { writeTum(path, {}); }), "cannot write " + path.string());
  EXPECT_TRUE(folder.files().empty());
}

TEST(Csv, LabelsAndTimingsRoundTrip) {
  const TemporaryFolder folder;
  test::writeLabels(folder / "labels.csv",
                    {{1500000000066666603LL, 7, 12.125, 300.5, -1}, {2, 8, 0, 1, 3}});
  const auto labels = readLabels(folder / "labels.csv");
  ASSERT_EQ(labels.size(), 2u);
  EXPECT_EQ(labels[0].stamp_ns, 1500000000066666603LL);
  EXPECT_EQ(labels[0].tracklet, 7);
  EXPECT_DOUBLE_EQ(labels[0].u, 12.125);
  EXPECT_DOUBLE_EQ(labels[0].v, 300.5);
  EXPECT_EQ(labels[0].motion_id, -1);
  EXPECT_EQ(labels[1].motion_id, 3);

  writeTimings(folder / "timing.csv", {{5, "tracking", 1.25}});
  const auto timings = readTimings(folder / "timing.csv");
  ASSERT_EQ(timings.size(), 1u);
  EXPECT_EQ(timings[0].stamp_ns, 5);
  EXPECT_EQ(timings[0].stage, "tracking");
  EXPECT_DOUBLE_EQ(timings[0].ms, 1.25);
}

TEST(Csv, ErrorsNameFileLineAndColumn) {
  const TemporaryFolder folder;
  const std::string path = (folder / "labels.csv").string();
  const auto error = [&](const std::string& content) {
    std::ofstream(path) << content;
    return errorOf([&] { readLabels(path); });
  };
  EXPECT_EQ(error(""), path + " is empty");
  EXPECT_EQ(error("stamp,u,v,motion_id\n"), path + ":1: no column 'tracklet_id' in the header");
  const std::string header = "stamp,tracklet_id,u,v,motion_id\n";
  EXPECT_EQ(error(header + "1.0,1,2\n"), path + ":2: 3 fields where the header has 5");
  EXPECT_EQ(error(header + "1.0,1,2,3,x\n"),
            path + ":2: column 'motion_id': 'x' is not a whole number");
  EXPECT_EQ(error(header + "1.0,1,2,3,0,\n"), path + ":2: 6 fields where the header has 5");
  EXPECT_EQ(error(header + "1.0,1,2,nan,0\n"),
            path + ":2: column 'v': 'nan' is not a finite number");
  EXPECT_EQ(error(header + "1.0,1,2,3,-2\n"), path + ":2: motion_id -2 is neither -1 nor an id");
}

}  // namespace
}  // namespace mvo
