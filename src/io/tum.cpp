// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <iomanip>

#include "io/atomic_file.hpp"
#include "io/stamp.hpp"
#include "io/text_lines.hpp"
#include "mvo/trajectory_files.hpp"

namespace mvo {

namespace {

constexpr std::size_t kFields = 8;
constexpr double kMaxNormError = 0.01;  // files with four decimals still pass

}  // namespace

std::vector<StampedPose> readTum(const std::filesystem::path& path) {
  LineReader lines(path);
  std::vector<StampedPose> poses;
  while (lines.next()) {
    if (lines.size() != kFields)
      lines.fail("a pose has 8 numbers (timestamp tx ty tz qx qy qz qw), not " +
                 std::to_string(lines.size()));
    StampedPose pose;
    pose.stamp_ns = lines.stamp(0);
    if (!poses.empty() && pose.stamp_ns <= poses.back().stamp_ns)
      lines.fail("the stamp does not increase");
    const Eigen::Quaterniond q(lines.number(7), lines.number(4), lines.number(5), lines.number(6));
    if (std::abs(q.norm() - 1.0) > kMaxNormError) lines.fail("the quaternion has no unit length");
    pose.T_world_body.linear() = q.normalized().toRotationMatrix();
    pose.T_world_body.translation() =
        Eigen::Vector3d(lines.number(1), lines.number(2), lines.number(3));
    poses.push_back(pose);
  }
  return poses;
}

void writeTum(const std::filesystem::path& path, const std::vector<StampedPose>& poses) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << std::setprecision(12);
  for (const StampedPose& pose : poses) {
    const auto t = pose.T_world_body.translation();
    Eigen::Quaterniond q(pose.T_world_body.linear());
    if (q.w() < 0) q.coeffs() = -q.coeffs();  // one sign, so that equal poses are equal text
    out << formatStamp(pose.stamp_ns) << ' ' << t.x() << ' ' << t.y() << ' ' << t.z() << ' '
        << q.x() << ' ' << q.y() << ' ' << q.z() << ' ' << q.w() << '\n';
  }
  file.commit();
}

}  // namespace mvo
