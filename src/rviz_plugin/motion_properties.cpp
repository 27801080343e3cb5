// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/motion_properties.hpp"

#include <rviz/properties/bool_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/int_property.h>
#include <rviz/properties/string_property.h>

#include "rviz_plugin/trail.hpp"

namespace mvo_rviz {

namespace {

// Makes rows that report to one slot of the display.
struct Rows {
  rviz::Property* display;
  const char* slot;

  // A switch whose children matter only while it is on.
  rviz::BoolProperty* element(const char* name, bool on, const char* help) const {
    auto* row = new rviz::BoolProperty(name, on, help, display, slot, display);
    row->setDisableChildrenIfFalse(true);
    return row;
  }

  rviz::FloatProperty* size(const char* name, float value, float largest, const char* help,
                            rviz::Property* parent) const {
    auto* row = new rviz::FloatProperty(name, value, help, parent, slot, display);
    row->setMin(0);
    row->setMax(largest);
    return row;
  }
};

}  // namespace

MotionProperties::MotionProperties(rviz::Property* display, const char* changed_slot) {
  constexpr float kLargest = 1000;
  const MotionStyle standard;
  const Rows rows{display, changed_slot};

  axes_ =
      rows.element("Axes", standard.axes, "Shows each motion's frame as red x, green y, blue z.");
  axes_length_ = rows.size("Length", standard.axes_length, kLargest,
                           "Length of an axis; the arrow's thickness follows it [m].", axes_);

  trail_ = rows.element("Trail", standard.trail,
                        "Shows where each motion's frame was in the window, older poses fainter.");
  trail_width_ =
      rows.size("Width", standard.trail_width, kLargest, "Width of the trail [m].", trail_);
  trail_length_ = new rviz::IntProperty(
      "Length", standard.trail_length,
      "Number of newest poses that the trail joins; 0 takes the whole window.", trail_,
      changed_slot, display);
  trail_length_->setMin(0);
  trail_length_->setMax(kLongestTrail);

  velocity_ = rows.element("Velocity", standard.velocity,
                           "Shows the linear velocity of each motion's frame as an arrow.");
  velocity_seconds_ = rows.size(
      "Seconds", standard.velocity_seconds, kLargest,
      "The arrow ends where the frame will be after this time at this velocity [s].", velocity_);

  box_ = rows.element("Box", standard.box, "Shows the box around each body's points.");
  box_line_width_ =
      rows.size("Line Width", standard.box_line_width, kLargest, "Width of its edges [m].", box_);

  covariance_ = rows.element("Covariance", standard.covariance,
                             "Shows how uncertain each position is, as an ellipsoid; none if it is "
                             "unknown.");
  sigmas_ = rows.size("Sigmas", standard.sigmas, kLargest,
                      "Half axes of the ellipsoid in standard deviations.", covariance_);

  text_ = rows.element("Text", standard.text, "Shows each motion's id and state.");
  text_height_ =
      rows.size("Height", standard.text_height, kLargest, "Height of a letter [m].", text_);

  hide_static_ = new rviz::BoolProperty("Hide Static", standard.hide_static,
                                        "Hides the static world's motion, which is the camera's.",
                                        display, changed_slot, display);
  ids_ = new rviz::StringProperty(
      "Ids", "", "Shows only these motions: ids and ranges such as 1,3-5; empty shows all.",
      display, changed_slot, display);
  alpha_ = rows.size("Alpha", standard.alpha, 1, "Opacity of everything, from 0 to 1.", display);
}

MotionStyle MotionProperties::style() const {
  MotionStyle style;
  style.axes = axes_->getBool();
  style.axes_length = axes_length_->getFloat();
  style.trail = trail_->getBool();
  style.trail_width = trail_width_->getFloat();
  style.trail_length = trail_length_->getInt();
  style.velocity = velocity_->getBool();
  style.velocity_seconds = velocity_seconds_->getFloat();
  style.box = box_->getBool();
  style.box_line_width = box_line_width_->getFloat();
  style.covariance = covariance_->getBool();
  style.sigmas = sigmas_->getFloat();
  style.text = text_->getBool();
  style.text_height = text_height_->getFloat();
  style.hide_static = hide_static_->getBool();
  style.ids = parseIds(ids_->getStdString()).ids;
  style.alpha = alpha_->getFloat();
  return style;
}

std::string MotionProperties::problemOfIds() const {
  return parseIds(ids_->getStdString()).problem;
}

}  // namespace mvo_rviz
