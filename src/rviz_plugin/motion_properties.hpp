// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The rows a person edits in rviz's panel of displays.
#pragma once

#include "rviz_plugin/motion_style.hpp"

namespace rviz {
class BoolProperty;
class FloatProperty;
class IntProperty;
class Property;
class StringProperty;
}  // namespace rviz

namespace mvo_rviz {

/// The properties behind a MotionStyle, children of the display, which owns them.
class MotionProperties {
 public:
  /// Every change calls `changed_slot` of the display.
  MotionProperties(rviz::Property* display, const char* changed_slot);

  /// As chosen now; the ids are all if their text is not understood.
  MotionStyle style() const;

  /// One sentence on what is wrong with the text of the ids; empty if nothing is.
  std::string problemOfIds() const;

 private:
  rviz::BoolProperty* axes_;
  rviz::FloatProperty* axes_length_;
  rviz::BoolProperty* trail_;
  rviz::FloatProperty* trail_width_;
  rviz::IntProperty* trail_length_;
  rviz::BoolProperty* velocity_;
  rviz::FloatProperty* velocity_seconds_;
  rviz::BoolProperty* box_;
  rviz::FloatProperty* box_line_width_;
  rviz::BoolProperty* covariance_;
  rviz::FloatProperty* sigmas_;
  rviz::BoolProperty* text_;
  rviz::FloatProperty* text_height_;
  rviz::BoolProperty* hide_static_;
  rviz::StringProperty* ids_;
  rviz::FloatProperty* alpha_;
};

}  // namespace mvo_rviz
