// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/relaxation.hpp"

#include "kernels/instruction_set.hpp"

namespace mvo {

namespace {

// Anywhere in memory; the compiler makes of them what the target has.
using Lanes = double __attribute__((vector_size(8 * kLanes), aligned(8), may_alias));
using Mask = long long __attribute__((vector_size(8 * kLanes)));

__attribute__((always_inline)) inline Lanes& lanes(double* x) {
  return *reinterpret_cast<Lanes*>(x);
}
__attribute__((always_inline)) inline const Lanes& lanes(const double* x) {
  return *reinterpret_cast<const Lanes*>(x);
}

// A step of Newton's method on the convex, piecewise linear  sum of max(x - level, 0) = wanted.
__attribute__((always_inline)) inline void raise(Lanes& level, const Lanes& sum,
                                                 const Lanes& wanted, const Lanes& count) {
  const Lanes one = Lanes{} + 1;
  level += (sum - wanted) / (count > one ? count : one);
}

__attribute__((always_inline)) inline bool anyLess(const Lanes& a, const Lanes& b) {
  const Mask less = a < b;
  return (less[0] | less[1] | less[2] | less[3]) != 0;
}

// Four tracklets side by side, label after label.
__attribute__((always_inline)) inline void descendSharesOf(const SaddlePoint& s) {
  const int width = s.width;
  double* x = s.scratch;
  for (int p = 0; p < s.tracklets; p += kLanes) {
    double* u = s.u + static_cast<long>(p) * width;
    double* extrapolated = s.extrapolated + static_cast<long>(p) * width;
    const double* cost = s.cost + static_cast<long>(p) * width;
    for (int i = 0; i < kLanes; ++i)
      for (int l = 0; l < width; ++l)
        x[l * kLanes + i] = u[i * width + l] - s.step[p + i] * cost[i * width + l];
    Lanes most = lanes(x);
    for (int l = 1; l < width; ++l) {
      const Lanes& other = lanes(x + l * kLanes);
      most = other > most ? other : most;
    }
    Lanes level = most - 1;
    Lanes before = Lanes{} + (width + 1);
    while (true) {
      Lanes count = {};
      Lanes sum = {};
      for (int l = 0; l < width; ++l) {
        const Lanes above = lanes(x + l * kLanes) - level;
        count += above > 0 ? Lanes{} + 1 : Lanes{};
        sum += above > 0 ? above : Lanes{};
      }
      if (!anyLess(count, before)) break;
      raise(level, sum, Lanes{} + 1, count);
      before = count;
    }
    for (int l = 0; l < width; ++l) {
      const Lanes above = lanes(x + l * kLanes) - level;
      lanes(x + l * kLanes) = above > 0 ? above : Lanes{};
    }
    for (int i = 0; i < kLanes; ++i)
      for (int l = 0; l < width; ++l) {
        const double share = x[l * kLanes + i];
        extrapolated[i * width + l] = 2 * share - u[i * width + l];
        u[i * width + l] = share;
      }
  }
}

// z of four labels; it starts to look for the level at the last one.
__attribute__((always_inline)) inline void ascendLabelPrices(const SaddlePoint& s, double balance,
                                                             int l) {
  const int width = s.width;
  const long end = static_cast<long>(s.tracklets) * width + l;
  const Lanes gamma = lanes(s.gamma + l);
  Lanes total = {};
  for (long i = l; i < end; i += width) {
    const Lanes z = lanes(s.z + i) + balance * lanes(s.extrapolated + i);
    const Lanes positive = z > 0 ? z : Lanes{};
    lanes(s.z + i) = gamma > 0 ? positive : Lanes{};
    total += lanes(s.z + i);
  }
  Lanes level = total > gamma ? lanes(s.level + l) : Lanes{};
  if (anyLess(gamma, total)) {
    Lanes before = Lanes{} + (s.tracklets + 1);
    for (bool first = true;; first = false) {  // which may come from above the level
      Lanes count = {};
      Lanes sum = {};
      for (long i = l; i < end; i += width) {
        const Lanes above = lanes(s.z + i) - level;
        count += above > 0 ? Lanes{} + 1 : Lanes{};
        sum += above > 0 ? above : Lanes{};
      }
      if (!anyLess(count, before)) break;
      raise(level, sum, gamma, count);
      level = level > 0 && count > 0 && total > gamma ? level : Lanes{};
      if (!first) before = count;
    }
  }
  lanes(s.level + l) = level;
  for (long i = l; i < end; i += width) {
    const Lanes z = lanes(s.z + i) - level;
    lanes(s.z + i) = z > 0 ? z : Lanes{};
    lanes(s.cost + i) = lanes(s.rho + i) + lanes(s.z + i);
  }
}

__attribute__((always_inline)) inline void ascendPricesOf(const SaddlePoint& s, double balance) {
  const int width = s.width;
  for (int l = 0; l < width; l += kLanes) ascendLabelPrices(s, balance, l);
  for (int e = 0; e < s.edges; ++e) {
    const long p = static_cast<long>(s.ends[2 * e]) * width;
    const long q = static_cast<long>(s.ends[2 * e + 1]) * width;
    double* of_edge = s.y + static_cast<long>(e) * width;
    const Lanes most = Lanes{} + s.half_weight[e];
    for (int l = 0; l < width; l += kLanes) {
      Lanes y = lanes(of_edge + l) +
                0.5 * balance * (lanes(s.extrapolated + p + l) - lanes(s.extrapolated + q + l));
      y = y < most ? y : most;
      y = y > -most ? y : -most;
      lanes(of_edge + l) = y;
      lanes(s.cost + p + l) += y;
      lanes(s.cost + q + l) -= y;
    }
  }
}

#if defined(__x86_64__)
__attribute__((target("avx2,fma"))) void descendSharesAvx2(const SaddlePoint& s) {
  descendSharesOf(s);
}

__attribute__((target("avx2,fma"))) void ascendPricesAvx2(const SaddlePoint& s, double balance) {
  ascendPricesOf(s, balance);
}
#endif

}  // namespace

void portable::descendShares(const SaddlePoint& s) { descendSharesOf(s); }

void portable::ascendPrices(const SaddlePoint& s, double balance) { ascendPricesOf(s, balance); }

void descendShares(const SaddlePoint& s) {
#if defined(__x86_64__)
  if (hasAvx2()) return descendSharesAvx2(s);
#endif
  portable::descendShares(s);
}

void ascendPrices(const SaddlePoint& s, double balance) {
#if defined(__x86_64__)
  if (hasAvx2()) return ascendPricesAvx2(s, balance);
#endif
  portable::ascendPrices(s, balance);
}

}  // namespace mvo
