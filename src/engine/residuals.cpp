// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/engine/residuals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core/utility.hpp>

#include "mvo/engine/link_residual.hpp"

namespace mvo {

namespace {

constexpr std::array<int, 4> kLongPairs = {2, 4, 8,
                                           16};  // frames between the two observations of a pair

struct Worst {
  double shared = -1;  // over pairs that the label has a transform for; negative: none
  bool missing = false;
};

// T_b_a of all pairs of a trajectory with the same number of frames between them, computed once for
// all tracklets.
class PairTransforms {
 public:
  PairTransforms(const Trajectory& trajectory, int frames_between)
      : first_(trajectory.first_frame) {
    const FrameId n = static_cast<FrameId>(trajectory.T_ck_c1.size());
    for (FrameId k = frames_between; k < n; ++k)
      T_b_a_.push_back(trajectory.between(first_ + k, first_ + k - frames_between));
    first_ += frames_between;
  }
  const Eigen::Isometry3d* to(FrameId b) const {
    if (b < first_ || b - first_ >= static_cast<FrameId>(T_b_a_.size()) || !T_b_a_[b - first_])
      return nullptr;
    return &*T_b_a_[b - first_];
  }

 private:
  FrameId first_;
  std::vector<std::optional<Eigen::Isometry3d>> T_b_a_;
};

class LabelResiduals {
 public:
  LabelResiduals(const Label& label, const LinkResidual& residual, bool long_pairs)
      : trajectory_(label.trajectory), residual_(residual) {
    steps_.emplace_back(trajectory_, 1);
    if (long_pairs)
      for (const int d : kLongPairs) steps_.emplace_back(trajectory_, d);
  }

  Worst operator()(const Tracklet& tracklet) const {
    Worst worst;
    const auto& o = tracklet.observations;
    for (std::size_t j = 1; j < o.size(); ++j) {
      if (o[j].frame - o[j - 1].frame == 1) {
        take(steps_[0].to(o[j].frame), o[j - 1], o[j], worst);
      } else {
        const auto T = trajectory_.between(o[j].frame, o[j - 1].frame);
        take(T ? &*T : nullptr, o[j - 1], o[j], worst);
      }
    }
    // Longer pairs thin out with their length, counted from the newest observation so that it is
    // always tested.
    for (std::size_t s = 1; s < steps_.size(); ++s) {
      const int d = kLongPairs[s - 1];
      const int stride = std::max(1, d / 2);
      for (int j = static_cast<int>(o.size()) - 1; j - 1 > 0; j -= stride) {
        const Observation* a =
            j >= d && o[j].frame - o[j - d].frame == d ? &o[j - d] : tracklet.find(o[j].frame - d);
        if (a != nullptr) take(steps_[s].to(o[j].frame), *a, o[j], worst);
      }
    }
    return worst;
  }

 private:
  void take(const Eigen::Isometry3d* T_b_a, const Observation& a, const Observation& b,
            Worst& worst) const {
    if (T_b_a == nullptr)
      worst.missing = true;
    else
      worst.shared = std::max(worst.shared, residual_(*T_b_a, a.y, b.y));
  }

  const Trajectory& trajectory_;
  const LinkResidual& residual_;
  std::vector<PairTransforms> steps_;
};

}  // namespace

ResidualCache::ResidualCache(const Window& window, const StereoCamera& camera,
                             const NoiseOptions& noise, const EnergyOptions& options)
    : window_(window), camera_(camera), noise_(noise), options_(options) {}

const ResidualCache::Column& ResidualCache::column(const Label& label) {
  const auto known = columns_.find(label.serial);
  if (known != columns_.end()) return known->second;
  const int n = static_cast<int>(window_.tracklets.size());
  const LinkResidual residual(camera_, noise_, options_.residual);
  const LabelResiduals under(label, residual, options_.long_pairs);
  Column column{Eigen::VectorXd::Constant(n, Energy::kInadmissible),
                Eigen::VectorXd::Constant(n, Energy::kInadmissible)};
  cv::parallel_for_(cv::Range(0, n), [&](const cv::Range& range) {
    for (int p = range.start; p < range.end; ++p) {
      const Worst worst = under(window_.tracklets[p]);
      if (worst.shared < 0) continue;
      column.overlap(p) = worst.shared;
      column.worst(p) = worst.missing ? std::max(worst.shared, options_.threshold) : worst.shared;
    }
  });
  return columns_.emplace(label.serial, std::move(column)).first->second;
}

const Eigen::VectorXd& ResidualCache::overlap(const Label& label) { return column(label).overlap; }

ResidualTable ResidualCache::table(const std::vector<Label>& labels) {
  ResidualTable table;
  table.worst.resize(static_cast<Eigen::Index>(window_.tracklets.size()),
                     static_cast<Eigen::Index>(labels.size()));
  table.overlap.resizeLike(table.worst);
  for (std::size_t l = 0; l < labels.size(); ++l) {
    const Column& c = column(labels[l]);
    table.worst.col(static_cast<Eigen::Index>(l)) = c.worst;
    table.overlap.col(static_cast<Eigen::Index>(l)) = c.overlap;
  }
  return table;
}

double typicalResidual(const std::vector<int>& support,
                       const Eigen::Ref<const Eigen::VectorXd>& overlap) {
  if (support.empty()) return 0;
  std::vector<double> values;
  values.reserve(support.size());
  for (const int p : support) values.push_back(overlap(p));
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double dataCost(double residual, const EnergyOptions& options) {
  return residual >= Energy::kInadmissible ? residual : std::max(0.0, residual - options.dead_zone);
}

Energy makeEnergy(const ResidualTable& table, const Graph& graph, const EnergyOptions& options) {
  const auto n = table.worst.rows();
  const auto labels = table.worst.cols();
  Energy energy;
  energy.data.resize(n, labels + 1);
  energy.data.leftCols(labels) =
      table.worst.unaryExpr([&options](double r) { return dataCost(r, options); });
  for (Eigen::Index p = 0; p < n; ++p) {
    const double best =
        labels == 0 ? Energy::kInadmissible : energy.data.row(p).head(labels).minCoeff();
    energy.data(p, labels) = options.outlier_scale * std::exp(-best / options.outlier_decay);
  }
  for (const auto& [p, q] : graph.edges) energy.edges.push_back({p, q, options.smoothness});
  energy.label_cost.setConstant(labels + 1, options.label_cost);
  energy.label_cost(labels) = 0;
  return energy;
}

}  // namespace mvo
