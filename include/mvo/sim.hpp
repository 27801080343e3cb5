// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes of boxes before a camera, whose every motion is known, and their images with exact truth.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "mvo/frame.hpp"
#include "mvo/imperfections.hpp"
#include "mvo/sequence.hpp"
#include "mvo/stereo_camera.hpp"

namespace mvo::sim {

struct Texture;

/// T_world_body (or T_world_camera) at a time [s]. The world's z points up.
using Motion = std::function<Eigen::Isometry3d(double)>;

/// A convex, planar, textured polygon, visible from the side its normal points to. Texel
/// coordinates of a point p of the body frame: (s, t) = (s_axis . p + s_offset, t_axis . p +
/// t_offset).
struct Face {
  std::vector<Eigen::Vector3d> corners;  ///< in the body frame, in order around the polygon [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< outward, unit length
  std::shared_ptr<const Texture> texture;
  Eigen::Vector3d s_axis = Eigen::Vector3d::Zero();  ///< [texels / m]
  Eigen::Vector3d t_axis = Eigen::Vector3d::Zero();  ///< [texels / m]
  double s_offset = 0;                               ///< [texels]
  double t_offset = 0;                               ///< [texels]
  cv::Vec3f tint{1, 1, 1};  ///< factors of blue, green and red; their luminance is 1
  bool counts = true;       ///< false for strings: drawn and labelled, but not part of the extent
};

/// A part of a body that moves on it, as a person's leg.
struct Limb {
  std::vector<Face> faces;
  Motion T_body_limb;
};

/// A body and its motion; rigid if it has no limbs.
struct Body {
  std::vector<Face> faces;
  Motion T_world_body;
  std::vector<Limb> limbs;
};

/// In masks, what carries the camera: neither the static world nor a body.
inline constexpr int kHoodLabel = 255;

/// How a scene is seen.
struct SceneOptions {
  int width = 640;       ///< [px]
  int height = 480;      ///< [px]
  double rate_hz = 15;   ///< frames per second
  bool rgbd = false;     ///< colour image and depth instead of a stereo pair
  double noise = 1.5;    ///< standard deviation of a pixel [grey levels]
  double gain = 1.02;    ///< brightness of the right image relative to the left
  double blur = 0;       ///< exposure time as a share of the frame period; 0 = none
  int blur_samples = 5;  ///< sub-frames that are averaged over the exposure
  Imperfections imperfections;

  /// Throws std::invalid_argument: one sentence with the option's name, value and range.
  void validate() const;
};

struct Scene {
  std::string name;
  std::uint64_t seed = 1;
  SceneOptions options;
  StereoCamera camera;  ///< as calibrated; RGB-D: the baseline is the library's usual virtual one
  Motion T_world_camera;
  std::vector<Face> room;    ///< everything that stands still, in the world frame
  std::vector<Body> bodies;  ///< label in masks and truth = index + 1
  std::vector<Face> hood;    ///< what carries the camera, in its frame

  double time(int frame) const { return frame / options.rate_hz; }  ///< [s]
  std::int64_t stampNs(int frame) const;
};

/// The names of all scenes, the calm ones first.
std::vector<std::string> sceneNames();

/// One sentence on what a scene shows. Throws std::invalid_argument for an unknown name.
std::string sceneSummary(const std::string& name);

/// Size and rate that a scene is made for. Throws std::invalid_argument for an unknown name.
SceneOptions usualOptions(const std::string& name);

/// The same name, seed and options give the same scene; another seed varies textures, layout and
/// motions. Throws std::invalid_argument for an unknown name (listing the scenes) or invalid
/// options.
Scene makeScene(const std::string& name, std::uint64_t seed, const SceneOptions& options);
/// With the usual options.
Scene makeScene(const std::string& name, std::uint64_t seed);

/// Poses belong to the middle of the exposure (of the middle row), masks and depth to the centres
/// of the left image's pixels.
struct RenderedFrame {
  int frame = 0;
  std::int64_t stamp_ns = 0;
  cv::Mat left;   ///< 8UC1; RGB-D: of `color`
  cv::Mat right;  ///< 8UC1; empty for RGB-D
  cv::Mat color;  ///< 8UC3 blue, green, red; empty for stereo
  cv::Mat depth;  ///< 32FC1, of the left image, without noise [m]
  cv::Mat mask;   ///< 8UC1, of the left image: 0 static, 1..n bodies, kHoodLabel
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  std::vector<Eigen::Isometry3d> T_world_bodies;
  std::vector<BodyVisibility> objects;  ///< one per body
};

/// The same scene and frame give the same bytes, in any order and from any number of threads.
RenderedFrame render(const Scene& scene, int frame);

/// What the library reads: grey stereo pair, or grey image and depth.
Frame toFrame(const RenderedFrame& rendered);

/// What goes into folders and bags; depth is rounded to millimetres, 0 beyond 65.535 m.
SequenceFrame toSequenceFrame(const RenderedFrame& rendered);

/// The camera, kind and rate of a scene.
SequenceInfo sequenceInfo(const Scene& scene);

}  // namespace mvo::sim
