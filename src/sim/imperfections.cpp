// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/imperfections.hpp"

#include "option_table.hpp"

namespace mvo::sim {

std::vector<OptionEntry> optionTable(Imperfections& imperfections) {
  Imperfections& o = imperfections;
  OptionTable table;
  table.number("right_yaw", o.right_yaw, -5.0, 5.0, "deg",
               "turn of the right eye about its vertical axis, positive looks outwards");
  table.number("right_pitch", o.right_pitch, -5.0, 5.0, "deg",
               "turn of the right eye about its horizontal axis, positive looks up");
  table.number("right_roll", o.right_roll, -5.0, 5.0, "deg",
               "turn of the right eye about its optical axis, positive is clockwise");
  table.number("right_focal", o.right_focal, -0.1, 0.1, "",
               "the right eye's focal length is longer by this share");
  table.number("right_center_u", o.right_center_u, -50.0, 50.0, "px",
               "the right eye's principal point lies further to the right");
  table.number("right_center_v", o.right_center_v, -50.0, 50.0, "px",
               "the right eye's principal point lies further down");
  table.number(
      "right_radial", o.right_radial, -20.0, 20.0, "px",
      "the right eye sees points half a diagonal off further out, with the cube of radius");
  table.number(
      "right_tangential", o.right_tangential, -20.0, 20.0, "px",
      "the right eye sees points half a diagonal to either side further to the right, as a "
      "lens that is tilted does");
  table.number("right_delay", o.right_delay, -0.1, 0.1, "s", "the right eye exposes later");
  table.number("readout", o.readout, 0.0, 0.2, "s",
               "from first to last row of both eyes; stamps and poses are the middle row's");
  table.number("exposure", o.exposure, 0.01, 100.0, "",
               "factor of the brightness from exposure_frame on");
  table.number("exposure_frame", o.exposure_frame, 0, 1000000, "frames",
               "first frame that is darker or brighter by exposure");
  table.number("flicker", o.flicker, 0.0, 1.0, "", "share by which the lamps' brightness swings");
  table.number("flicker_hz", o.flicker_hz, 0.0, 1000.0, "Hz", "frequency of the flicker");
  table.number("defocus", o.defocus, 0.0, 20.0, "px", "standard deviation of the lenses' blur");
  table.number("jpeg", o.jpeg, 0, 100, "", "quality of JPEG compression; 0: none");
  table.number("hood", o.hood, 0.0, 0.9, "",
               "share of the left image's height that what carries the camera covers from below");
  table.number("dots", o.dots, 0, 20000, "",
               "dots that a projector between the eyes throws on what they see");
  return table.rows;
}

void Imperfections::validate() const {
  Imperfections copy = *this;
  for (const OptionEntry& row : optionTable(copy)) row.set(row.get());
}

}  // namespace mvo::sim
