// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/motion_array_display.hpp"

#include <OgreSceneNode.h>
#include <rviz/frame_manager.h>

#include <pluginlib/class_list_macros.hpp>
#include <set>

#include "rviz_plugin/appearance.hpp"
#include "rviz_plugin/motion_checks.hpp"

namespace mvo_rviz {

using rviz::StatusProperty;

MotionArrayDisplay::MotionArrayDisplay() : properties_(this, SLOT(updateStyle())) {}

MotionArrayDisplay::~MotionArrayDisplay() = default;

void MotionArrayDisplay::onInitialize() {
#ifndef __clang_analyzer__  // tf2_ros' filter calls its virtual functions while it is constructed
  MFDClass::onInitialize();
#endif
  // The filter holds back messages without a transform, and those are the ones to explain.
  sub_.registerCallback(&MotionArrayDisplay::checkFrame, this);
  updateStyle();
}

void MotionArrayDisplay::subscribe() {
  MFDClass::subscribe();
  if (isEnabled() && !message_) reportWaiting();
}

void MotionArrayDisplay::reset() {
  MFDClass::reset();
  visuals_.clear();
  message_.reset();
  if (!isEnabled()) return;
  reportWaiting();
  reportIds();
}

void MotionArrayDisplay::updateStyle() {
  style_ = properties_.style();
  reportIds();
  draw();
}

void MotionArrayDisplay::checkFrame(const mvo::MotionArray::ConstPtr& message) {
  if (const std::string problem = problemOf(*message); !problem.empty()) {
    report(StatusProperty::Error, "Message", problem);
    reportUndrawn();
    return;
  }
  const std::string& frame = message->header.frame_id;
  std::string reason;
  const bool unknown =
      context_->getFrameManager()->transformHasProblems(frame, ros::Time(), reason);
  report(StatusProperty::Error, "Frame",
         unknown ? "No transform from " + frame + " to " + fixed_frame_.toStdString() + "." : "");
  if (unknown) reportUndrawn();
}

void MotionArrayDisplay::processMessage(const mvo::MotionArray::ConstPtr& message) {
  message_ = message;
  draw();
}

void MotionArrayDisplay::draw() {
  if (!message_) return;
  Ogre::Vector3 position;
  Ogre::Quaternion orientation;
  if (!context_->getFrameManager()->getTransform(message_->header, position, orientation)) {
    report(StatusProperty::Error, "Frame",
           "No transform from " + message_->header.frame_id + " to " + fixed_frame_.toStdString() +
               " at the message's stamp.");
    return;
  }
  scene_node_->setPosition(position);
  scene_node_->setOrientation(orientation);

  std::string problem;
  std::set<int> drawn;
  for (const mvo::Motion& motion : message_->motions) {
    std::string of_motion = problemOf(motion, message_->header.frame_id);
    if (of_motion.empty() && drawn.count(motion.id) > 0)
      of_motion = "Motion " + std::to_string(motion.id) + " is there twice; the first is drawn.";
    if (problem.empty()) problem = of_motion;
    if (!of_motion.empty() || !isChosen(motion)) continue;
    drawn.insert(motion.id);
    auto& visual = visuals_[motion.id];
    if (!visual) visual = std::make_unique<MotionVisual>(scene_manager_, scene_node_);
    visual->set(motion, style_);
  }
  for (auto it = visuals_.begin(); it != visuals_.end();)
    it = drawn.count(it->first) > 0 ? std::next(it) : visuals_.erase(it);

  report(StatusProperty::Error, "Message", problem);
  report(StatusProperty::Ok, "Motions",
         std::to_string(drawn.size()) + " of " + std::to_string(message_->motions.size()) +
             " motions are shown.");
  reportOdometry();
  context_->queueRender();
}

bool MotionArrayDisplay::isChosen(const mvo::Motion& motion) const {
  return isVisible(motion) && style_.ids.contains(motion.id) &&
         !(style_.hide_static && motion.is_static);
}

void MotionArrayDisplay::reportWaiting() {
  const std::string topic = topic_property_->getTopicStd();
  report(StatusProperty::Warn, "Motions",
         topic.empty() ? "No topic is chosen." : "No message on " + topic + " yet.");
}

void MotionArrayDisplay::reportUndrawn() {
  if (!message_) report(StatusProperty::Warn, "Motions", "No message could be drawn yet.");
}

void MotionArrayDisplay::reportIds() {
  report(StatusProperty::Error, "Ids", properties_.problemOfIds());
}

void MotionArrayDisplay::reportOdometry() {
  report(StatusProperty::Warn, "Camera", message_->lost ? "Lost: the camera has no pose." : "");
  // Trails are those of the newest message, so none outlives a reset.
  const std::string count = std::to_string(message_->resets);
  report(StatusProperty::Ok, "Resets",
         message_->resets == 0
             ? ""
             : "The odometry has started anew " + count +
                   (message_->resets == 1 ? " time" : " times") + "; trails and ids begin there.");
}

void MotionArrayDisplay::report(StatusProperty::Level level, const char* name,
                                const std::string& sentence) {
  if (sentence.empty())
    deleteStatus(name);
  else
    setStatus(level, name, QString::fromStdString(sentence));
}

}  // namespace mvo_rviz

PLUGINLIB_EXPORT_CLASS(mvo_rviz::MotionArrayDisplay, rviz::Display)
