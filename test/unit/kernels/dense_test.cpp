// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The dense kernels against Eigen.
#include "kernels/dense.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <random>
#include <vector>

#include "support/halves.hpp"

namespace mvo {
namespace {

using DenseKernels = test::BothHalves;

TEST_P(DenseKernels, GramAndCholeskyAreEigens) {
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  const auto noise = [&](Eigen::Index rows, Eigen::Index cols) {
    return Eigen::MatrixXd(
        Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return normal(random); }));
  };
  for (const Eigen::Index n : {1, 3, 6, 7, 8, 12, 23, 24, 25, 48, 54, 101, 282}) {
    const Eigen::Index padded = n + kTilePadding;
    Eigen::MatrixXd U = Eigen::MatrixXd::Zero(padded, 12);
    U.topRows(n) = noise(n, 12);
    const Eigen::MatrixXd before = noise(padded, padded);
    Eigen::MatrixXd S = before;
    std::vector<Eigen::Index> ends;  // columns shrink from n rows on
    for (Eigen::Index c = 0; c < U.cols(); ++c) {
      ends.push_back(std::max<Eigen::Index>(n - 2 * c, 0));
      U.col(c).tail(padded - ends.back()).setZero();
    }
    subtractGram(S.data(), S.outerStride(), U.data(), U.outerStride(), n, ends);
    const Eigen::MatrixXd expected = before - U * U.transpose();
    const Eigen::MatrixXd error = (S - expected).topLeftCorner(n, n).triangularView<Eigen::Lower>();
    EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-12) << n;
    EXPECT_EQ(S.bottomRows(kTilePadding), before.bottomRows(kTilePadding)) << n;
    EXPECT_EQ(S.rightCols(kTilePadding), before.rightCols(kTilePadding)) << n;

    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(padded, padded);
    const Eigen::MatrixXd root = noise(n, n + 5);
    A.topLeftCorner(n, n) = root * root.transpose() + Eigen::MatrixXd::Identity(n, n);
    const Eigen::MatrixXd L = A.topLeftCorner(n, n).llt().matrixL();
    const std::vector<Eigen::Index> everywhere(static_cast<std::size_t>(n), n);
    ASSERT_TRUE(choleskyInPlace(A, everywhere));
    const Eigen::MatrixXd own = A.topLeftCorner(n, n).triangularView<Eigen::Lower>();
    EXPECT_LT((own - L).cwiseAbs().maxCoeff(), 1e-11 * L.cwiseAbs().maxCoeff()) << n;

    const Eigen::VectorXd b = noise(n, 1);
    const Eigen::VectorXd x = choleskySolve(A, b);
    EXPECT_LT((own * (own.transpose() * x) - b).norm(), 1e-9 * b.norm()) << n;

    A.setIdentity();
    A(n - 1, n - 1) = -1;
    EXPECT_FALSE(choleskyInPlace(A, everywhere));

    const Eigen::VectorXd y = noise(12, 1);
    Eigen::VectorXd product = b;
    subtractProduct(product.data(), U.data(), U.outerStride(), n, U.cols(), y.data());
    EXPECT_LT((product - (b - U.topRows(n) * y)).norm(), 1e-12 * n) << n;
    Eigen::VectorXd transposed = y;
    addTransposedProduct(transposed.data(), U.data(), U.outerStride(), n, U.cols(), b.data());
    EXPECT_LT((transposed - (y + U.topRows(n).transpose() * b)).norm(), 1e-12 * n) << n;
  }
}

// A band: what its envelope leaves out is never read.
TEST_P(DenseKernels, CholeskyStaysWithinItsEnvelope) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const Eigen::Index n = 150;
  std::vector<Eigen::Index> reach;
  for (Eigen::Index c = 0; c < n; ++c) reach.push_back(std::min(n, 6 * (c / 6) + 42));
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + kTilePadding, n + kTilePadding);
  for (Eigen::Index c = 0; c < n; ++c)
    for (Eigen::Index r = c; r < reach[static_cast<std::size_t>(c)]; ++r)
      A(r, c) = r == c ? 200 : normal(random);
  const Eigen::MatrixXd full = A.topLeftCorner(n, n).selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd L = full.llt().matrixL();
  ASSERT_TRUE(choleskyInPlace(A, reach));
  const Eigen::MatrixXd own = A.topLeftCorner(n, n).triangularView<Eigen::Lower>();
  EXPECT_LT((own - L).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(DenseKernelBits, AreTheSameOnBothHalves) {
  test::expectSameBitsOnBothHalves([] {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    std::vector<double> outputs;
    const auto keep = [&outputs](const auto& m) {
      outputs.insert(outputs.end(), m.data(), m.data() + m.size());
    };
    for (const Eigen::Index n : {1, 5, 6, 12, 18, 24, 30, 42, 48, 54, 102, 282}) {
      const auto noise = [&](Eigen::Index rows, Eigen::Index cols) {
        return Eigen::MatrixXd(
            Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return normal(random); }));
      };
      const Eigen::Index padded = n + kTilePadding;
      Eigen::MatrixXd U = Eigen::MatrixXd::Zero(padded, 9);
      U.topRows(n) = noise(n, 9);
      Eigen::MatrixXd S = Eigen::MatrixXd::Zero(padded, padded);
      S.topLeftCorner(n, n) = noise(n, n);
      S.diagonal().head(n).array() += 40.0 * static_cast<double>(n);
      subtractGram(S.data(), S.outerStride(), U.data(), U.outerStride(), n,
                   std::vector<Eigen::Index>(9, n));
      keep(S);
      EXPECT_TRUE(choleskyInPlace(S, std::vector<Eigen::Index>(static_cast<std::size_t>(n), n)));
      keep(S);
      Eigen::VectorXd b = noise(n, 1);
      Eigen::VectorXd y = noise(9, 1);
      subtractProduct(b.data(), U.data(), U.outerStride(), n, U.cols(), y.data());
      keep(b);
      addTransposedProduct(y.data(), U.data(), U.outerStride(), n, U.cols(), b.data());
      keep(y);
    }
    return outputs;
  });
}

INSTANTIATE_TEST_SUITE_P(Halves, DenseKernels,
                         testing::Values(Half::kPortable, Half::kMachine, Half::kTwoRoundings),
                         test::nameOfHalf);

}  // namespace
}  // namespace mvo
