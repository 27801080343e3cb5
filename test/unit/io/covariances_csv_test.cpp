// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/covariances_csv.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "mvo/se3.hpp"
#include "support/temporary_folder.hpp"

namespace mvo {
namespace {

using test::errorOf;
using test::TemporaryFolder;

std::vector<MotionCovariance> twoRows() {
  MotionCovariance row;
  row.stamp_ns = 1'500'000'000'066'666'667;
  row.from_ns = 1'500'000'000'000'000'000;
  Vector6d xi;
  xi << 0.1, -0.2, 0.3, 0.4, -0.5, 0.6;
  row.T_cb_ca = exp(xi);
  row.covariance = 1e-6 * (Matrix6d::Identity() + xi * xi.transpose());
  MotionCovariance other = row;
  other.motion_id = 12;
  other.span = MotionSpan::kStep;
  return {row, other};
}

TEST(CovariancesCsv, WhatIsWrittenIsRead) {
  const TemporaryFolder folder;
  writeCovariances(folder / "covariances.csv", twoRows());
  const auto rows = readCovariances(folder / "covariances.csv");
  ASSERT_EQ(rows.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const MotionCovariance expected = twoRows()[i];
    EXPECT_EQ(rows[i].stamp_ns, expected.stamp_ns);
    EXPECT_EQ(rows[i].from_ns, expected.from_ns);
    EXPECT_EQ(rows[i].motion_id, expected.motion_id);
    EXPECT_EQ(rows[i].span, expected.span);
    EXPECT_LT(log(rows[i].T_cb_ca.inverse() * expected.T_cb_ca).norm(), 1e-10);
    EXPECT_LT((rows[i].covariance - expected.covariance).norm(), 1e-5 * expected.covariance.norm());
  }
}

TEST(CovariancesCsv, ErrorsNameFileLineAndValue) {
  const TemporaryFolder folder;
  const std::string path = (folder / "covariances.csv").string();
  writeCovariances(path, twoRows());
  std::stringstream content;
  content << std::ifstream(path).rdbuf();
  const auto errorWith = [&](const std::string& from, const std::string& to) {
    std::string text = content.str();
    text.replace(text.find(from), from.size(), to);
    std::ofstream(path) << text;
    return errorOf([&] { readCovariances(path); });
  };
  EXPECT_EQ(errorWith(",12,step", ",12,hop"), path + ":3: span 'hop' is none of step, window, all");
  EXPECT_EQ(errorWith(",12,step", ",-12,step"), path + ":3: motion_id -12 is no id");
  EXPECT_NE(errorWith("c05", "c50").find("c05"), std::string::npos);
}

}  // namespace
}  // namespace mvo
