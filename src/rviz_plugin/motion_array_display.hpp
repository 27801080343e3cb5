// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// rviz's display of mvo/MotionArray: listens, checks, reports; a MotionVisual per motion draws.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#ifndef Q_MOC_RUN
#include <mvo/MotionArray.h>
#include <rviz/message_filter_display.h>

#include "rviz_plugin/motion_properties.hpp"
#include "rviz_plugin/motion_visual.hpp"
#endif

namespace mvo_rviz {

/// Draws the newest message; its status lines say in a sentence each what is wrong or missing.
class MotionArrayDisplay : public rviz::MessageFilterDisplay<mvo::MotionArray> {
  Q_OBJECT

 public:
  MotionArrayDisplay();
  ~MotionArrayDisplay() override;

  void reset() override;

 protected:
  void onInitialize() override;
  void subscribe() override;

 private:
  Q_SLOT void updateStyle();
  void checkFrame(const mvo::MotionArray::ConstPtr& message);
  void processMessage(const mvo::MotionArray::ConstPtr& message) override;
  void draw();
  bool isChosen(const mvo::Motion& motion) const;
  void reportWaiting();
  void reportUndrawn();
  void reportIds();
  void reportOdometry();
  void report(rviz::StatusProperty::Level level, const char* name, const std::string& sentence);

  MotionProperties properties_;
  MotionStyle style_;
  mvo::MotionArray::ConstPtr message_;                    // the drawn one
  std::map<int, std::unique_ptr<MotionVisual>> visuals_;  // by id
};

}  // namespace mvo_rviz
