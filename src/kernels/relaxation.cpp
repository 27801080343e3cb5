// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/relaxation.hpp"

#include "kernels/lanes.hpp"

namespace mvo {

namespace {

using Mask = long long __attribute__((vector_size(8 * kDoubles)));

MVO_INLINE Doubles& lanes(double* x) { return *reinterpret_cast<Doubles*>(x); }
MVO_INLINE const Doubles& lanes(const double* x) { return *reinterpret_cast<const Doubles*>(x); }

// A step of Newton's method on the convex, piecewise linear  sum of max(x - level, 0) = wanted.
MVO_INLINE void raise(Doubles& level, const Doubles& sum, const Doubles& wanted,
                      const Doubles& count) {
  const Doubles one = Doubles{} + 1;
  level += (sum - wanted) / (count > one ? count : one);
}

MVO_INLINE bool anyLess(const Doubles& a, const Doubles& b) {
  const Mask less = a < b;
  return (less[0] | less[1] | less[2] | less[3]) != 0;
}

// Four tracklets side by side, label after label.
template <typename M>
MVO_INLINE void descendSharesOf(const SaddlePoint& s) {
  const int width = s.width;
  double* x = s.scratch;
  for (int p = 0; p < s.tracklets; p += kDoubles) {
    double* u = s.u + static_cast<long>(p) * width;
    double* extrapolated = s.extrapolated + static_cast<long>(p) * width;
    const double* cost = s.cost + static_cast<long>(p) * width;
    for (int i = 0; i < kDoubles; ++i)
      for (int l = 0; l < width; ++l)
        x[l * kDoubles + i] = fused<M>(-s.step[p + i], cost[i * width + l], u[i * width + l]);
    Doubles most = lanes(x);
    for (int l = 1; l < width; ++l) {
      const Doubles& other = lanes(x + l * kDoubles);
      most = other > most ? other : most;
    }
    Doubles level = most - 1;
    Doubles before = Doubles{} + (width + 1);
    while (true) {
      Doubles count = {};
      Doubles sum = {};
      for (int l = 0; l < width; ++l) {
        const Doubles above = lanes(x + l * kDoubles) - level;
        count += above > 0 ? Doubles{} + 1 : Doubles{};
        sum += above > 0 ? above : Doubles{};
      }
      if (!anyLess(count, before)) break;
      raise(level, sum, Doubles{} + 1, count);
      before = count;
    }
    for (int l = 0; l < width; ++l) {
      const Doubles above = lanes(x + l * kDoubles) - level;
      lanes(x + l * kDoubles) = above > 0 ? above : Doubles{};
    }
    for (int i = 0; i < kDoubles; ++i)
      for (int l = 0; l < width; ++l) {
        const double share = x[l * kDoubles + i];
        extrapolated[i * width + l] = 2 * share - u[i * width + l];
        u[i * width + l] = share;
      }
  }
}

// z of four labels; it starts to look for the level at the last one.
template <typename M>
MVO_INLINE void ascendLabelPrices(const SaddlePoint& s, double balance, int l) {
  const int width = s.width;
  const long end = static_cast<long>(s.tracklets) * width + l;
  const Doubles gamma = lanes(s.gamma + l);
  Doubles total = {};
  for (long i = l; i < end; i += width) {
    const Doubles z = fused<M>(lanes(s.extrapolated + i), balance, lanes(s.z + i));
    const Doubles positive = z > 0 ? z : Doubles{};
    lanes(s.z + i) = gamma > 0 ? positive : Doubles{};
    total += lanes(s.z + i);
  }
  Doubles level = total > gamma ? lanes(s.level + l) : Doubles{};
  if (anyLess(gamma, total)) {
    Doubles before = Doubles{} + (s.tracklets + 1);
    for (bool first = true;; first = false) {  // which may come from above the level
      Doubles count = {};
      Doubles sum = {};
      for (long i = l; i < end; i += width) {
        const Doubles above = lanes(s.z + i) - level;
        count += above > 0 ? Doubles{} + 1 : Doubles{};
        sum += above > 0 ? above : Doubles{};
      }
      if (!anyLess(count, before)) break;
      raise(level, sum, gamma, count);
      level = level > 0 && count > 0 && total > gamma ? level : Doubles{};
      if (!first) before = count;
    }
  }
  lanes(s.level + l) = level;
  for (long i = l; i < end; i += width) {
    const Doubles z = lanes(s.z + i) - level;
    lanes(s.z + i) = z > 0 ? z : Doubles{};
    lanes(s.cost + i) = lanes(s.rho + i) + lanes(s.z + i);
  }
}

template <typename M>
MVO_INLINE void ascendPricesOf(const SaddlePoint& s, double balance) {
  const int width = s.width;
  for (int l = 0; l < width; l += kDoubles) ascendLabelPrices<M>(s, balance, l);
  for (int e = 0; e < s.edges; ++e) {
    const long p = static_cast<long>(s.ends[2 * e]) * width;
    const long q = static_cast<long>(s.ends[2 * e + 1]) * width;
    double* of_edge = s.y + static_cast<long>(e) * width;
    const Doubles most = Doubles{} + s.half_weight[e];
    for (int l = 0; l < width; l += kDoubles) {
      Doubles y = fused<M>(lanes(s.extrapolated + p + l) - lanes(s.extrapolated + q + l),
                           0.5 * balance, lanes(of_edge + l));
      y = y < most ? y : most;
      y = y > -most ? y : -most;
      lanes(of_edge + l) = y;
      lanes(s.cost + p + l) += y;
      lanes(s.cost + q + l) -= y;
    }
  }
}

}  // namespace

void descendShares(const SaddlePoint& s) {
  onThisMachine([&](auto machine) MVO_KERNEL { descendSharesOf<decltype(machine)>(s); });
}

void ascendPrices(const SaddlePoint& s, double balance) {
  onThisMachine([&](auto machine) MVO_KERNEL { ascendPricesOf<decltype(machine)>(s, balance); });
}

}  // namespace mvo
