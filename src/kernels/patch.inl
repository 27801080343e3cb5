// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The kernels of patch.hpp, compiled once for each kind of machine.

// Eight lanes; the compiler makes of them what the target has.
using Bytes = std::uint8_t __attribute__((vector_size(kFloats)));
using Ints = std::int32_t __attribute__((vector_size(4 * kFloats)));
using Floats = float __attribute__((vector_size(4 * kFloats)));

inline Floats load(const float* p) {
  Floats v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline void store(float* p, const Floats& v) { std::memcpy(p, &v, sizeof v); }
inline Floats toFloats(const Ints& v) { return __builtin_convertvector(v, Floats); }
inline Floats loadBytes(const std::uint8_t* p) {
#ifdef MVO_KERNELS_USE_AVX2
  const __m128i v = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(p));
  return _mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(v));
#else
  Bytes v;
  std::memcpy(&v, p, sizeof v);
  return toFloats(__builtin_convertvector(v, Ints));
#endif
}
inline float sum(const Floats& v) {
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

// Where a patch whose first pixel is at (u, v) lies between whole pixels.
struct Corner {
  const std::uint8_t* p;
  float a;
  float b;
};
inline Corner cornerAt(const GreyImage& image, float u, float v) {
  const float fu = std::floor(u);
  const float fv = std::floor(v);
  return {image.data + static_cast<std::ptrdiff_t>(fv) * image.step + static_cast<int>(fu), u - fu,
          v - fv};
}
inline Floats between(const std::uint8_t* p, float a) {
  const Floats left = loadBytes(p);
  return left + a * (loadBytes(p + 1) - left);
}

// 1 in the first n lanes, 0 in the others.
inline Floats insideOf(int n) {
  static const float inside[2 * kFloats] = {1, 1, 1, 1, 1, 1, 1, 1};
  return load(inside + kFloats - std::min(n, kFloats));
}

// Values and gradients at eight pixels of a patch that has a pixel more on every side.
struct Slopes {
  Floats v;
  Floats x;
  Floats y;
};
inline Slopes slopesAt(const float* centre, int stride, float level, const Floats& inside) {
  return {inside * (load(centre) - level), 0.5F * inside * (load(centre + 1) - load(centre - 1)),
          0.5F * inside * (load(centre + stride) - load(centre - stride))};
}

// Sums over a patch of values and gradients as they are, and of their products.
struct PatchSums {
  float v, x, y, vv, vx, vy, xx, xy, yy;
};
inline PatchSums sumsOf(const float* first, int stride, int side, float level) {
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
      vv += s.v * s.v;
      vx += s.v * s.x;
      vy += s.v * s.y;
      xx += s.x * s.x;
      xy += s.x * s.y;
      yy += s.y * s.y;
    }
  }
  return {sum(v), sum(x), sum(y), sum(vv), sum(vx), sum(vy), sum(xx), sum(xy), sum(yy)};
}

// `side` rows of the image around (u, v), between its pixels.
inline void readSquare(const GreyImage& image, float u, float v, int side, float* values) {
  const int stride = paddedToLanes(side);
  const auto half = static_cast<float>(side / 2);
  const Corner c = cornerAt(image, u - half, v - half);
  for (int x = 0; x < side; x += kFloats) {
    const std::uint8_t* p = c.p + x;
    Floats above = between(p, c.a);
    for (int y = 0; y < side; ++y) {
      p += image.step;
      const Floats below = between(p, c.a);
      store(values + y * stride + x, above + c.b * (below - above));
      above = below;
    }
  }
}

void takeFlowPatch(const GreyImage& image, float u, float v, int side, float* room,
                   FlowPatch& patch) {
  const int wide = side + 2;  // one pixel more on every side, for the derivatives
  const int stride = paddedToLanes(wide);
  readSquare(image, u, v, wide, room);
  const float* first = room + stride + 1;
  // Values relative to the centre's: they stay exact when products are subtracted.
  const float level = first[side / 2 * (stride + 1)];
  const PatchSums s = sumsOf(first, stride, side, level);
  const float share = 1.0F / static_cast<float>(side * side);
  const float mean = share * s.v;
  const float mean_x = share * s.x;
  const float mean_y = share * s.y;
  patch.square = s.vv - mean * s.v;
  const float along_x = patch.square > 0 ? (s.vx - mean * s.x) / patch.square : 0.0F;
  const float along_y = patch.square > 0 ? (s.vy - mean * s.y) / patch.square : 0.0F;
  patch.hxx = s.xx - mean_x * s.x - along_x * (s.vx - mean * s.x);
  patch.hxy = s.xy - mean_x * s.y - along_x * (s.vy - mean * s.y);
  patch.hyy = s.yy - mean_y * s.y - along_y * (s.vy - mean * s.y);
  const int row = paddedToLanes(side);
  for (int x = 0; x < side; x += kFloats) {
    const Floats inside = insideOf(side - x);
    for (int y = 0; y < side; ++y) {
      const Slopes slopes = slopesAt(first + y * stride + x, stride, level, inside);
      const Floats value = slopes.v - mean * inside;
      store(patch.values + y * row + x, value);
      store(patch.gx + y * row + x, slopes.x - mean_x * inside - along_x * value);
      store(patch.gy + y * row + x, slopes.y - mean_y * inside - along_y * value);
    }
  }
}

FlowSums flowSums(const GreyImage& image, float u, float v, int side, const FlowPatch& patch) {
  const int row = paddedToLanes(side);
  const auto half = static_cast<float>(side / 2);
  const Corner c = cornerAt(image, u - half, v - half);
  Floats bx = {};
  Floats by = {};
  Floats product = {};
  for (int x = 0; x < side; x += kFloats) {
    const std::uint8_t* p = c.p + x;
    Floats above = between(p, c.a);
    for (int y = 0; y < side; ++y) {
      p += image.step;
      const Floats below = between(p, c.a);
      const int i = y * row + x;
      const Floats s = above + c.b * (below - above);
      bx += s * load(patch.gx + i);
      by += s * load(patch.gy + i);
      product += s * load(patch.values + i);
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
inline Quads quadsAt(const GreyImage& image, const Ints& at) {
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

AffineSums affineSums(const GreyImage& image, const float (&warp)[6], const AffinePatch& patch) {
  Floats mean = {};
  Floats square = {};
  Floats product = {};
  Floats descent[6] = {};
  const auto step = static_cast<std::int32_t>(image.step);
  for (int i = 0; i < patch.n; i += kFloats) {
    const Floats x = load(patch.x + i);
    const Floats y = load(patch.y + i);
    const Floats u = warp[0] * x + warp[1] * y + warp[4];
    const Floats v = warp[2] * x + warp[3] * y + warp[5];
    const Ints iu = __builtin_convertvector(u, Ints);
    const Ints iv = __builtin_convertvector(v, Ints);
    const Ints at = iv * step + iu;
    const Quads quads = quadsAt(image, at);
    const Floats a = u - toFloats(iu);
    const Floats b = v - toFloats(iv);
    const Floats above = quads.top_left + a * (quads.top_right - quads.top_left);
    const Floats below = quads.bottom_left + a * (quads.bottom_right - quads.bottom_left);
    const Floats s = above + b * (below - above) - patch.offset;
    const Floats ws = load(patch.weight + i) * s;
    mean += ws;
    square += ws * s;
    product += ws * load(patch.value + i);
    for (int r = 0; r < 6; ++r) descent[r] += s * load(patch.descent + r * patch.n + i);
  }
  AffineSums sums;
  sums.mean = sum(mean);
  sums.square = sum(square);
  sums.product = sum(product);
  for (int r = 0; r < 6; ++r) sums.descent[r] = sum(descent[r]);
  return sums;
}

// Correlation from sums over a patch's n pixels; none with what has hardly any texture.
inline float correlation(float sum, float square, float product, int n) {
  constexpr float least_variance = 0.5F;  // [grey levels^2]
  const float variance = square - sum * sum / static_cast<float>(n);
  return variance > least_variance * static_cast<float>(n) ? product / std::sqrt(variance) : 0;
}

void rowCorrelations(const std::uint8_t* corner, std::ptrdiff_t step, int side, const float* patch,
                     int count, float* correlations) {
  const int n = side * side;
  if (count < kFloats) {
    for (int i = 0; i < count; ++i) {
      float sum = 0;
      float square = 0;
      float product = 0;
      for (int k = 0; k < n; ++k) {
        const float s = corner[k / side * step + k % side + i];
        sum += s;
        square += s * s;
        product += s * patch[k];
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
        const Floats s = loadBytes(p + x);
        sum += s;
        square += s * s;
        product += s * patch[y * side + x];
      }
    }
    for (int i = 0; i < kFloats; ++i)
      correlations[first + i] = correlation(sum[i], square[i], product[i], n);
  }
}

// Smaller eigenvalue of ((xx, xy), (xy, yy)).
inline Floats smallerEigenvalue(const Floats& xx, const Floats& xy, const Floats& yy) {
  const Floats mean = 0.5F * (xx + yy);
  const Floats difference = 0.5F * (xx - yy);
  const Floats square = difference * difference + xy * xy;
#ifdef MVO_KERNELS_USE_AVX2
  return mean - Floats(_mm256_sqrt_ps(__m256(square)));
#else
  Floats root;
  for (int i = 0; i < kFloats; ++i) root[i] = std::sqrt(square[i]);
  return mean - root;
#endif
}

void gradientProducts(const std::uint8_t* row, std::ptrdiff_t step, int width, float* xx, float* xy,
                      float* yy) {
  constexpr float scale = 0.125F;  // Sobel's
  for (int start = 0; start < width; start += kFloats) {
    const int u = std::min(start, width - kFloats);
    const std::uint8_t* p = row + u;
    const Floats above_left = loadBytes(p - step - 1);
    const Floats above_right = loadBytes(p - step + 1);
    const Floats below_left = loadBytes(p + step - 1);
    const Floats below_right = loadBytes(p + step + 1);
    const Floats gx = scale * (above_right - above_left + below_right - below_left +
                               2.0F * (loadBytes(p + 1) - loadBytes(p - 1)));
    const Floats gy = scale * (below_left - above_left + below_right - above_right +
                               2.0F * (loadBytes(p + step) - loadBytes(p - step)));
    store(xx + u, gx * gx);
    store(xy + u, gx * gy);
    store(yy + u, gy * gy);
  }
}

void cornerScores(const float* const (&rows)[3][kCornerBlock], int width, float* columns,
                  float* scores) {
  constexpr float share = 1.0F / (kCornerBlock * kCornerBlock);
  const int wide = width + kCornerBlock - 1;
  for (int k = 0; k < 3; ++k)
    for (int start = 0; start < wide; start += kFloats) {
      const int u = std::min(start, wide - kFloats);
      Floats sum = load(rows[k][0] + u);
      for (int y = 1; y < kCornerBlock; ++y) sum += load(rows[k][y] + u);
      store(columns + k * wide + u, share * sum);
    }
  for (int start = 0; start < width; start += kFloats) {
    const int u = std::min(start, width - kFloats);
    Floats sums[3];
    for (int k = 0; k < 3; ++k) {
      sums[k] = load(columns + k * wide + u);
      for (int x = 1; x < kCornerBlock; ++x) sums[k] += load(columns + k * wide + u + x);
    }
    store(scores + u, smallerEigenvalue(sums[0], sums[1], sums[2]));
  }
}

void markPeaks(const float* const (&rows)[3], int width, float least, std::uint8_t* marks) {
  for (int start = 0; start < width; start += kFloats) {
    const int u = std::min(start, width - kFloats);
    const Floats centre = load(rows[1] + u);
    Ints peak = centre > least;
    for (const float* row : rows)
      for (int x = -1; x <= 1; ++x) peak &= centre >= load(row + u + x);
    const Bytes bytes = __builtin_convertvector(peak, Bytes);
    std::memcpy(marks + u, &bytes, sizeof bytes);
  }
}
