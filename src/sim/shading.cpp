// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/shading.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/texture.hpp"

namespace mvo::sim {
namespace {

constexpr int kChunk = 16;  // samples that share a level of detail

// std::floor is a function call without SSE 4.1.
int floorOf(float value) {
  const int whole = static_cast<int>(value);
  return whole - (value < static_cast<float>(whole) ? 1 : 0);
}

// Bilinear lookup in one level of a texture.
struct Level {
  const std::uint8_t* texels = nullptr;
  int s_mask = 0;
  int t_mask = 0;
  int s_shift = 0;  // log2 of the width
  float scale = 1;  // texels per texel of level 0

  float at(float s, float t) const {
    const float s_level = s * scale - 0.5F;
    const float t_level = t * scale - 0.5F;
    const int s_floor = floorOf(s_level);
    const int t_floor = floorOf(t_level);
    const float ds = s_level - static_cast<float>(s_floor);
    const float dt = t_level - static_cast<float>(t_floor);
    const int s0 = s_floor & s_mask;
    const int s1 = (s_floor + 1) & s_mask;
    const std::uint8_t* upper = texels + ((t_floor & t_mask) << s_shift);
    const std::uint8_t* lower = texels + (((t_floor + 1) & t_mask) << s_shift);
    const float above = blend(upper[s0], upper[s1], ds);
    const float below = blend(lower[s0], lower[s1], ds);
    return above + dt * (below - above);
  }

  static float blend(int a, int b, float share) {
    return static_cast<float>(a) + share * static_cast<float>(b - a);
  }
};

std::vector<Level> levelsOf(const Texture& texture) {
  std::vector<Level> levels;
  for (const cv::Mat& image : texture.levels) {
    Level level;
    level.texels = image.data;
    level.s_mask = image.cols - 1;
    level.t_mask = image.rows - 1;
    while ((1 << level.s_shift) < image.cols) ++level.s_shift;
    level.scale = std::ldexp(1.0F, -static_cast<int>(levels.size()));
    levels.push_back(level);
  }
  return levels;
}

// log2 of the texels of level 0 between neighbouring samples. Where a face is seen obliquely, half
// of the longer direction is left to the other samples of the pixel.
float levelOfDetail(const ProjectedFace& face, double u, double v) {
  const double z = 1.0 / face.inverse_depth.at(u, v);
  const double s = z * face.s.at(u, v);
  const double t = z * face.t.at(u, v);
  const auto squared = [&](double s_step, double t_step, double step) {
    const double ds = s_step - s * step;
    const double dt = t_step - t * step;
    return ds * ds + dt * dt;
  };
  const double along_u = squared(face.s.u, face.t.u, face.inverse_depth.u);
  const double along_v = squared(face.s.v, face.t.v, face.inverse_depth.v);
  const double texels =
      z * z * std::max(std::min(along_u, along_v), std::max(along_u, along_v) / 4);
  return 0.5F * std::log2(static_cast<float>(texels));
}

// The share of samples that takes the coarser of two levels grows with the level of detail: over
// the samples of a pixel this is trilinear filtering at the price of bilinear.
float dither(int u, int v) {
  constexpr std::array<float, 4> kThreshold = {0.125F, 0.625F, 0.875F, 0.375F};
  return kThreshold[(v & 1) * 2 + (u & 1)];
}

// A face with what is the same for all its samples.
struct Surface {
  const ProjectedFace* face = nullptr;
  std::vector<Level> levels;
  std::array<float, 3> factors{};  // of a texel in the sum, per channel
};

Surface surfaceFor(const ProjectedFace& face, bool colored, float weight, int n) {
  const float share = weight * face.shade / static_cast<float>(n * n);
  const cv::Vec3f tint = colored ? face.face->tint : cv::Vec3f(1, 1, 1);
  return {
      &face, levelsOf(*face.face->texture), {share * tint[0], share * tint[1], share * tint[2]}};
}

// Neighbouring samples of a row that see the same face.
struct Run {
  const Surface& surface;
  int row = 0;
  int first = 0;
  int last = 0;
  int n = 1;  // samples per pixel along a row
};

// The two levels that the samples of a chunk take, the finer first, and the coarser one's share.
struct Detail {
  std::array<const Level*, 2> levels{};
  float fraction = 0;

  const Level* at(int u, int v) const { return levels[fraction > dither(u, v) ? 1 : 0]; }
};

Detail detailAt(const Surface& surface, double u, double v) {
  const int coarsest = static_cast<int>(surface.levels.size()) - 1;
  const float detail = levelOfDetail(*surface.face, u, v);
  const int fine = floorOf(detail);
  return {{&surface.levels[std::clamp(fine, 0, coarsest)],
           &surface.levels[std::clamp(fine + 1, 0, coarsest)]},
          detail - static_cast<float>(fine)};
}

template <int kChannels>
void shadeRun(const Run& run, float* pixels) {
  const auto& [surface, row, first, last, n] = run;
  const ProjectedFace& face = *surface.face;
  const auto inverse_depth_step = static_cast<float>(face.inverse_depth.u);
  const auto s_step = static_cast<float>(face.s.u);
  const auto t_step = static_cast<float>(face.t.u);
  for (int begin = first; begin <= last; begin += kChunk) {
    const int end = std::min(begin + kChunk, last + 1);
    const Detail detail = detailAt(surface, 0.5 * (begin + end - 1), row);
    const auto inverse_depth = static_cast<float>(face.inverse_depth.at(begin, row));
    const auto s = static_cast<float>(face.s.at(begin, row));
    const auto t = static_cast<float>(face.t.at(begin, row));
    // Two loops, since the compiler can vectorize the first.
    std::array<float, kChunk> s_texel;
    std::array<float, kChunk> t_texel;
    for (int i = 0; i < kChunk; ++i) {
      const auto step = static_cast<float>(i);
      const float z = 1.0F / (inverse_depth + inverse_depth_step * step);
      s_texel[i] = z * (s + s_step * step);
      t_texel[i] = z * (t + t_step * step);
    }
    const std::array<const Level*, 2> by_column = {detail.at(begin, row),
                                                   detail.at(begin + 1, row)};
    for (int i = 0; i < end - begin; ++i) {
      const float value = by_column[i & 1]->at(s_texel[i], t_texel[i]);
      float* pixel = pixels + (begin + i) / n * kChannels;
      for (int c = 0; c < kChannels; ++c) pixel[c] += surface.factors[c] * value;
    }
  }
}

// The same where rays are bent: `points` are those of the whole row.
void shadeBentRun(const Run& run, int channels, const Eigen::Vector2d* points, float* pixels) {
  const auto& [surface, row, first, last, n] = run;
  const ProjectedFace& face = *surface.face;
  for (int begin = first; begin <= last; begin += kChunk) {
    const int end = std::min(begin + kChunk, last + 1);
    const Eigen::Vector2d& middle = points[(begin + end - 1) / 2];
    const Detail detail = detailAt(surface, middle.x(), middle.y());
    for (int column = begin; column < end; ++column) {
      const double u = points[column].x();
      const double v = points[column].y();
      const double z = 1 / face.inverse_depth.at(u, v);
      const float value = detail.at(column, row)
                              ->at(static_cast<float>(z * face.s.at(u, v)),
                                   static_cast<float>(z * face.t.at(u, v)));
      float* pixel = pixels + column / n * channels;
      for (int c = 0; c < channels; ++c) pixel[c] += surface.factors[c] * value;
    }
  }
}

}  // namespace

void shade(const std::vector<ProjectedFace>& faces, const Visibility& seen, int n, float weight,
           cv::Mat& sum, const BentRays* rays) {
  const bool colored = sum.channels() == 3;
  std::vector<Surface> surfaces(faces.size());
  const auto surfaceOf = [&](int index) -> const Surface& {
    Surface& surface = surfaces[index - 1];
    if (surface.face == nullptr) surface = surfaceFor(faces[index - 1], colored, weight, n);
    return surface;
  };
  for (int row = 0; row < seen.rows.count; ++row) {
    const std::size_t offset = static_cast<std::size_t>(row) * seen.width;
    const std::uint16_t* index = seen.index.data() + offset;
    auto* pixels = sum.ptr<float>((seen.rows.first + row) / n);
    int first = 0;
    while (first < seen.width) {
      int last = first;
      while (last + 1 < seen.width && index[last + 1] == index[first]) ++last;
      if (index[first] != 0) {
        const Run run{surfaceOf(index[first]), seen.rows.first + row, first, last, n};
        if (rays != nullptr) {
          shadeBentRun(run, sum.channels(), rays->points.data() + offset, pixels);
        } else if (colored) {
          shadeRun<3>(run, pixels);
        } else {
          shadeRun<1>(run, pixels);
        }
      }
      first = last + 1;
    }
  }
}

}  // namespace mvo::sim
