// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "mvo/sim.hpp"
#include "sim/hood.hpp"
#include "sim/scenes.hpp"

namespace mvo::sim {
namespace {

using Layout = Scene (*)(Scene);

constexpr std::array<std::pair<const char*, Layout>, 5> kLayouts = {{{"blocks", blocksScene},
                                                                     {"spin", spinScene},
                                                                     {"static", staticScene},
                                                                     {"occlusion", occlusionScene},
                                                                     {"cars", carsScene}}};

void requireRange(const char* name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  std::ostringstream message;
  message << "simulation option " << name << " is " << value << ", it must be in [" << low << ", "
          << high << "]";
  throw std::invalid_argument(message.str());
}

// An RGB-D camera's depth is exact and its colours do not show an infrared projector's dots.
void requireNoSecondEye(Imperfections imperfections) {
  Imperfections exact;
  const auto rows = optionTable(imperfections);
  const auto exact_rows = optionTable(exact);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string& name = rows[i].name;
    if (name.rfind("right_", 0) != 0 && name != "dots") continue;
    if (rows[i].get() == exact_rows[i].get()) continue;
    throw std::invalid_argument("simulation option " + name + " is " + rows[i].get() +
                                ", an RGB-D camera takes only " + exact_rows[i].get());
  }
}

// A 640 x 480 camera of a usual lens, scaled with the width; the image's centre stays the centre.
StereoCamera cameraFor(const SceneOptions& options) {
  const double scale = options.width / 640.0;
  StereoCamera camera;
  camera.fu = camera.fv = 500 * scale;
  camera.cu = 318.6 * scale;
  camera.cv = (options.height - 480 * scale) / 2 + 243.2 * scale;
  camera.baseline = options.rgbd ? 0.1 : 0.24;
  camera.width = options.width;
  camera.height = options.height;
  return camera;
}

}  // namespace

void SceneOptions::validate() const {
  requireRange("width", width, 64, 4096);
  requireRange("height", height, 48, 4096);
  requireRange("rate_hz", rate_hz, 0.1, 1000);
  requireRange("noise", noise, 0, 100);
  requireRange("gain", gain, 0.1, 10);
  requireRange("blur", blur, 0, 1);
  requireRange("blur_samples", blur_samples, 2, 64);
  imperfections.validate();
  // Beyond this the edge of the image might fold over.
  const double most = 0.1 * 0.5 * std::hypot(width, height);
  requireRange("right_radial", imperfections.right_radial, -most, most);
  if (rgbd) requireNoSecondEye(imperfections);
}

std::int64_t Scene::stampNs(int frame) const {
  constexpr std::int64_t kStart = 1'500'000'000'000'000'000;
  return kStart + static_cast<std::int64_t>(std::llround(1e9 * time(frame)));
}

std::vector<std::string> sceneNames() {
  std::vector<std::string> names;
  names.reserve(kLayouts.size());
  for (const auto& [name, layout] : kLayouts) names.emplace_back(name);
  return names;
}

Scene makeScene(const std::string& name, std::uint64_t seed, const SceneOptions& options) {
  options.validate();
  for (const auto& [known, layout] : kLayouts) {
    if (name != known) continue;
    Scene scene;
    scene.name = name;
    scene.seed = seed;
    scene.options = options;
    scene.camera = cameraFor(options);
    scene.hood = hoodFaces(scene, options.imperfections.hood);
    return layout(std::move(scene));
  }
  std::string message = "unknown scene \"" + name + "\", known are:";
  for (const std::string& known : sceneNames()) message += " " + known;
  throw std::invalid_argument(message);
}

}  // namespace mvo::sim
