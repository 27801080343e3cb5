// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Do the bodies in hand-drawn boxes have labels, and the world around them its own? For real
// sequences without masks.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "eval/frames.hpp"
#include "mvo/evaluation.hpp"

namespace mvo {

/// The boxes and the labels of each frame.
using FrameBoxes = std::vector<std::vector<TrueBox>>;
using FrameLabels = std::vector<std::vector<LabelRow>>;

/// The id that holds a body, by frame.
using Holders = std::vector<std::optional<int>>;

/// Edges included.
bool contains(const TrueBox& box, double u, double v);

/// The body's among the boxes of a frame; null if it has none.
const TrueBox* boxOf(const std::string& body, const std::vector<TrueBox>& boxes);

/// Boxes of no frame are left out.
FrameBoxes boxesByFrame(const FrameClock& clock, const std::vector<TrueBox>& boxes);

/// True if one id >= 1 holds most of at least ten tracklets inside the box and has at most 20 % of
/// its own tracklets outside of it.
bool hasOwnLabel(const std::vector<LabelRow>& labels, const TrueBox& box);

/// The body that each id >= 1 belongs to: the one in whose boxes it has most tracklets over all
/// frames, on a tie the first by name. Where a body is hidden by another, tracklets in both boxes
/// are the other's. Ids never seen in a box have no entry.
std::map<int, std::string> ownersOfIds(const FrameLabels& labels, const FrameBoxes& boxes);

/// In each frame with a box of the body, the id >= 1 that holds most of at least five tracklets
/// inside and is no other body's.
Holders holders(const std::string& body, const FrameLabels& labels, const FrameBoxes& boxes,
                const std::map<int, std::string>& owners);

/// All that the labels tell of a body.
BoxedBody scoreBoxedBody(const std::string& body, const FrameLabels& labels,
                         const FrameBoxes& boxes, const std::map<int, std::string>& owners);

/// The labels of what lies outside all boxes, in the frames that have boxes.
BackgroundLabels scoreBackground(const FrameLabels& labels, const FrameBoxes& boxes);

}  // namespace mvo
