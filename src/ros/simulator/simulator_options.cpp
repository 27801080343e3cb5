// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/simulator/simulator_options.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "option_table.hpp"
#include "ros/parameters/parameters.hpp"

namespace mvo_ros {

namespace {

mvo::OptionTable optionTable(SimulatorOptions& options, std::size_t& scene) {
  constexpr int kMany = 1000000;
  constexpr int kMostPrerendered = 2000;
  mvo::OptionTable table;
  table.choice("scene", scene, mvo::sim::sceneNames(), "what is seen");
  table.number("seed", options.seed, 0, 1000 * kMany, "", "of textures, layout and motions");
  table.choice("sensor", options.sensor, {"stereo", "rgbd"}, "the camera's kind");
  table.number("rate", options.camera.rate_hz, 0.1, 1000.0, "Hz", "frames per second");
  table.number("width", options.camera.width, 64, 4096, "px", "of the images");
  table.number("height", options.camera.height, 48, 4096, "px", "of the images");
  table.number("noise", options.camera.noise, 0.0, 100.0, "grey levels", "of a pixel");
  table.number("frames", options.frames, 0, kMany, "frames", "to publish; 0: without end");
  table.number("prerender", options.prerender, 0, kMostPrerendered, "frames",
               "to render first and then play to and fro; 0: render as they are shown");
  table.flag("wait", options.wait, "for a subscriber of every image");
  table.number("gain", options.camera.gain, 0.1, 10.0, "",
               "brightness of the right image relative to the left");
  table.number("blur", options.camera.blur, 0.0, 1.0, "",
               "exposure time as a share of the frame period");
  table.word("odom_frame", options.odom_frame, "frame of the truth");
  table.word("base_frame", options.base_frame, "frame of the robot that carries the camera");
  const auto more = mvo::sim::optionTable(options.camera.imperfections);
  table.rows.insert(table.rows.end(), more.begin(), more.end());
  return table;
}

// Size and rate of the scene that is asked for; an unknown one is complained about elsewhere.
void takeFormat(const KeyValues& keys, mvo::sim::SceneOptions& camera) {
  const auto names = mvo::sim::sceneNames();
  for (const auto& [key, value] : keys)
    if (key == "scene" && std::find(names.begin(), names.end(), value) != names.end())
      camera = mvo::sim::usualOptions(value);
}

}  // namespace

SimulatorOptions simulatorOptions(const XmlRpc::XmlRpcValue& tree) {
  SimulatorOptions out;
  const auto names = mvo::sim::sceneNames();
  auto scene =
      static_cast<std::size_t>(std::find(names.begin(), names.end(), out.scene) - names.begin());
  const KeyValues keys = flatten(tree);
  takeFormat(keys, out.camera);
  const mvo::OptionTable table = optionTable(out, scene);
  for (const auto& [key, value] : keys) {
    const auto row = std::find_if(table.rows.begin(), table.rows.end(),
                                  [name = key](const auto& r) { return r.name == name; });
    if (row == table.rows.end()) {
      std::ostringstream known;
      for (const auto& r : table.rows) known << (known.tellp() > 0 ? ", " : "") << r.name;
      throw std::invalid_argument("there is no parameter '" + key + "'; there are " + known.str());
    }
    row->set(value);
  }
  if (out.odom_frame.empty() || out.base_frame.empty())
    throw std::invalid_argument("odom_frame and base_frame must be names");
  out.scene = names.at(scene);
  out.camera.rgbd = out.sensor == Sensor::kRgbd;
  out.camera.validate();
  return out;
}

}  // namespace mvo_ros
