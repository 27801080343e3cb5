// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/body_states.hpp"

#include <algorithm>

#include "mvo/se3.hpp"

namespace mvo {

namespace {

constexpr std::size_t kWindow = 48;             // frames that can tell a motion
constexpr double kMovingDistance = 0.020;       // [m]
constexpr double kMovingAngle = 0.01745329252;  // 1 degree [rad]
constexpr double kRestShare = 0.1;
constexpr double kVisibleImageShare = 0.010;
constexpr double kVisibleShare = 0.60;
constexpr double kGoneImageShare = 0.001;

Movement movementAt(const FramePoses& truth, std::size_t k) {
  if (!truth[k]) return Movement::kUnclear;
  double distance = 0;
  double turned = 0;
  for (std::size_t j = k + 1 < kWindow ? 0 : k + 1 - kWindow; j < k; ++j) {
    if (!truth[j]) continue;
    distance = std::max(distance, (truth[j]->translation() - truth[k]->translation()).norm());
    turned = std::max(turned, angle(truth[j]->linear().transpose() * truth[k]->linear()));
  }
  if (distance > kMovingDistance || turned > kMovingAngle) return Movement::kMoving;
  if (distance > kRestShare * kMovingDistance || turned > kRestShare * kMovingAngle)
    return Movement::kUnclear;
  return Movement::kRest;
}

}  // namespace

Role BodyState::role() const {
  if (view == View::kGone || movement == Movement::kRest) return Role::kForbidden;
  return view == View::kVisible && movement == Movement::kMoving ? Role::kRequired : Role::kEither;
}

View viewOf(const BodyVisibility& visibility) {
  if (visibility.image_share < kGoneImageShare) return View::kGone;
  return visibility.image_share >= kVisibleImageShare && visibility.visible_share >= kVisibleShare
             ? View::kVisible
             : View::kPartly;
}

std::vector<Movement> movements(const FramePoses& truth) {
  std::vector<Movement> result;
  for (std::size_t k = 0; k < truth.size(); ++k) result.push_back(movementAt(truth, k));
  bool moves_later = false;
  for (std::size_t k = std::min(kWindow, truth.size()); k-- > 0;) {
    if (moves_later && result[k] == Movement::kRest) result[k] = Movement::kUnclear;
    moves_later = moves_later || result[k] == Movement::kMoving;
  }
  return result;
}

std::vector<BodyState> bodyStates(const FramePoses& truth,
                                  const std::vector<BodyVisibility>& visibility) {
  const std::vector<Movement> moves = movements(truth);
  std::vector<BodyState> states;
  for (std::size_t k = 0; k < truth.size(); ++k)
    states.push_back({viewOf(visibility[k]), moves[k]});
  return states;
}

std::vector<Stretch> stretchesInView(const std::vector<BodyState>& states) {
  std::vector<Stretch> stretches;
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (states[k].view == View::kGone) continue;
    if (stretches.empty() || stretches.back().last + 1 != k) stretches.push_back({k, k});
    stretches.back().last = k;
  }
  return stretches;
}

}  // namespace mvo
