// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/covariances_csv.hpp"

#include <array>
#include <cstdint>
#include <iomanip>

#include "io/atomic_file.hpp"
#include "io/stamp.hpp"
#include "io/text_lines.hpp"

namespace mvo {

namespace {

constexpr std::array<const char*, 3> kSpans = {"step", "window", "all"};  // as MotionSpan
constexpr std::size_t kPose = 4;                                          // first column of each
constexpr std::size_t kCovariance = 11;

std::vector<std::string> columns() {
  std::vector<std::string> names = {"stamp", "motion_id", "span", "from_stamp", "tx", "ty",
                                    "tz",    "qx",        "qy",   "qz",         "qw"};
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) names.push_back("c" + std::to_string(i) + std::to_string(j));
  return names;
}

MotionSpan spanOf(const CsvReader& csv) {
  for (std::size_t i = 0; i < kSpans.size(); ++i)
    if (csv.text(2) == kSpans[i]) return static_cast<MotionSpan>(i);
  csv.fail("span '" + csv.text(2) + "' is none of step, window, all");
}

}  // namespace

std::vector<MotionCovariance> readCovariances(const std::filesystem::path& path) {
  CsvReader csv(path, columns());
  std::vector<MotionCovariance> rows;
  while (csv.next()) {
    const std::int64_t id = csv.integer(1);
    if (id < 0 || id > INT32_MAX) csv.fail("motion_id " + csv.text(1) + " is no id");
    MotionCovariance row;
    row.stamp_ns = csv.stamp(0);
    row.motion_id = static_cast<int>(id);
    row.span = spanOf(csv);
    row.from_ns = csv.stamp(3);
    const auto number = [&csv](std::size_t i) { return csv.number(kPose + i); };
    row.T_cb_ca.translation() << number(0), number(1), number(2);
    const Eigen::Quaterniond q(number(6), number(3), number(4), number(5));
    if (std::abs(q.norm() - 1) > 0.01) csv.fail("the quaternion has no unit length");
    row.T_cb_ca.linear() = q.normalized().toRotationMatrix();
    std::size_t column = kCovariance;
    for (int i = 0; i < 6; ++i)
      for (int j = i; j < 6; ++j)
        row.covariance(i, j) = row.covariance(j, i) = csv.number(column++);
    rows.push_back(row);
  }
  return rows;
}

void writeCovariances(const std::filesystem::path& path,
                      const std::vector<MotionCovariance>& rows) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  const char* separator = "";
  for (const std::string& name : columns()) {
    out << separator << name;
    separator = ",";
  }
  out << '\n';
  for (const MotionCovariance& row : rows) {
    const Eigen::Quaterniond q(row.T_cb_ca.linear());
    const Eigen::Vector3d& t = row.T_cb_ca.translation();
    out << formatStamp(row.stamp_ns) << ',' << row.motion_id << ','
        << kSpans[static_cast<std::size_t>(row.span)] << ',' << formatStamp(row.from_ns)
        << std::setprecision(12);
    for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()})
      out << ',' << value;
    out << std::setprecision(6);
    for (int i = 0; i < 6; ++i)
      for (int j = i; j < 6; ++j) out << ',' << row.covariance(i, j);
    out << '\n';
  }
  file.commit();
}

}  // namespace mvo
