// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/raster.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "sim/shading.hpp"
#include "sim/shapes.hpp"
#include "sim/texture.hpp"

namespace mvo::sim {
namespace {

// 1 px per 0.01 rad, the optical axis in the middle of pixel (10, 8).
const Grid kGrid{100, 100, 10, 8, 21, 17};

// A square in the plane z, seen from the origin; normal towards it.
Face squareAt(double z, double half) {
  Face face;
  face.corners = {{-half, -half, z}, {-half, half, z}, {half, half, z}, {half, -half, z}};
  face.normal = -Eigen::Vector3d::UnitZ();
  return face;
}

int count(const Visibility& seen, int index) {
  return static_cast<int>(std::count(seen.index.begin(), seen.index.end(), index));
}

TEST(Raster, SquareCoversTheSamplesInside) {
  // 0.055 m at 1 m: +-5.5 px about (10, 8), so 11 x 11 samples.
  const Face face = squareAt(1, 0.055);
  const auto projected = project(face, Eigen::Isometry3d::Identity(), kGrid);
  ASSERT_TRUE(projected);
  const Visibility seen = visibility({*projected}, kGrid);
  EXPECT_EQ(count(seen, 1), 121);
  EXPECT_EQ(seen.index[3 * 21 + 5], 1);
  EXPECT_EQ(seen.index[2 * 21 + 5], 0);
  EXPECT_EQ(seen.index[3 * 21 + 4], 0);
  EXPECT_FLOAT_EQ(seen.inverse_depth[8 * 21 + 10], 1.0F);
}

TEST(Raster, NearerFaceWinsInAnyOrder) {
  const Face near_face = squareAt(1, 0.025);  // 5 x 5 samples
  const Face far_face = squareAt(2, 0.11);    // 11 x 11 samples
  const auto a = project(near_face, Eigen::Isometry3d::Identity(), kGrid);
  const auto b = project(far_face, Eigen::Isometry3d::Identity(), kGrid);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(count(visibility({*a, *b}, kGrid), 1), 25);
  EXPECT_EQ(count(visibility({*a, *b}, kGrid), 2), 96);
  EXPECT_EQ(count(visibility({*b, *a}, kGrid), 2), 25);
}

TEST(Raster, BackAndHiddenHalfSpaceAreNotSeen) {
  Face face = squareAt(1, 0.1);
  face.normal = Eigen::Vector3d::UnitZ();
  EXPECT_FALSE(project(face, Eigen::Isometry3d::Identity(), kGrid));
  face = squareAt(-1, 0.1);
  face.normal = Eigen::Vector3d::UnitZ();
  EXPECT_FALSE(project(face, Eigen::Isometry3d::Identity(), kGrid));
}

TEST(Raster, FloorThatRunsUnderTheCameraIsClipped) {
  // A floor 1 m below (y down), from behind the camera to far ahead: all rows below the horizon.
  Face face;
  face.corners = {{-100, 1, -10}, {100, 1, -10}, {100, 1, 1000}, {-100, 1, 1000}};
  face.normal = -Eigen::Vector3d::UnitY();
  const auto projected = project(face, Eigen::Isometry3d::Identity(), kGrid);
  ASSERT_TRUE(projected);
  const Visibility seen = visibility({*projected}, kGrid);
  for (int row = 0; row < 17; ++row) {
    EXPECT_EQ(seen.index[row * 21 + 10], row > 8 ? 1 : 0) << row;
  }
  EXPECT_NEAR(1 / seen.inverse_depth[16 * 21 + 10], 100.0 / 8, 1e-4);
}

TEST(Raster, ClosedRoomLeavesNoHoles) {
  const auto texture = std::make_shared<const Texture>(makeTexture(cv::Mat(4, 4, CV_8UC1)));
  const auto faces = room({-1, -1, -1}, {1.1, 1.2, 1.3}, [&](int, double, double) {
    return Paint{texture, {1, 1, 1}};
  });
  for (int i = 0; i < 50; ++i) {
    Eigen::Isometry3d T_eye_world = Eigen::Isometry3d::Identity();
    T_eye_world.rotate(Eigen::AngleAxisd(0.37 * i, Eigen::Vector3d(1, 2, i % 3).normalized()));
    std::vector<ProjectedFace> projected;
    for (const Face& face : faces) {
      if (auto seen = project(face, T_eye_world, kGrid)) projected.push_back(*seen);
    }
    EXPECT_EQ(count(visibility(projected, kGrid), 0), 0) << i;
  }
}

TEST(Raster, PixelCentresStayWhereTheyAreAtEverySampling) {
  StereoCamera camera;
  camera.fu = camera.fv = 500;
  camera.cu = 318.6;
  camera.cv = 243.2;
  camera.width = 640;
  camera.height = 480;
  const Grid fine = sampleGrid(camera, 2);
  // The samples of pixel 7 are 14 and 15; their mean direction is the pixel's.
  EXPECT_NEAR((14.5 - fine.cu) / fine.fu, (7 - camera.cu) / camera.fu, 1e-12);
  EXPECT_NEAR((14.5 - fine.cv) / fine.fv, (7 - camera.cv) / camera.fv, 1e-12);
}

TEST(Shading, TexelsAppearWhereTheFaceSaysSo) {
  // One texel per sample at 1 m: column u of the image shows column u - 2 of the texture.
  cv::Mat bitmap(32, 32, CV_8UC1);
  for (int row = 0; row < 32; ++row) {
    for (int column = 0; column < 32; ++column) {
      bitmap.at<std::uint8_t>(row, column) = static_cast<std::uint8_t>(4 * column + row);
    }
  }
  Face face = squareAt(1, 0.3);
  face.texture = std::make_shared<const Texture>(makeTexture(bitmap));
  face.s_axis = 100 * Eigen::Vector3d::UnitX();
  face.t_axis = 100 * Eigen::Vector3d::UnitY();
  face.s_offset = 8.5;  // the optical axis, column 10, is the centre of texel 8
  face.t_offset = 8.5;
  const auto projected = project(face, Eigen::Isometry3d::Identity(), kGrid);
  ASSERT_TRUE(projected);
  cv::Mat sum = cv::Mat::zeros(kGrid.height, kGrid.width, CV_32FC1);
  shade({*projected}, visibility({*projected}, kGrid), 1, 1.0F, sum);
  for (const cv::Point p : {cv::Point(10, 8), cv::Point(4, 3), cv::Point(20, 16)}) {
    EXPECT_NEAR(sum.at<float>(p), 4 * (p.x - 2) + p.y, 0.01) << p;
  }
}

TEST(Shapes, PrismFacesLookOutwards) {
  const auto texture = std::make_shared<const Texture>(makeTexture(cv::Mat(4, 4, CV_8UC1)));
  const auto faces = prism({{1, 0}, {0, 1}, {-1, 0}, {0, -1}}, 2, [&](int, double, double) {
    return Paint{texture, {1, 1, 1}};
  });
  ASSERT_EQ(faces.size(), 6U);
  for (const Face& face : faces) {
    for (const Eigen::Vector3d& corner : face.corners) {
      EXPECT_GT(face.normal.dot(corner), 0);
      // The texture covers the face once.
      const double s = face.s_axis.dot(corner) + face.s_offset;
      EXPECT_GE(s, -1e-9);
      EXPECT_LE(s, 4 + 1e-9);
    }
  }
}

TEST(Shapes, MovedFacesKeepTheirTexels) {
  const auto texture = std::make_shared<const Texture>(makeTexture(cv::Mat(4, 8, CV_8UC1)));
  const auto faces = box({1, 2, 3}, [&](int, double, double) { return Paint{texture, {1, 1, 1}}; });
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translate(Eigen::Vector3d(1, -2, 0.5));
  T.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 1, 1).normalized()));
  const auto after = moved(T, faces);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Eigen::Vector3d p = faces[i].corners[1];
    EXPECT_TRUE(after[i].corners[1].isApprox(T * p));
    EXPECT_NEAR(after[i].s_axis.dot(T * p) + after[i].s_offset,
                faces[i].s_axis.dot(p) + faces[i].s_offset, 1e-9);
    EXPECT_NEAR(after[i].t_axis.dot(T * p) + after[i].t_offset,
                faces[i].t_axis.dot(p) + faces[i].t_offset, 1e-9);
  }
}

}  // namespace
}  // namespace mvo::sim
