// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/frame_pairs.hpp"

#include <cmath>
#include <limits>

#include "kernels/lanes.hpp"

namespace mvo {

namespace {

constexpr int kFields = 6;
constexpr int kBlock = kFields * kFloats;
constexpr int kPatience = 4;  // blocks between two looks at the score so far
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Matrix34 {
  float entry[12];  // row by row

  explicit Matrix34(const Eigen::Isometry3d& T) {
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column)
        entry[4 * row + column] = static_cast<float>(T(row, column));
  }
};

template <typename M, ResidualModel kModel>
MVO_INLINE void blockResidual(const LinkConstants<EightLinks>& k, const Matrix34& T,
                              const float* block, Floats& e2) {
  const auto* value = reinterpret_cast<const Floats*>(block);
  squaredResidual<M, EightLinks, kModel>(k, T.entry, {value[0], value[1], value[2]},
                                         {value[3], value[4], value[5]}, e2);
}

// Floats that are filled up count as outliers.
template <typename M, ResidualModel kModel>
MVO_INLINE float scoreBlocks(const LinkConstants<EightLinks>& k, const Matrix34& T,
                             const float* data, int blocks, bool count, float threshold,
                             float best) {
  const float scale = 1.0F / (threshold * threshold);
  const Floats one = Floats{} + 1.0F;
  Floats sum = {};
  float total = 0;
  for (int i = 0; i < blocks; ++i) {
    Floats e2;
    blockResidual<M, kModel>(k, T, data + i * kBlock, e2);
    e2 *= scale;
    sum += e2 < one ? (count ? Floats{} : e2) : one;
    if (i % kPatience != kPatience - 1 && i != blocks - 1) continue;
    total = 0;
    for (int lane = 0; lane < kFloats; ++lane) total += sum[lane];
    if (total >= best) return kInfinity;
  }
  return total;
}

template <typename M, ResidualModel kModel>
MVO_INLINE void residualBlocks(const LinkConstants<EightLinks>& k, const Matrix34& T,
                               const float* data, int blocks, float* e2) {
  for (int i = 0; i < blocks; ++i)
    blockResidual<M, kModel>(k, T, data + i * kBlock, *reinterpret_cast<Floats*>(e2 + i * kFloats));
}

template <typename M>
MVO_INLINE float scoreAny(ResidualModel model, const LinkConstants<EightLinks>& k,
                          const Matrix34& T, const float* data, int blocks, bool count,
                          float threshold, float best) {
  return model == ResidualModel::kWhitened
             ? scoreBlocks<M, ResidualModel::kWhitened>(k, T, data, blocks, count, threshold, best)
             : scoreBlocks<M, ResidualModel::kImageDistance>(k, T, data, blocks, count, threshold,
                                                             best);
}

template <typename M>
MVO_INLINE void residualAny(ResidualModel model, const LinkConstants<EightLinks>& k,
                            const Matrix34& T, const float* data, int blocks, float* e2) {
  if (model == ResidualModel::kWhitened)
    residualBlocks<M, ResidualModel::kWhitened>(k, T, data, blocks, e2);
  else
    residualBlocks<M, ResidualModel::kImageDistance>(k, T, data, blocks, e2);
}

}  // namespace

PairArrays::PairArrays(const std::vector<StereoPair>& pairs, const LinkResidual& residual)

    : constants_(residual.camera(), residual.disparityVariance()),
      model_(residual.model()),
      pairs_(static_cast<int>(pairs.size())) {
  const std::size_t blocks = (pairs.size() + kFloats - 1) / kFloats;
  data_.assign(blocks * kBlock, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const LinkPoint<EightLinks> from(residual.camera(), pairs[i].y_a);
    const LinkPoint<EightLinks> seen(residual.camera(), pairs[i].y_b);
    float* lane = &data_[i / kFloats * kBlock + i % kFloats];
    for (const float value : {from.x, from.y, from.d, seen.x, seen.y, seen.d}) {
      *lane = value;
      lane += kFloats;
    }
  }
}

float PairArrays::score(const Eigen::Isometry3d& T_b_a, Ranking ranking, float threshold,
                        float best) const {
  const int blocks = static_cast<int>(data_.size()) / kBlock;
  const auto filling = static_cast<float>(blocks * kFloats - pairs_);
  const Matrix34 T(T_b_a);
  const bool count = ranking == Ranking::kCount;
  const float score = onThisMachine([&](auto machine) MVO_KERNEL {
    return scoreAny<decltype(machine)>(model_, constants_, T, data_.data(), blocks, count,
                                       threshold, best + filling);
  });
  return score - filling;
}

std::vector<char> PairArrays::inliers(const Eigen::Isometry3d& T_b_a, float threshold) const {
  const int blocks = static_cast<int>(data_.size()) / kBlock;
  const Matrix34 T(T_b_a);
  std::vector<float> e2(static_cast<std::size_t>(blocks) * kFloats);
  onThisMachine([&](auto machine) MVO_KERNEL {
    residualAny<decltype(machine)>(model_, constants_, T, data_.data(), blocks, e2.data());
  });
  std::vector<char> inlier;
  inlier.reserve(pairs_);
  for (int i = 0; i < pairs_; ++i) inlier.push_back(e2[i] < threshold * threshold ? 1 : 0);
  return inlier;
}

}  // namespace mvo
