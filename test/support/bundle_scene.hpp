// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Small synthetic batches with exact truth, for tests and benchmarks of III-F.
#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "engine/batch/bundle_adjustment.hpp"
#include "mvo/se3.hpp"

namespace mvo::test {

/// A bundle that owns its observations. Poses are of consecutive frames, the first is C_1.
struct Batch {
  struct Landmark {
    TrackletId id = 0;
    Eigen::Vector4d p_c1 = Eigen::Vector4d::UnitW();  ///< as BatchTrack::p_c1
    std::vector<Observation> observations;
  };

  FrameId first_frame = 0;
  std::vector<Eigen::Isometry3d> T_ck_c1;
  std::vector<Landmark> landmarks;
};

/// The same as the adjuster takes it; refers to the batch's observations.
inline Bundle bundleOf(const Batch& batch) {
  Bundle bundle{batch.first_frame, batch.T_ck_c1, {}};
  for (const Batch::Landmark& landmark : batch.landmarks)
    bundle.tracks.push_back({landmark.p_c1, landmark.observations.data(),
                             landmark.observations.data() + landmark.observations.size()});
  return bundle;
}

inline BatchSummary adjustBundle(Batch& batch, const StereoCamera& camera,
                                 const NoiseOptions& noise, const BundleAdjustmentOptions& options,
                                 int iterations) {
  Bundle bundle = bundleOf(batch);
  BatchMemory memory;
  const BatchSummary summary =
      BundleAdjuster(camera, noise, options, memory).adjust(bundle, {iterations, true});
  batch.T_ck_c1 = bundle.T_ck_c1;
  for (std::size_t j = 0; j < bundle.tracks.size(); ++j)
    batch.landmarks[j].p_c1 = bundle.tracks[j].p_c1;
  return summary;
}

struct SceneOptions {
  int frames = 10;
  int points = 60;
  int far_points = 0;      ///< at 250 m and beyond
  int min_length = 4;      ///< observations of a tracklet, at least
  int max_length = 8;      ///< observations of a tracklet, at most
  double noise_scale = 1;  ///< of what NoiseOptions says
  double outliers = 0;     ///< share of observations that are anywhere
  double turn = 0.1;       ///< about y over the batch [rad]
  double shake = 1;        ///< of the start
  bool flat = false;       ///< all points on a plane that faces the first camera
  bool collinear = false;  ///< all points on a line
  unsigned seed = 1;
};

struct BundleScene {
  StereoCamera camera{500, 500, 319.5, 239.5, 0.24, 640, 480};
  NoiseOptions noise;
  Batch truth;  ///< its observations carry the noise
  Batch start;  ///< the same observations, poses and landmarks perturbed
};

/// Deterministic in its options; what outliers and far points add does not disturb the rest.
inline BundleScene makeBundleScene(const SceneOptions& options) {
  BundleScene scene;
  std::mt19937 random(options.seed);
  const auto uniform = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::normal_distribution<double> normal;
  const auto gauss = [&](double sigma) { return sigma * normal(random); };

  Batch& truth = scene.truth;
  truth.first_frame = 17;
  for (int k = 0; k < options.frames; ++k) {
    const double s = k / std::max(1.0, options.frames - 1.0);
    Vector6d xi;
    xi << -0.3 * s, 0.05 * s * s, -0.2 * s, 0.05 * s, -options.turn * s, 0.03 * s * s;
    truth.T_ck_c1.push_back(exp(xi));
  }

  std::mt19937 spoiler(options.seed + 1000003);
  const auto spoilt = [&] {
    return std::uniform_real_distribution<double>(0, 1)(spoiler) < options.outliers;
  };
  for (int j = 0; j < options.points + options.far_points; ++j) {
    const bool far = j >= options.points;
    // A point in view of the camera in the middle of its tracklet.
    const int length = std::min(
        options.frames, static_cast<int>(uniform(options.min_length, options.max_length + 1.0)));
    const int first = static_cast<int>(uniform(0, options.frames - length + 0.999));
    const auto& T_anchor_c1 = truth.T_ck_c1[static_cast<std::size_t>(first + length / 2)];
    const double u = uniform(60, 580);
    const double v = uniform(60, 420);
    const double depth = far            ? 1.0 / uniform(0.0, 1.0 / 250)
                         : options.flat ? 4.0
                                        : uniform(2.0, 9.0);
    const Eigen::Vector4d ray((u - scene.camera.cu) / scene.camera.fu,
                              (v - scene.camera.cv) / scene.camera.fv, 1, 1.0 / depth);
    Batch::Landmark landmark;
    landmark.id = 100 + j;
    landmark.p_c1 = T_anchor_c1.inverse().matrix() * ray;
    if (options.flat && !far) landmark.p_c1 << 4.0 * ray.head<3>(), 1;
    if (options.collinear) {
      const double along = uniform(-1, 1);
      landmark.p_c1 << along, 0.3 * along + 0.2, 4 + 0.5 * along, 1;
    }
    for (int k = first; k < first + length; ++k) {
      const auto& T = truth.T_ck_c1[static_cast<std::size_t>(k)];
      const Eigen::Vector4d q = T.matrix() * landmark.p_c1;
      const double ul = scene.camera.fu * q.x() / q.z() + scene.camera.cu;
      const double vl = scene.camera.fv * q.y() / q.z() + scene.camera.cv;
      const double disparity = scene.camera.fu * scene.camera.baseline * q.w() / q.z();
      const double noisy_u = ul + gauss(options.noise_scale * scene.noise.left);
      const double noisy_v = vl + gauss(options.noise_scale * scene.noise.left);
      const double noisy_d = disparity + gauss(options.noise_scale * scene.noise.disparity);
      Observation observation{truth.first_frame + k, {noisy_u, noisy_v, noisy_u - noisy_d}};
      if (spoilt()) {
        std::uniform_real_distribution<double> error(-40, 40);
        observation.y += Eigen::Vector3d(error(spoiler), error(spoiler), error(spoiler));
      }
      landmark.observations.push_back(observation);
    }
    truth.landmarks.push_back(landmark);
  }

  scene.start = truth;
  std::mt19937 shaker(options.seed + 2000003);
  std::normal_distribution<double> shake;
  for (std::size_t k = 1; k < scene.start.T_ck_c1.size(); ++k) {
    Vector6d xi;
    for (int i = 0; i < 6; ++i) xi(i) = options.shake * (i < 3 ? 0.02 : 0.005) * shake(shaker);
    scene.start.T_ck_c1[k] = exp(xi) * scene.start.T_ck_c1[k];
  }
  for (auto& landmark : scene.start.landmarks)
    landmark.p_c1.head<3>() *= 1.0 + std::clamp(0.05 * options.shake * shake(shaker), -0.2, 0.2);
  return scene;
}

}  // namespace mvo::test
