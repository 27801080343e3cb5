// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/motion_visual.hpp"

#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <rviz/ogre_helpers/arrow.h>
#include <rviz/ogre_helpers/axes.h>
#include <rviz/ogre_helpers/billboard_line.h>
#include <rviz/ogre_helpers/movable_text.h>
#include <rviz/ogre_helpers/shape.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "rviz_plugin/appearance.hpp"
#include "rviz_plugin/ellipsoid.hpp"
#include "rviz_plugin/trail.hpp"

namespace mvo_rviz {

namespace {

constexpr float kThinnest = 1e-4F;  // [m]; shapes of no thickness have no normals

template <typename Vector>
Ogre::Vector3 asOgre(const Vector& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

Ogre::Vector3 asOgre(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

// Messages pass with norms near one; the scene wants it exact.
Ogre::Quaternion asOgre(const geometry_msgs::Quaternion& q) {
  Ogre::Quaternion out(static_cast<float>(q.w), static_cast<float>(q.x), static_cast<float>(q.y),
                       static_cast<float>(q.z));
  out.normalise();
  return out;
}

Ogre::Quaternion asOgre(const Eigen::Quaterniond& q) {
  return {static_cast<float>(q.w()), static_cast<float>(q.x()), static_cast<float>(q.y()),
          static_cast<float>(q.z())};
}

Ogre::ColourValue asOgre(const Rgba& c, float opacity = 1) {
  return Ogre::ColourValue(c.r, c.g, c.b, opacity * c.a);
}

bool hasBox(const mvo::Motion& motion) {
  return std::max({motion.extent.x, motion.extent.y, motion.extent.z}) > 0;
}

// How far the box reaches above its centre.
float heightAboveCenter(const mvo::Motion& motion) {
  const Ogre::Quaternion q = asOgre(motion.pose.pose.orientation);
  const Ogre::Vector3 half = 0.5F * asOgre(motion.extent);
  return std::abs(q.xAxis().z) * half.x + std::abs(q.yAxis().z) * half.y +
         std::abs(q.zAxis().z) * half.z;
}

// Replaces a line's points by the twelve edges of a box about its origin.
void setEdges(rviz::BillboardLine& line, const Ogre::Vector3& sides) {
  const Ogre::Vector3 half = 0.5F * sides;
  line.clear();
  bool first = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const float u : {-1.0F, 1.0F}) {
      for (const float v : {-1.0F, 1.0F}) {
        if (!first) line.newLine();
        first = false;
        for (const float along : {-1.0F, 1.0F}) {
          Ogre::Vector3 corner;
          corner[axis] = along;
          corner[(axis + 1) % 3] = u;
          corner[(axis + 2) % 3] = v;
          line.addPoint(half * corner);
        }
      }
    }
  }
}

}  // namespace

MotionVisual::MotionVisual(Ogre::SceneManager* manager, Ogre::SceneNode* frame)
    : scene_manager_(manager),
      node_(frame->createChildSceneNode()),
      text_node_(node_->createChildSceneNode()),
      axes_(std::make_unique<rviz::Axes>(manager, node_)),
      trail_(std::make_unique<rviz::BillboardLine>(manager, node_)),
      velocity_(std::make_unique<rviz::Arrow>(manager, node_)),
      box_(std::make_unique<rviz::Shape>(rviz::Shape::Cube, manager, node_)),
      box_edges_(std::make_unique<rviz::BillboardLine>(manager, node_)),
      ellipsoid_(std::make_unique<rviz::Shape>(rviz::Shape::Sphere, manager, node_)),
      text_(std::make_unique<rviz::MovableText>("-")) {
  box_edges_->setMaxPointsPerLine(2);
  box_edges_->setNumLines(12);
  text_->setTextAlignment(rviz::MovableText::H_CENTER, rviz::MovableText::V_ABOVE);
  text_->showOnTop();
  text_node_->attachObject(text_.get());
}

MotionVisual::~MotionVisual() {
  text_node_->detachObject(text_.get());
  text_.reset();
  ellipsoid_.reset();
  box_edges_.reset();
  box_.reset();
  velocity_.reset();
  trail_.reset();
  axes_.reset();
  scene_manager_->destroySceneNode(text_node_);
  scene_manager_->destroySceneNode(node_);
}

void MotionVisual::set(const mvo::Motion& motion, const MotionStyle& style) {
  setAxes(motion, style);
  setTrail(motion, style);
  setVelocity(motion, style);
  setBox(motion, style);
  setEllipsoid(motion, style);
  setText(motion, style);
}

void MotionVisual::setAxes(const mvo::Motion& motion, const MotionStyle& style) {
  axes_->getSceneNode()->setVisible(style.axes);
  if (!style.axes) return;
  axes_->set(style.axes_length, 0.06F * style.axes_length, colorOf(motion, style.alpha).a);
  axes_->setPosition(asOgre(motion.pose.pose.position));
  axes_->setOrientation(asOgre(motion.pose.pose.orientation));
}

void MotionVisual::setTrail(const mvo::Motion& motion, const MotionStyle& style) {
  const auto trail = cutTrail(motion.trajectory, style.trail_length);
  trail_->clear();
  if (!style.trail || trail.size() < 2) return;
  const auto count = static_cast<std::uint32_t>(trail.size());
  if (count > trail_capacity_) {
    trail_capacity_ = count;
    trail_->setMaxPointsPerLine(count);
  }
  trail_->setLineWidth(style.trail_width);
  const Rgba color = colorOf(motion, style.alpha);
  constexpr float kOldest = 0.25F;  // of the newest pose's opacity
  // Alone this makes the line translucent, whatever its points' colours are.
  trail_->setColor(color.r, color.g, color.b, std::min(color.a, 0.99F));
  for (std::uint32_t i = 0; i < count; ++i) {
    const float age = 1 - static_cast<float>(i) / static_cast<float>(count - 1);
    trail_->addPoint(asOgre(trail[i]), asOgre(color, 1 - age * (1 - kOldest)));
  }
}

void MotionVisual::setVelocity(const mvo::Motion& motion, const MotionStyle& style) {
  const Ogre::Quaternion orientation = asOgre(motion.pose.pose.orientation);
  const Ogre::Vector3 step =
      orientation * asOgre(motion.twist.twist.linear) * style.velocity_seconds;
  const float length = step.length();
  const bool drawn = style.velocity && length > kThinnest;
  velocity_->getSceneNode()->setVisible(drawn);
  if (!drawn) return;
  const float head = std::min(0.4F * length, 0.4F * style.axes_length);
  velocity_->set(length - head, 0.4F * head, head, 0.9F * head);
  velocity_->setPosition(asOgre(motion.pose.pose.position));
  velocity_->setDirection(step);
  velocity_->setColor(asOgre(colorOf(motion, style.alpha)));
}

void MotionVisual::setBox(const mvo::Motion& motion, const MotionStyle& style) {
  constexpr float kFaces = 0.15F;  // opacity, so that the points within stay visible
  const bool drawn = style.box && hasBox(motion);
  box_->getRootNode()->setVisible(drawn);
  box_edges_->getSceneNode()->setVisible(drawn);
  if (!drawn) return;
  const Rgba color = colorOf(motion, style.alpha);
  Ogre::Vector3 sides = asOgre(motion.extent);
  sides.makeCeil(Ogre::Vector3(kThinnest));
  box_->setPosition(asOgre(motion.extent_center));
  box_->setOrientation(asOgre(motion.pose.pose.orientation));
  box_->setScale(sides);
  box_->setColor(asOgre(color, kFaces));
  box_edges_->setPosition(asOgre(motion.extent_center));
  box_edges_->setOrientation(asOgre(motion.pose.pose.orientation));
  setEdges(*box_edges_, sides);
  box_edges_->setLineWidth(style.box_line_width);
  box_edges_->setColor(color.r, color.g, color.b, color.a);
}

void MotionVisual::setEllipsoid(const mvo::Motion& motion, const MotionStyle& style) {
  constexpr float kOpacity = 0.6F;
  const auto ellipsoid = positionEllipsoid(motion.pose, style.sigmas);
  const bool drawn = style.covariance && ellipsoid;
  ellipsoid_->getRootNode()->setVisible(drawn);
  if (!drawn) return;
  Ogre::Vector3 diameters = 2 * asOgre(ellipsoid->half_axes);
  diameters.makeCeil(Ogre::Vector3(kThinnest));
  ellipsoid_->setPosition(asOgre(motion.pose.pose.position));
  ellipsoid_->setOrientation(asOgre(ellipsoid->orientation));
  ellipsoid_->setScale(diameters);
  ellipsoid_->setColor(asOgre(colorOf(motion, style.alpha), kOpacity));
}

void MotionVisual::setText(const mvo::Motion& motion, const MotionStyle& style) {
  const bool drawn = style.text && style.text_height > 0;
  text_node_->setVisible(drawn);
  if (!drawn) return;
  const bool above_box = style.box && hasBox(motion);
  const float rise = above_box    ? heightAboveCenter(motion)
                     : style.axes ? 1.2F * style.axes_length
                                  : 0;
  const Ogre::Vector3 foot = asOgre(above_box ? motion.extent_center : motion.pose.pose.position);
  text_node_->setPosition(foot + Ogre::Vector3(0, 0, rise + 0.6F * style.text_height));
  text_->setCaption(captionOf(motion));
  text_->setCharacterHeight(style.text_height);
  text_->setSpaceWidth(0.3F * style.text_height);
  Rgba color = colorOf(motion, style.alpha);
  color.a = style.alpha;  // pale is enough, faint letters cannot be read
  text_->setColor(asOgre(color));
}

}  // namespace mvo_rviz
