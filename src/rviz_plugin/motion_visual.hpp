// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The picture of one motion in rviz's scene.
#pragma once

#include <mvo/Motion.h>

#include <cstdint>
#include <memory>

#include "rviz_plugin/motion_style.hpp"

namespace Ogre {
class SceneManager;
class SceneNode;
}  // namespace Ogre

namespace rviz {
class Arrow;
class Axes;
class BillboardLine;
class MovableText;
class Shape;
}  // namespace rviz

namespace mvo_rviz {

/// Axes, trail, velocity, box, ellipsoid and text of a motion, under a node that stands for the
/// frame of the message. Knows nothing of messages that cannot be drawn.
class MotionVisual {
 public:
  MotionVisual(Ogre::SceneManager* manager, Ogre::SceneNode* frame);
  ~MotionVisual();
  MotionVisual(const MotionVisual&) = delete;
  MotionVisual& operator=(const MotionVisual&) = delete;

  /// Draws the motion, which must have passed problemOf().
  void set(const mvo::Motion& motion, const MotionStyle& style);

 private:
  void setAxes(const mvo::Motion& motion, const MotionStyle& style);
  void setTrail(const mvo::Motion& motion, const MotionStyle& style);
  void setVelocity(const mvo::Motion& motion, const MotionStyle& style);
  void setBox(const mvo::Motion& motion, const MotionStyle& style);
  void setEllipsoid(const mvo::Motion& motion, const MotionStyle& style);
  void setText(const mvo::Motion& motion, const MotionStyle& style);

  Ogre::SceneManager* scene_manager_;
  Ogre::SceneNode* node_;
  Ogre::SceneNode* text_node_;
  std::unique_ptr<rviz::Axes> axes_;
  std::unique_ptr<rviz::BillboardLine> trail_;
  std::unique_ptr<rviz::Arrow> velocity_;
  std::unique_ptr<rviz::Shape> box_;
  std::unique_ptr<rviz::BillboardLine> box_edges_;
  std::unique_ptr<rviz::Shape> ellipsoid_;
  std::unique_ptr<rviz::MovableText> text_;
  std::uint32_t trail_capacity_ = 0;
};

}  // namespace mvo_rviz
