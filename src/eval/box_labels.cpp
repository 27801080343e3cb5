// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/box_labels.hpp"

#include <algorithm>
#include <set>

#include "eval/segmentation.hpp"

namespace mvo {

namespace {

constexpr int kMinOwnTracklets = 10;
constexpr int kMaxOutsidePercent = 20;
constexpr int kMinTracklets = 5;

std::vector<LabelRow> inside(const std::vector<LabelRow>& labels, const TrueBox& box) {
  std::vector<LabelRow> rows;
  for (const LabelRow& label : labels)
    if (contains(box, label.u, label.v)) rows.push_back(label);
  return rows;
}

std::vector<LabelRow> withoutOutliers(const std::vector<LabelRow>& labels) {
  std::vector<LabelRow> rows;
  for (const LabelRow& label : labels)
    if (label.motion_id >= 0) rows.push_back(label);
  return rows;
}

// The id, be it 0 or -1, of most of the labels, if there are enough.
std::optional<int> majority(const std::vector<LabelRow>& labels, int at_least) {
  if (static_cast<int>(labels.size()) < at_least) return {};
  std::map<int, std::size_t> counts;
  for (const LabelRow& label : labels) ++counts[label.motion_id];
  for (const auto& [id, count] : counts)
    if (2 * count > labels.size()) return id;
  return {};
}

// Is what is seen there the body that hides this one?
bool hidden(const TrueBox& box, const std::vector<TrueBox>& boxes, const LabelRow& label) {
  if (box.occluded_by.empty()) return false;
  const TrueBox* before = boxOf(box.occluded_by, boxes);
  return before != nullptr && contains(*before, label.u, label.v);
}

void add(const std::vector<LabelRow>& labels, LabelShares& shares) {
  for (const LabelRow& label : labels) {
    ++shares.tracklets;
    if (label.motion_id == 0) ++shares.static_world;
    if (label.motion_id < 0) ++shares.outliers;
  }
}

double percent(int part, int whole) { return whole == 0 ? 0 : 100.0 * part / whole; }

}  // namespace

double BoxScore::percent() const { return mvo::percent(labelled, frames); }

double LabelShares::staticPercent() const { return percent(static_world, tracklets); }
double LabelShares::outlierPercent() const { return percent(outliers, tracklets); }
double LabelShares::movingPercent() const {
  return percent(tracklets - static_world - outliers, tracklets);
}

double BoxedBody::foundPercent() const { return percent(found, frames); }
double BoxedBody::foundClearPercent() const { return percent(found_clear, clear_frames); }

bool contains(const TrueBox& box, double u, double v) {
  return box.x <= u && u <= box.x + box.width && box.y <= v && v <= box.y + box.height;
}

const TrueBox* boxOf(const std::string& body, const std::vector<TrueBox>& boxes) {
  for (const TrueBox& box : boxes)
    if (box.body == body) return &box;
  return nullptr;
}

FrameBoxes boxesByFrame(const FrameClock& clock, const std::vector<TrueBox>& boxes) {
  FrameBoxes by_frame(clock.frames());
  for (const TrueBox& box : boxes)
    if (const auto frame = clock.frameOf(box.stamp_ns)) by_frame[*frame].push_back(box);
  return by_frame;
}

bool hasOwnLabel(const std::vector<LabelRow>& labels, const TrueBox& box) {
  const auto id = majority(inside(labels, box), kMinOwnTracklets);
  if (!id || *id < 1) return false;
  int all = 0;
  int outside = 0;
  for (const LabelRow& label : labels) {
    if (label.motion_id != *id) continue;
    ++all;
    if (!contains(box, label.u, label.v)) ++outside;
  }
  return 100 * outside <= kMaxOutsidePercent * all;
}

std::map<int, std::string> ownersOfIds(const FrameLabels& labels, const FrameBoxes& boxes) {
  std::map<int, std::map<std::string, int>> counts;
  for (std::size_t k = 0; k < boxes.size(); ++k)
    for (const TrueBox& box : boxes[k])
      for (const LabelRow& label : inside(labels[k], box))
        if (label.motion_id >= 1 && !hidden(box, boxes[k], label))
          ++counts[label.motion_id][box.body];
  std::map<int, std::string> owners;
  for (const auto& [id, bodies] : counts)
    owners[id] = std::max_element(bodies.begin(), bodies.end(), [](const auto& a, const auto& b) {
                   return a.second < b.second;
                 })->first;
  return owners;
}

Holders holders(const std::string& body, const FrameLabels& labels, const FrameBoxes& boxes,
                const std::map<int, std::string>& owners) {
  Holders result(boxes.size());
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const TrueBox* box = boxOf(body, boxes[k]);
    if (box == nullptr) continue;
    const auto id = majority(inside(labels[k], *box), kMinTracklets);
    if (!id || *id < 1) continue;
    const auto owner = owners.find(*id);
    if (owner == owners.end() || owner->second == body) result[k] = id;
  }
  return result;
}

BoxedBody scoreBoxedBody(const std::string& body, const FrameLabels& labels,
                         const FrameBoxes& boxes, const std::map<int, std::string>& owners) {
  BoxedBody score;
  score.body = body;
  FrameLabels certain;
  for (const auto& rows : labels) certain.push_back(withoutOutliers(rows));
  const Holders ids = holders(body, labels, boxes, owners);
  const Holders certain_ids = holders(body, certain, boxes, owners);
  std::set<int> used;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const TrueBox* box = boxOf(body, boxes[k]);
    if (box == nullptr) continue;
    ++score.frames;
    if (ids[k]) {
      ++score.found;
      used.insert(*ids[k]);
      if (!score.first_found) score.first_found = k;
    }
    if (!box->occluded_by.empty()) continue;
    ++score.clear_frames;
    if (ids[k]) ++score.found_clear;
    if (certain_ids[k]) ++score.found_without_outliers;
    if (hasOwnLabel(labels[k], *box)) ++score.own_label;
    add(inside(labels[k], *box), score.labels);
    if (majority(inside(certain[k], *box), kMinTracklets) == 0) score.static_frames.push_back(k);
  }
  score.ids.assign(used.begin(), used.end());
  score.id_switches = idSwitches(ids);
  return score;
}

BackgroundLabels scoreBackground(const FrameLabels& labels, const FrameBoxes& boxes) {
  BackgroundLabels score;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    if (boxes[k].empty()) continue;
    std::vector<LabelRow> rows;
    for (const LabelRow& label : labels[k])
      if (std::none_of(boxes[k].begin(), boxes[k].end(),
                       [&](const TrueBox& box) { return contains(box, label.u, label.v); }))
        rows.push_back(label);
    add(rows, score.labels);
    const std::vector<LabelRow> certain = withoutOutliers(rows);
    if (certain.empty()) continue;
    ++score.frames;
    if (majority(certain, 1) != 0) score.not_static_frames.push_back(k);
  }
  return score;
}

}  // namespace mvo
