// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "io/atomic_file.hpp"
#include "io/camera_json.hpp"
#include "mvo/camera_error_files.hpp"

namespace mvo {

namespace {

constexpr char kFormat[] = "mvo camera errors";

std::vector<double> valuesOf(const Eigen::VectorXd& vector) {
  return {vector.data(), vector.data() + vector.size()};
}

Eigen::VectorXd vectorOf(const nlohmann::json& json, std::size_t size, const std::string& name) {
  const auto values = json.get<std::vector<double>>();
  if (values.size() != size)
    throw std::runtime_error(name + " has " + std::to_string(values.size()) +
                             " numbers, there are " + std::to_string(size) + " terms");
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(size));
}

StereoCamera cameraOf(const nlohmann::json& json) {
  StereoCamera camera = intrinsicsOf(json);
  camera.baseline = json.at("baseline").get<double>();
  camera.validate();
  return camera;
}

LearntCameraErrors parsed(const nlohmann::json& json) {
  if (!json.is_object() || json.value("format", "") != kFormat)
    throw std::runtime_error(std::string("not a file of camera errors (format is not '") + kFormat +
                             "')");
  LearntCameraErrors learnt;
  learnt.camera = cameraOf(json.at("camera"));
  learnt.terms = json.at("terms").get<std::vector<std::string>>();
  const std::size_t size = learnt.terms.size();
  learnt.mean = vectorOf(json.at("mean"), size, "mean");
  const nlohmann::json& covariance = json.at("covariance");
  if (!covariance.is_array() || covariance.size() != size)
    throw std::runtime_error("covariance must have a row for each of the " + std::to_string(size) +
                             " terms");
  const auto n = static_cast<Eigen::Index>(size);
  learnt.covariance.resize(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    learnt.covariance.row(i) =
        vectorOf(covariance[static_cast<std::size_t>(i)], size, "a row of covariance").transpose();
  return learnt;
}

}  // namespace

void writeCameraErrors(const std::filesystem::path& path, const LearntCameraErrors& learnt) {
  const StereoCamera& camera = learnt.camera;
  nlohmann::ordered_json json = {{"format", kFormat}};
  json["camera"] = {{"width", camera.width},
                    {"height", camera.height},
                    {"fx", camera.fu},
                    {"fy", camera.fv},
                    {"cx", camera.cu},
                    {"cy", camera.cv},
                    {"baseline", camera.baseline}};
  json["terms"] = learnt.terms;
  json["mean"] = valuesOf(learnt.mean);
  auto& covariance = json["covariance"] = nlohmann::ordered_json::array();
  for (Eigen::Index i = 0; i < learnt.covariance.rows(); ++i)
    covariance.push_back(valuesOf(learnt.covariance.row(i).transpose()));
  AtomicFile file(path);
  file.stream() << json.dump(1) << '\n';
  file.commit();
}

LearntCameraErrors readCameraErrors(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  try {
    return parsed(nlohmann::json::parse(file));
  } catch (const std::exception& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

}  // namespace mvo
