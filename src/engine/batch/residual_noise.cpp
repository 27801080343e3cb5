// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/batch/residual_noise.hpp"

#include <algorithm>
#include <cmath>

namespace mvo {

namespace {

// Calls visit(n^2, probability) over the lengths n of a normal vector in three dimensions.
template <typename Visit>
void overNormal(const Visit& visit) {
  constexpr int steps = 400;
  constexpr double end = 8.0;  // the density beyond is below 1e-12
  const double width = end / steps;
  const double unit = width * std::sqrt(2 / M_PI);
  for (int i = 1; i < steps; ++i) {
    const double s = width * i * width * i;
    visit(s, unit * s * std::exp(-0.5 * s));
  }
}

struct ExpectedLoss {
  double loss = 0;
  double slope = 0;  // by the logarithm of the variance
};

ExpectedLoss expectedLoss(double variance) {
  ExpectedLoss e;
  overNormal([&](double s, double p) {
    e.loss += p * std::log1p(s * variance);
    e.slope += p * s * variance / (1 + s * variance);
  });
  return e;
}

}  // namespace

double residualNoise(double mean_loss, double scale, double freedom) {
  if (!(mean_loss > 0)) return 0;
  const double limit = kMaxNoise * kMaxNoise * freedom / (scale * scale);
  // Newton's method in the logarithm of the variance, by which the loss grows almost linearly.
  double variance = std::min(limit, std::expm1(mean_loss) / 3);
  for (int i = 0; i < 6; ++i) {
    const ExpectedLoss expected = expectedLoss(variance);
    const double by = (mean_loss - expected.loss) / expected.slope;
    variance = std::min(limit, variance * std::exp(std::clamp(by, -2.0, 2.0)));
  }
  return scale * std::sqrt(variance / freedom);
}

double covarianceFactor(double scale, double noise, double freedom) {
  if (scale <= 0) return noise * noise;
  const double variance = noise * noise / (scale * scale);
  double weight = 0;  // E w, of the residuals that are left
  double slope = 0;   // E of a component's psi'
  double slopes = 0;  // E of its square
  double square = 0;  // E of a component's psi^2
  overNormal([&](double s, double p) {
    weight += p / (1 + s * variance * freedom);
    const double w = 1 / (1 + s * variance);
    const double u = 1 - w;
    slope += p * w * (1 - u * 2 / 3);
    slopes += p * w * w * (1 - u * 4 / 3 + u * u * 4 / 5);
    square += p * w * w * s * noise * noise / 3;
  });
  const double finite = 1 + (1 - freedom) * (slopes / (slope * slope) - 1);
  return weight * square / (slope * slope) * finite;
}

}  // namespace mvo
