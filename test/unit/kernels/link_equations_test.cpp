// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The normal equations of many pairs against those made of one link at a time.
#include "kernels/link_equations.hpp"

#include <gtest/gtest.h>

#include <random>

#include "mvo/se3.hpp"
#include "support/halves.hpp"
#include "support/stereo_pairs.hpp"

namespace mvo {
namespace {

using test::somePairs;

const StereoCamera& kCamera = test::kPairCamera;
const Eigen::Isometry3d& kMotion = test::kPairMotion;
constexpr double kScale = 1.5;

LinkResidual whitened() { return {kCamera, {}, ResidualModel::kWhitened}; }

LinkEquations equationsOf(const std::vector<StereoPair>& pairs) {
  LinkEquations equations(whitened());
  for (const StereoPair& pair : pairs) equations.add(pair);
  return equations;
}

using LinkEquationsOfBothHalves = test::BothHalves;

TEST_P(LinkEquationsOfBothHalves, AreTheSumOverLinks) {
  const Eigen::Isometry3d backwards = exp((Vector6d() << 0, 0, -0.2, 0, 0, 0).finished()) * kMotion;
  for (const int n : {0, 1, 3, 4, 5, 40, 203})
    for (const Eigen::Isometry3d& T : {kMotion, backwards}) {
      const std::vector<StereoPair> pairs = somePairs(n);
      Matrix6d A = Matrix6d::Zero();
      Vector6d b = Vector6d::Zero();
      for (const StereoPair& pair : pairs) {
        Link link;
        if (!whitened().linearize(T, pair.y_a, pair.y_b, &link)) continue;
        const double e2 = link.residual.dot(link.information * link.residual);
        const double weight = 1 / (1 + e2 / (kScale * kScale));
        A += weight * link.jacobian.transpose() * link.information * link.jacobian;
        b += weight * link.jacobian.transpose() * link.information * link.residual;
      }
      const LinkEquations::Equations found = equationsOf(pairs).at(T, kScale);
      int i = 0;
      for (int row = 0; row < 6; ++row)
        for (int column = 0; column <= row; ++column)
          EXPECT_NEAR(found[i++], A(row, column), 1e-9 * (1 + A.norm())) << n;
      for (int row = 0; row < 6; ++row) EXPECT_NEAR(found[i++], b(row), 1e-9 * (1 + b.norm())) << n;
    }
}

TEST(LinkEquations, ForgetWhatWasCleared) {
  LinkEquations equations = equationsOf(somePairs(30));
  equations.clear();
  for (const StereoPair& pair : somePairs(9)) equations.add(pair);
  EXPECT_EQ(equations.at(kMotion, kScale), equationsOf(somePairs(9)).at(kMotion, kScale));
}

INSTANTIATE_TEST_SUITE_P(Halves, LinkEquationsOfBothHalves,
                         testing::Values(Half::kPortable, Half::kMachine, Half::kTwoRoundings),
                         test::nameOfHalf);

TEST(LinkEquationBits, AreTheSameOnBothHalves) {
  test::expectSameBitsOnBothHalves([] {
    std::vector<double> outputs;
    for (int n = 1; n < 200; ++n) {
      const auto equations = equationsOf(somePairs(n)).at(kMotion, kScale);
      outputs.insert(outputs.end(), equations.begin(), equations.end());
    }
    return outputs;
  });
}

}  // namespace
}  // namespace mvo
