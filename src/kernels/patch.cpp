// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/patch.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace mvo {

namespace {

// Where a patch whose first pixel is at (u, v) lies between whole pixels.
struct Corner {
  const std::uint8_t* p;
  float a;
  float b;
};
MVO_INLINE Corner cornerAt(const GreyImage& image, float u, float v) {
  const float fu = std::floor(u);
  const float fv = std::floor(v);
  return {image.data + static_cast<std::ptrdiff_t>(fv) * image.step + static_cast<int>(fu), u - fu,
          v - fv};
}
template <typename M>
MVO_INLINE Floats between(const std::uint8_t* p, float a) {
  const Floats left = M::bytes(p);
  return fused<M>(a, M::bytes(p + 1) - left, left);
}

// 1 in the first n lanes, 0 in the others.
MVO_INLINE Floats insideOf(int n) {
  static const float inside[2 * kFloats] = {1, 1, 1, 1, 1, 1, 1, 1};
  return load(inside + kFloats - std::min(n, kFloats));
}

// Values and gradients at eight pixels of a patch that has a pixel more on every side.
struct Slopes {
  Floats v;
  Floats x;
  Floats y;
};
MVO_INLINE Slopes slopesAt(const float* centre, int stride, float level, const Floats& inside) {
  return {inside * (load(centre) - level), 0.5F * inside * (load(centre + 1) - load(centre - 1)),
          0.5F * inside * (load(centre + stride) - load(centre - stride))};
}

// Sums over a patch of values and gradients as they are, and of their products.
struct PatchSums {
  float v, x, y, vv, vx, vy, xx, xy, yy;
};
template <typename M>
MVO_INLINE PatchSums sumsOf(const float* first, int stride, int side, float level) {
  Floats v = {};
  Floats x = {};
  Floats y = {};
  Floats vv = {};
  Floats vx = {};
  Floats vy = {};
  Floats xx = {};
  Floats xy = {};
  Floats yy = {};
  for (int column = 0; column < side; column += kFloats) {
    const Floats inside = insideOf(side - column);
    for (int row = 0; row < side; ++row) {
      const Slopes s = slopesAt(first + row * stride + column, stride, level, inside);
      v += s.v;
      x += s.x;
      y += s.y;
      vv = fused<M>(s.v, s.v, vv);
      vx = fused<M>(s.v, s.x, vx);
      vy = fused<M>(s.v, s.y, vy);
      xx = fused<M>(s.x, s.x, xx);
      xy = fused<M>(s.x, s.y, xy);
      yy = fused<M>(s.y, s.y, yy);
    }
  }
  return {sum(v), sum(x), sum(y), sum(vv), sum(vx), sum(vy), sum(xx), sum(xy), sum(yy)};
}

// `side` rows of the image around (u, v), between its pixels.
template <typename M>
MVO_INLINE void readSquare(const GreyImage& image, float u, float v, int side, float* values) {
  const int stride = paddedToLanes(side);
  const int half_side = side / 2;
  const auto half = static_cast<float>(half_side);
  const Corner c = cornerAt(image, u - half, v - half);
  for (int x = 0; x < side; x += kFloats) {
    const std::uint8_t* p = c.p + x;
    Floats above = between<M>(p, c.a);
    for (int y = 0; y < side; ++y) {
      p += image.step;
      const Floats below = between<M>(p, c.a);
      store(values + y * stride + x, fused<M>(c.b, below - above, above));
      above = below;
    }
  }
}

template <typename M>
MVO_INLINE void takeFlowPatchOn(const GreyImage& image, float u, float v, int side, float* room,
                                FlowPatch& patch) {
  const int wide = side + 2;  // one pixel more on every side, for the derivatives
  const int stride = paddedToLanes(wide);
  readSquare<M>(image, u, v, wide, room);
  const float* first = room + stride + 1;
  // Values relative to the centre's: they stay exact when products are subtracted.
  const float level = first[side / 2 * (stride + 1)];
  const PatchSums s = sumsOf<M>(first, stride, side, level);
  const float share = 1.0F / static_cast<float>(side * side);
  const float mean = share * s.v;
  const float mean_x = share * s.x;
  const float mean_y = share * s.y;
  patch.square = fused<M>(-mean, s.v, s.vv);
  const float vx = fused<M>(-mean, s.x, s.vx);
  const float vy = fused<M>(-mean, s.y, s.vy);
  const float along_x = patch.square > 0 ? vx / patch.square : 0.0F;
  const float along_y = patch.square > 0 ? vy / patch.square : 0.0F;
  patch.hxx = fused<M>(-along_x, vx, fused<M>(-mean_x, s.x, s.xx));
  patch.hxy = fused<M>(-along_x, vy, fused<M>(-mean_x, s.y, s.xy));
  patch.hyy = fused<M>(-along_y, vy, fused<M>(-mean_y, s.y, s.yy));
  const int row = paddedToLanes(side);
  for (int x = 0; x < side; x += kFloats) {
    const Floats inside = insideOf(side - x);
    for (int y = 0; y < side; ++y) {
      const Slopes slopes = slopesAt(first + y * stride + x, stride, level, inside);
      const Floats value = slopes.v - mean * inside;
      store(patch.values + y * row + x, value);
      store(patch.gx + y * row + x, fused<M>(-along_x, value, slopes.x - mean_x * inside));
      store(patch.gy + y * row + x, fused<M>(-along_y, value, slopes.y - mean_y * inside));
    }
  }
}

template <typename M>
MVO_INLINE FlowSums flowSumsOn(const GreyImage& image, float u, float v, int side,
                               const FlowPatch& patch) {
  const int row = paddedToLanes(side);
  const int half_side = side / 2;
  const auto half = static_cast<float>(half_side);
  const Corner c = cornerAt(image, u - half, v - half);
  Floats bx = {};
  Floats by = {};
  Floats product = {};
  for (int x = 0; x < side; x += kFloats) {
    const std::uint8_t* p = c.p + x;
    Floats above = between<M>(p, c.a);
    for (int y = 0; y < side; ++y) {
      p += image.step;
      const Floats below = between<M>(p, c.a);
      const int i = y * row + x;
      const Floats s = fused<M>(c.b, below - above, above);
      bx = fused<M>(s, load(patch.gx + i), bx);
      by = fused<M>(s, load(patch.gy + i), by);
      product = fused<M>(s, load(patch.values + i), product);
      above = below;
    }
  }
  return {sum(bx), sum(by), sum(product)};
}

// The pixels around eight places. (AVX2's gather is no faster than these loads.)
struct Quads {
  Floats top_left;
  Floats top_right;
  Floats bottom_left;
  Floats bottom_right;
};
MVO_INLINE Quads quadsAt(const GreyImage& image, const Ints& at) {
  std::int32_t place[kFloats];
  std::memcpy(place, &at, sizeof place);
  Ints top;
  Ints bottom;
  for (int lane = 0; lane < kFloats; ++lane) {
    const std::uint8_t* p = image.data + place[lane];
    top[lane] = p[0] | p[1] << 8;
    bottom[lane] = p[image.step] | p[image.step + 1] << 8;
  }
  return {toFloats(top & 255), toFloats(top >> 8), toFloats(bottom & 255), toFloats(bottom >> 8)};
}

template <typename M>
MVO_INLINE AffineSums affineSumsOn(const GreyImage& image, const float (&warp)[6],
                                   const AffinePatch& patch) {
  Floats mean = {};
  Floats square = {};
  Floats product = {};
  Floats descent[6] = {};
  const auto step = static_cast<std::int32_t>(image.step);
  for (int i = 0; i < patch.n; i += kFloats) {
    const Floats x = load(patch.x + i);
    const Floats y = load(patch.y + i);
    const Floats u = fused<M>(warp[0], x, warp[1] * y) + warp[4];
    const Floats v = fused<M>(warp[2], x, warp[3] * y) + warp[5];
    const Ints iu = __builtin_convertvector(u, Ints);
    const Ints iv = __builtin_convertvector(v, Ints);
    const Ints at = iv * step + iu;
    const Quads quads = quadsAt(image, at);
    const Floats a = u - toFloats(iu);
    const Floats b = v - toFloats(iv);
    const Floats above = fused<M>(a, quads.top_right - quads.top_left, quads.top_left);
    const Floats below = fused<M>(a, quads.bottom_right - quads.bottom_left, quads.bottom_left);
    const Floats s = fused<M>(b, below - above, above) - patch.offset;
    const Floats ws = load(patch.weight + i) * s;
    mean += ws;
    square = fused<M>(ws, s, square);
    product = fused<M>(ws, load(patch.value + i), product);
    for (int r = 0; r < 6; ++r)
      descent[r] = fused<M>(s, load(patch.descent + r * patch.n + i), descent[r]);
  }
  AffineSums sums;
  sums.mean = sum(mean);
  sums.square = sum(square);
  sums.product = sum(product);
  for (int r = 0; r < 6; ++r) sums.descent[r] = sum(descent[r]);
  return sums;
}

// Correlation from sums over a patch's n pixels; none with what has hardly any texture.
MVO_INLINE float correlation(float sum, float square, float product, int n) {
  constexpr float least_variance = 0.5F;  // [grey levels^2]
  const float variance = square - sum * sum / static_cast<float>(n);
  return variance > least_variance * static_cast<float>(n) ? product / std::sqrt(variance) : 0;
}

template <typename M>
MVO_INLINE void rowCorrelationsOn(const std::uint8_t* corner, std::ptrdiff_t step, int side,
                                  const float* patch, int count, float* correlations) {
  const int n = side * side;
  if (count < kFloats) {
    for (int i = 0; i < count; ++i) {
      float sum = 0;
      float square = 0;
      float product = 0;
      for (int k = 0; k < n; ++k) {
        const std::uint8_t value = corner[k / side * step + k % side + i];
        const float s = value;
        sum += s;
        square = fused<M>(s, s, square);
        product = fused<M>(s, patch[k], product);
      }
      correlations[i] = correlation(sum, square, product, n);
    }
    return;
  }
  for (int start = 0; start < count; start += kFloats) {
    const int first = std::min(start, count - kFloats);
    Floats sum = {};
    Floats square = {};
    Floats product = {};
    for (int y = 0; y < side; ++y) {
      const std::uint8_t* p = corner + y * step + first;
      for (int x = 0; x < side; ++x) {
        const Floats s = M::bytes(p + x);
        sum += s;
        square = fused<M>(s, s, square);
        product = fused<M>(patch[y * side + x], s, product);
      }
    }
    for (int i = 0; i < kFloats; ++i)
      correlations[first + i] = correlation(sum[i], square[i], product[i], n);
  }
}

}  // namespace

void takeFlowPatch(const GreyImage& image, float u, float v, int side, float* room,
                   FlowPatch& patch) {
  onThisMachine([&](auto machine) MVO_KERNEL {
    return takeFlowPatchOn<decltype(machine)>(image, u, v, side, room, patch);
  });
}

FlowSums flowSums(const GreyImage& image, float u, float v, int side, const FlowPatch& patch) {
  return onThisMachine([&](auto machine) MVO_KERNEL {
    return flowSumsOn<decltype(machine)>(image, u, v, side, patch);
  });
}

AffineSums affineSums(const GreyImage& image, const float (&warp)[6], const AffinePatch& patch) {
  return onThisMachine(
      [&](auto machine) MVO_KERNEL { return affineSumsOn<decltype(machine)>(image, warp, patch); });
}

void rowCorrelations(const std::uint8_t* corner, std::ptrdiff_t step, int side, const float* patch,
                     int count, float* correlations) {
  onThisMachine([&](auto machine) MVO_KERNEL {
    return rowCorrelationsOn<decltype(machine)>(corner, step, side, patch, count, correlations);
  });
}

}  // namespace mvo
