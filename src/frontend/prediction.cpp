// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/prediction.hpp"

#include <algorithm>

namespace mvo {

namespace {

// How a point goes on: with a label's step, or, if it has none, as it last moved in the image.
struct Course {
  const LabelStep* step = nullptr;
  int motion = -1;                                       // which step
  Eigen::Vector3d image_step = Eigen::Vector3d::Zero();  // (u_l, v, u_r) per frame [px]
};

// A point that the window knows, in the last frame.
struct Followed {
  Eigen::Vector2d uv;
  Course course;
};

Eigen::Vector3d imageStep(const Tracklet& tracklet) {
  const Observation& b = tracklet.observations.back();
  const Observation& a = *(&b - 1);
  return (b.y - a.y) / static_cast<double>(b.frame - a.frame);
}

}  // namespace

TrackingPrior predictFeatures(const std::vector<Feature>& seen, const TrackletWindow& window,
                              const KnownMotions& motions, const StereoCamera& camera,
                              double min_disparity) {
  TrackingPrior prior;
  const auto predict = [&](const Feature& f, const Course& course) {
    if (course.step != nullptr) prior.motion_of[f.id] = course.motion;
    if (course.step == nullptr) {
      prior.predicted[f.id] = f.y + course.image_step;
    } else if (course.step->T_next_last && f.y.x() - f.y.z() >= min_disparity) {
      const Eigen::Vector3d p = *course.step->T_next_last * camera.backProject(f.y);
      if (p.z() > 0) prior.predicted[f.id] = camera.project(p);
    }
  };

  std::vector<Followed> followed;
  std::vector<const Feature*> fresh;
  for (const Feature& f : seen) {
    const TrackletId id = window.trackletOf(f.id);
    const auto index = window.find(id);
    if (!index) {
      fresh.push_back(&f);
      continue;
    }
    Course course;
    if (const auto it = motions.step_of.find(id); it != motions.step_of.end())
      course = {&motions.steps[it->second], it->second};
    else
      course.image_step = imageStep(window.window().tracklets[*index]);
    if (course.step == nullptr || course.step->is_body) prior.dense[f.id] = true;
    predict(f, course);
    followed.push_back({f.y.head<2>(), course});
  }
  if (followed.empty()) return prior;
  for (const Feature* f : fresh) {
    const auto nearest = std::min_element(
        followed.begin(), followed.end(), [f](const Followed& a, const Followed& b) {
          return (a.uv - f->y.head<2>()).squaredNorm() < (b.uv - f->y.head<2>()).squaredNorm();
        });
    predict(*f, nearest->course);
  }
  return prior;
}

}  // namespace mvo
