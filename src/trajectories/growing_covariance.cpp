// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories/growing_covariance.hpp"

#include <algorithm>

#include "mvo/se3.hpp"

namespace mvo {

namespace {

Matrix6d transported(const Eigen::Isometry3d& T_a_b, const Matrix6d& at_b) {
  const Matrix6d Ad = adjoint(T_a_b);
  return Ad * at_b * Ad.transpose();
}

}  // namespace

// Frames that the last window does not connect add nothing: there the motion goes on by rule, and
// who makes it do so says how uncertain that is.
void GrowingCovariance::slideTo(FrameId first_frame) {
  const auto frames = static_cast<double>(trajectory_.T_ck_c1.size());
  for (; *since_ < first_frame; ++*since_) {
    const FrameId next = *since_ + 1;
    const auto T_next_since = trajectory_.between(next, *since_);
    const auto T_next_newest = trajectory_.between(next, trajectory_.lastFrame());
    if (!T_next_since || !T_next_newest) continue;
    at_since_ =
        transported(*T_next_since, at_since_) + transported(*T_next_newest, window_) / (frames - 1);
  }
}

void GrowingCovariance::update(const Trajectory& trajectory, const Matrix6d& window) {
  if (since_) slideTo(trajectory.first_frame);
  const FrameId newest = trajectory.lastFrame();
  // Where the motion goes on from a later frame, only its part from there on counts.
  if (!since_ || *since_ >= newest) since_ = trajectory.first_frame;
  trajectory_ = trajectory;
  window_ = window;
  const double share =
      static_cast<double>(newest - *since_) / static_cast<double>(newest - trajectory.first_frame);
  if (const auto T_ck_since = trajectory.between(newest, *since_))
    newest_ = share * window + transported(*T_ck_since, at_since_);
}

void GrowingCovariance::continueFrom(FrameId frame, const Matrix6d& covariance) {
  since_ = frame;
  at_since_ = newest_ = covariance;
  trajectory_ = Trajectory();
}

}  // namespace mvo
