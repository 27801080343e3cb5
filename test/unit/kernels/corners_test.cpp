// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The kernels of the detector on both halves; what they find is tested in frontend/corner_peaks.
#include "kernels/corners.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <vector>

#include "support/halves.hpp"
#include "support/textures.hpp"

namespace mvo {
namespace {

using test_support::randomTexture;

template <typename Numbers>
void keep(const Numbers& numbers, std::vector<double>& outputs) {
  outputs.insert(outputs.end(), numbers.begin(), numbers.end());
}

TEST(CornerKernelBits, AreTheSameOnBothHalves) {
  const cv::Mat image = randomTexture({160, 120}, 5);
  test::expectSameBitsOnBothHalves([&] {
    constexpr int width = 101;
    constexpr int wide = width + kCornerBlock - 1;
    std::vector<double> outputs;
    std::vector<float> products[3][kCornerBlock + 2];
    std::vector<float> scores[3];
    for (int y = 0; y < kCornerBlock + 2; ++y) {
      for (auto& of : products) of[y].resize(wide);
      gradientProducts(image.ptr(20 + y) + 20, static_cast<std::ptrdiff_t>(image.step), wide,
                       products[0][y].data(), products[1][y].data(), products[2][y].data());
      for (const auto& of : products) keep(of[y], outputs);
    }
    std::vector<float> columns(3 * wide);
    for (int y = 0; y < 3; ++y) {
      const float* rows[3][kCornerBlock];
      for (int k = 0; k < 3; ++k)
        for (int i = 0; i < kCornerBlock; ++i) rows[k][i] = products[k][y + i].data();
      scores[y].resize(width);
      cornerScores(rows, width, columns.data(), scores[y].data());
      keep(scores[y], outputs);
    }
    std::vector<std::uint8_t> marks(width - 2);
    markPeaks({scores[0].data() + 1, scores[1].data() + 1, scores[2].data() + 1}, width - 2, 1.0F,
              marks.data());
    keep(marks, outputs);
    return outputs;
  });
}

}  // namespace
}  // namespace mvo
