// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/sequences/kalibr.hpp"

#include <fstream>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "mvo/se3.hpp"

namespace mvo {

namespace {

namespace fs = std::filesystem;

// cv::FileStorage wants a header, and the items of a list further in than its name.
std::string forOpenCv(const fs::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  std::string text = "%YAML:1.0\n---\n";
  std::string line;
  while (std::getline(file, line)) {
    if (line.rfind("%YAML", 0) == 0 || line == "---") continue;
    const std::size_t first = line.find_first_not_of(' ');
    if (first != std::string::npos && line[first] == '-') line.insert(0, "  ");
    text += line + '\n';
  }
  return text;
}

// The numbers of a list, or of a list of lists.
std::vector<double> numbers(const cv::FileNode& node) {
  std::vector<double> result;
  for (const auto& item : node) {
    if (item.isSeq())
      for (const double number : numbers(item)) result.push_back(number);
    else if (item.isInt() || item.isReal())
      result.push_back(static_cast<double>(item));
  }
  return result;
}

Eigen::Isometry3d transform(const cv::FileNode& node, const std::string& name) {
  const std::vector<double> values = numbers(node);
  if (values.size() != 16) throw std::runtime_error(name + " is no 4x4 matrix");
  const Eigen::Matrix4d M =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = nearestRotation(M.topLeftCorner<3, 3>());
  T.translation() = M.topRightCorner<3, 1>();
  return T;
}

template <typename Function>
auto withFile(const fs::path& path, const Function& read) {
  const std::string text = forOpenCv(path);
  try {
    const cv::FileStorage storage(
        text, cv::FileStorage::READ | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML);
    return read(storage);
  } catch (const cv::Exception& error) {
    throw std::runtime_error(path.string() + " is no calibration file: " + error.err);
  } catch (const std::exception& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

}  // namespace

std::vector<KalibrCamera> readKalibrChain(const fs::path& path) {
  return withFile(path, [](const cv::FileStorage& storage) {
    std::vector<KalibrCamera> cameras;
    for (;;) {
      const std::string name = "cam" + std::to_string(cameras.size());
      const cv::FileNode node = storage[name];
      if (node.empty()) break;
      KalibrCamera camera;
      camera.topic = node["rostopic"].isString() ? static_cast<std::string>(node["rostopic"]) : "";
      const std::vector<double> resolution = numbers(node["resolution"]);
      camera.intrinsics = numbers(node["intrinsics"]);
      camera.distortion = numbers(node["distortion_coeffs"]);
      if (resolution.size() != 2 || camera.intrinsics.size() != 4)
        throw std::runtime_error(name + " has no resolution or no pinhole intrinsics");
      camera.width = static_cast<int>(resolution[0]);
      camera.height = static_cast<int>(resolution[1]);
      if (!cameras.empty())
        camera.T_cn_c0 =
            transform(node["T_cn_cnm1"], name + "'s T_cn_cnm1") * cameras.back().T_cn_c0;
      cameras.push_back(camera);
    }
    if (cameras.empty()) throw std::runtime_error("no cam0");
    return cameras;
  });
}

Eigen::Isometry3d readKalibrTransform(const fs::path& path, const std::string& name) {
  return withFile(path,
                  [&](const cv::FileStorage& storage) { return transform(storage[name], name); });
}

}  // namespace mvo
