// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The nouns of the method (II-A, III): observations, tracklets, the window, labels and their
// trajectories.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace mvo {

using FrameId = std::int64_t;     ///< frames count up from 0 without holes
using TrackletId = std::int64_t;  ///< never used twice
using LabelId = int;              ///< identity of a motion over time; see kStatic and kOutlier
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

constexpr LabelId kStatic = 0;    ///< the label of the static world, i.e. of the camera's egomotion
constexpr LabelId kOutlier = -1;  ///< the outlier label O

/// One stereo measurement y = (u_l, v, u_r) [px] in the rectified images of a frame.
struct Observation {
  FrameId frame = 0;
  Eigen::Vector3d y = Eigen::Vector3d::Zero();
};

/// p^j: the observations of one point, in increasing order of frame; gaps are allowed, repetitions
/// are not.
struct Tracklet {
  TrackletId id = 0;
  std::vector<Observation> observations;

  FrameId first() const { return observations.front().frame; }
  FrameId last() const { return observations.back().frame; }
  /// The observation in a frame, or null.
  const Observation* find(FrameId frame) const;
};

/// P: all tracklets of the frames [first_frame, last_frame], also those that have left the image.
/// Observations outside the span do not occur; every tracklet has at least one.
struct Window {
  FrameId first_frame = 0;
  FrameId last_frame = -1;
  std::vector<Tracklet> tracklets;

  int frames() const { return static_cast<int>(last_frame - first_frame + 1); }
};

/// A tracklet of the window where the newest frame shows it.
struct SeenTracklet {
  int tracklet = 0;                             ///< index into Window::tracklets
  Eigen::Vector3d y = Eigen::Vector3d::Zero();  ///< (u_l, v, u_r) [px]
};

/// N (III-A): undirected, every pair once with a < b, indices into Window::tracklets.
struct Graph {
  std::vector<std::pair<int, int>> edges;
  std::vector<std::vector<int>> neighbors;  ///< the same edges from both ends, sorted
};

/// A camera egomotion hypothesis ^lT_C: poses T_ck_c1 of a span of frames, C_1 being the span's
/// first frame. A frame whose motion is unknown starts a new segment; poses of different segments
/// cannot be compared.
struct Trajectory {
  FrameId first_frame = 0;
  std::vector<Eigen::Isometry3d> T_ck_c1;  ///< one per frame of the span
  std::vector<int> segment;  ///< one per frame; equal numbers are connected, -1 = no estimate

  bool empty() const { return T_ck_c1.empty(); }
  FrameId lastFrame() const { return first_frame + static_cast<FrameId>(T_ck_c1.size()) - 1; }
  bool has(FrameId frame) const;
  /// T_a_b: coordinates in the camera of frame b to those of frame a; none if not connected.
  std::optional<Eigen::Isometry3d> between(FrameId a, FrameId b) const;
  /// Appends the frame after the last, by its step T_ck_ckm1, or unknown (starts a segment of its
  /// own).
  void append(const std::optional<Eigen::Isometry3d>& T_ck_ckm1);
  /// Drops the frames before `frame` and re-expresses the rest in the new first frame.
  void dropBefore(FrameId frame);
};

/// l: a hypothesis with an identity (ids of fresh proposals are not final until continuity is
/// checked).
struct Label {
  LabelId id = kOutlier;
  Trajectory trajectory;
  std::optional<int> known{};  ///< its place among the last window's labels; none: newly proposed
  int proposal = 0;            ///< counts the proposals of one window

  /// Tells the labels of one window apart: known ones by their place, others by their proposal.
  std::pair<bool, int> key() const { return {known.has_value(), known.value_or(proposal)}; }
};

/// L and l(p): the labels and, per tracklet of the window, an index into them or kOutlier.
struct Labeling {
  std::vector<Label> labels;
  std::vector<int> assignment;

  /// P_l: indices of the tracklets of a label (or of kOutlier).
  std::vector<int> support(int label) const;
};

}  // namespace mvo
