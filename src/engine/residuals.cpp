// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/residuals.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>

#include "kernels/link_residual.hpp"
#include "kernels/tracks.hpp"
#include "statistics.hpp"

namespace mvo {

ResidualCache::ResidualCache(const Window& window, const StereoCamera& camera,
                             const NoiseOptions& noise, const EnergyOptions& options)
    : window_(window),
      camera_(camera),
      noise_(noise),
      options_(options),
      tracks_(std::make_shared<const TrackArrays>(window, camera)) {}

const ResidualCache::Column& ResidualCache::column(const Label& label) {
  const auto known = columns_.find(label.key());
  if (known != columns_.end()) return known->second;
  const int n = static_cast<int>(window_.tracklets.size());
  const LinkResidual residual(camera_, noise_, options_.residual);
  const LabelResiduals under(window_, *tracks_, label.trajectory, residual, options_.long_pairs);
  Column column{Eigen::VectorXd::Constant(n, Energy::kInadmissible),
                Eigen::VectorXd::Constant(n, Energy::kInadmissible)};
  cv::parallel_for_(cv::Range(0, n), [&](const cv::Range& range) {
    for (int p = range.start; p < range.end; ++p) {
      const Worst worst = under.worst(p);
      if (worst.shared < 0) continue;
      column.overlap(p) = worst.shared;
      column.worst(p) = worst.missing ? std::max(worst.shared, options_.threshold) : worst.shared;
    }
  });
  return columns_.emplace(label.key(), std::move(column)).first->second;
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
  return median(std::move(values));
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
