// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/true_boxes.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "io/text_lines.hpp"

namespace mvo {

namespace {

namespace fs = std::filesystem;

std::int64_t frameStamp(const CsvReader& csv, std::size_t i, const std::vector<FrameTime>& times) {
  const std::int64_t number = csv.integer(i);
  const auto found = std::find_if(times.begin(), times.end(),
                                  [&](const FrameTime& time) { return time.number == number; });
  if (found == times.end())
    csv.failField(i, "frame " + std::to_string(number) + " is not in times.txt");
  return found->stamp_ns;
}

double positive(const CsvReader& csv, std::size_t i) {
  const double value = csv.number(i);
  if (value <= 0) csv.failField(i, csv.text(i) + " is not above 0");
  return value;
}

std::string bodyName(const CsvReader& csv, std::size_t i) {
  if (csv.text(i).empty()) csv.failField(i, "'' names no body");
  return csv.text(i);
}

// The length of the side from column i to column j.
double side(const CsvReader& csv, std::size_t i, std::size_t j) {
  const double length = csv.number(j) - csv.number(i);
  if (length <= 0) csv.failField(j, csv.text(j) + " is not above " + csv.text(i));
  return length;
}

}  // namespace

std::vector<TrueBox> readBoxes(const fs::path& path, const std::vector<FrameTime>& times) {
  CsvReader csv(path, {"frame", "x", "y", "width", "height"});
  std::vector<TrueBox> boxes;
  while (csv.next())
    boxes.push_back({frameStamp(csv, 0, times), csv.number(1), csv.number(2), positive(csv, 3),
                     positive(csv, 4), "", ""});
  return boxes;
}

std::vector<TrueBox> readBodyBoxes(const fs::path& path, const std::vector<FrameTime>& times) {
  CsvReader csv(path, {"frame", "body", "x1", "y1", "x2", "y2", "occluded_by"});
  std::vector<TrueBox> boxes;
  std::set<std::pair<std::int64_t, std::string>> seen;
  while (csv.next()) {
    const TrueBox box{frameStamp(csv, 0, times), csv.number(2),    csv.number(3), side(csv, 2, 4),
                      side(csv, 3, 5),           bodyName(csv, 1), csv.text(6)};
    if (!seen.emplace(box.stamp_ns, box.body).second)
      csv.failField(1, "'" + box.body + "' has a box in frame " + csv.text(0) + " already");
    if (box.occluded_by == box.body) csv.failField(6, "'" + box.body + "' cannot hide itself");
    boxes.push_back(box);
  }
  return boxes;
}

std::vector<TrueVelocity> readVelocities(const fs::path& path, const std::vector<FrameTime>& times,
                                         const std::vector<TrueBox>& boxes) {
  CsvReader csv(path, {"first", "last", "body", "vx", "vz", "sd"});
  std::vector<TrueVelocity> velocities;
  while (csv.next()) {
    const TrueVelocity velocity{
        bodyName(csv, 2), frameStamp(csv, 0, times), frameStamp(csv, 1, times), csv.number(3),
        csv.number(4),    positive(csv, 5)};
    if (velocity.last_ns <= velocity.first_ns)
      csv.failField(1, "frame " + csv.text(1) + " is not after frame " + csv.text(0));
    if (std::none_of(boxes.begin(), boxes.end(),
                     [&](const TrueBox& box) { return box.body == velocity.body; }))
      csv.failField(2, "'" + velocity.body + "' has no box in body_boxes.csv");
    velocities.push_back(velocity);
  }
  return velocities;
}

}  // namespace mvo
