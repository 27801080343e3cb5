// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// How noisy a batch's measurements were, and what that makes of its normal equations.
#pragma once

namespace mvo {

/// Standard deviation of whitened residuals, of which three belong to a measurement, from the mean
/// of Cauchy's loss log(1 + |e|^2 / scale^2): outliers hardly count. `freedom` is the share of the
/// residuals that the estimate left free, in (0, 1]. At most kMaxNoise.
double residualNoise(double mean_loss, double scale, double freedom);

/// What the inverse of the weighted normal equations has to be multiplied by to be the covariance
/// of an estimate under Cauchy's loss, if whitened measurements have the standard deviation
/// `noise`: K E w E psi^2 / (E psi')^2 of psi = w(|e|^2) e over the normal distribution in three
/// dimensions, with Huber's K = 1 + (1 - freedom) Var psi' / (E psi')^2 for the unknowns that are
/// many (Huber, Robust Statistics, 7.6, has K^2, with psi' of residuals; they are smaller than the
/// errors that are meant here). noise^2 for scale 0, which is least squares.
double covarianceFactor(double scale, double noise, double freedom);

constexpr double kMaxNoise = 100.0;  ///< beyond that there is no estimate to speak of

}  // namespace mvo
