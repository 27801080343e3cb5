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

// A pair of eyes in images of the usual size.
struct Lens {
  double focal = 500;      // [px]
  double cu = 318.6;       // [px]
  double cv = 243.2;       // [px]
  double baseline = 0.24;  // [m]
};

// A scene, the camera that sees it, and the size and rate it is made for.
struct Entry {
  const char* name;
  Scene (*layout)(Scene);
  const char* summary;
  Lens lens = {};
  int width = 640;
  int height = 480;
  double rate_hz = 15;
};

constexpr Lens kStreetLens{718.9, 607.2, 185.2, 0.537};

constexpr std::array<Entry, 11> kScenes = {{
    {"blocks", blocksScene,
     "four hanging blocks: two swing, one swings and turns, one turns; handheld camera"},
    {"spin", spinScene, "a checkerboard turns about the optical axis"},
    {"static", staticScene, "nothing but the camera moves"},
    {"occlusion", occlusionScene, "a box slides behind a pillar and back, a prism turns"},
    {"cars", carsScene, "three cars stop and go on the floor"},
    {"street", streetScene, "a street with bends, a crossing and five moving cars, from a car",
     kStreetLens, 1241, 376, 10},
    {"people", peopleScene, "a cart rolls, two people made of swinging limbs walk"},
    {"passing", passingScene, "a block passes close and fills two thirds of the view"},
    {"twelve", twelveScene, "twelve hanging bodies of about 55 px"},
    {"corridor", corridorScene, "plain walls with few features, a cart rolls ahead"},
    {"slow", slowScene, "five bodies move by 0.2 to 1 px per frame"},
}};

const Entry& entryOf(const std::string& name) {
  for (const Entry& entry : kScenes)
    if (name == entry.name) return entry;
  std::string message = "unknown scene \"" + name + "\", known are:";
  for (const Entry& entry : kScenes) message += std::string(" ") + entry.name;
  throw std::invalid_argument(message);
}

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

StereoCamera cameraFor(const SceneOptions& options, const Entry& entry) {
  constexpr double kVirtual = 0.1;  // baseline of RGB-D [m]
  const Lens& lens = entry.lens;
  const double scale = static_cast<double>(options.width) / entry.width;
  StereoCamera camera;
  camera.fu = camera.fv = lens.focal * scale;
  camera.cu = lens.cu * scale;
  camera.cv = (options.height - entry.height * scale) / 2 + lens.cv * scale;
  camera.baseline = options.rgbd ? kVirtual : lens.baseline;
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
  requireRange("right_tangential", imperfections.right_tangential, -most, most);
  if (rgbd) requireNoSecondEye(imperfections);
}

std::int64_t Scene::stampNs(int frame) const {
  constexpr std::int64_t kStart = 1'500'000'000'000'000'000;
  return kStart + static_cast<std::int64_t>(std::llround(1e9 * time(frame)));
}

std::vector<std::string> sceneNames() {
  std::vector<std::string> names;
  names.reserve(kScenes.size());
  for (const Entry& entry : kScenes) names.emplace_back(entry.name);
  return names;
}

std::string sceneSummary(const std::string& name) { return entryOf(name).summary; }

SceneOptions usualOptions(const std::string& name) {
  const Entry& entry = entryOf(name);
  SceneOptions options;
  options.width = entry.width;
  options.height = entry.height;
  options.rate_hz = entry.rate_hz;
  return options;
}

Scene makeScene(const std::string& name, std::uint64_t seed, const SceneOptions& options) {
  options.validate();
  const Entry& entry = entryOf(name);
  Scene scene;
  scene.name = name;
  scene.seed = seed;
  scene.options = options;
  scene.camera = cameraFor(options, entry);
  scene.hood = hoodFaces(scene, options.imperfections.hood);
  return entry.layout(std::move(scene));
}

Scene makeScene(const std::string& name, std::uint64_t seed) {
  return makeScene(name, seed, usualOptions(name));
}

}  // namespace mvo::sim
