// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the exact pair sees is the same from version to version: measurements on rendered images can
// be compared. Textures are made here, since those of the scenes also depend on OpenCV's drawing.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "mvo/sim.hpp"
#include "sim/texture.hpp"

namespace mvo::sim {
namespace {

std::shared_ptr<const Texture> checkered(const Texture& like) {
  cv::Mat bitmap(like.height(), like.width(), CV_8UC1);
  for (int row = 0; row < bitmap.rows; ++row) {
    for (int column = 0; column < bitmap.cols; ++column) {
      bitmap.at<std::uint8_t>(row, column) =
          static_cast<std::uint8_t>((31 * (column / 8)) ^ (57 * (row / 8)));
    }
  }
  return std::make_shared<const Texture>(makeTexture(bitmap));
}

Scene withoutPaintings(Scene scene) {
  const auto repaint = [](std::vector<Face>& faces) {
    for (Face& face : faces) face.texture = checkered(*face.texture);
  };
  repaint(scene.room);
  for (Body& body : scene.bodies) repaint(body.faces);
  return scene;
}

// FNV-1a over the pixels.
std::uint64_t checksum(const cv::Mat& image, std::uint64_t hash) {
  for (int row = 0; row < image.rows; ++row) {
    const auto* bytes = image.ptr<std::uint8_t>(row);
    for (std::size_t i = 0; i < image.cols * image.elemSize(); ++i) {
      hash = (hash ^ bytes[i]) * 0x100000001b3ULL;
    }
  }
  return hash;
}

std::uint64_t checksumOf(const std::string& name, bool rgbd, double blur) {
  SceneOptions options;
  options.width = 160;
  options.height = 120;
  options.rgbd = rgbd;
  options.blur = blur;
  const RenderedFrame frame = render(withoutPaintings(makeScene(name, 3, options)), 17);
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const cv::Mat& image : {frame.left, frame.right, frame.color, frame.mask})
    hash = checksum(image, hash);
  return hash;
}

TEST(ExactBytes, ArePinned) {
#ifndef __x86_64__
  GTEST_SKIP() << "other machines round differently";
#endif
  EXPECT_EQ(checksumOf("blocks", false, 0), 1579581877222114494U);
  EXPECT_EQ(checksumOf("spin", false, 0.5), 12192869068015154320U);
  EXPECT_EQ(checksumOf("static", false, 0), 4241673185481680117U);
  EXPECT_EQ(checksumOf("occlusion", true, 0), 13811083347476330962U);
  EXPECT_EQ(checksumOf("cars", false, 0), 13482704339231655991U);
}

}  // namespace
}  // namespace mvo::sim
