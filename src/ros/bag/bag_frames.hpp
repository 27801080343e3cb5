// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A bag as a stream of the library's frames: images paired by stamp, converted and, if raw,
// rectified.
#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <string>

#include "mvo/odometry.hpp"
#include "ros/sensor/sensor_model.hpp"

namespace mvo_ros {

/// What to read of a bag.
struct BagRequest {
  SensorSetup setup;
  double start = 0;                                           ///< after the first image [s]
  double duration = std::numeric_limits<double>::infinity();  ///< from there on [s]
  double sync_tolerance = 0;  ///< largest difference of stamps in a pair [s]; 0 = equal stamps
};

/// A frame and what it took to get it.
struct BagFrame {
  mvo::Frame frame;  ///< stamped as its left image
  double decode_ms = 0;
  double rectify_ms = 0;
};

/// Reads a bag once, from front to back, holding one pair of images at a time. Every error is a
/// std::runtime_error of one sentence that names the file or topic at fault.
class BagFrames {
 public:
  BagFrames(const std::string& path, const BagRequest& request);

  const mvo::StereoCamera& camera() const { return model_->camera(); }
  /// The next pair; none at the end.
  std::optional<BagFrame> next();

  /// Left images between start and end, by their mean rate, and how many have been read.
  std::size_t size() const { return size_; }
  std::size_t position() const { return position_; }
  /// Images between start and end that found no partner so far.
  std::size_t unpaired() const { return unpaired_; }
  /// Mean frequency of the left images [Hz], 0 if unknown.
  double rate() const { return rate_; }

 private:
  // A topic of images; messages wait here, unread, for their partner.
  struct Stream {
    struct Entry {
      std::int64_t stamp_ns;
      rosbag::MessageInstance message;
    };
    std::string topic;  // as found, "/compressed" included
    bool compressed = false;
    bool depth = false;
    std::optional<std::int64_t> last_stamp_ns;
    bool past_end = false;  // of the wanted stretch
    std::deque<Entry> waiting;
  };

  void openBag();
  void findTopics();
  void readCalibration();
  sensor_msgs::CameraInfo firstInfo(const std::string& topic);
  bool advance();  // takes one message from the bag; false at its end
  std::optional<std::pair<Stream::Entry, Stream::Entry>> nextPair();
  cv::Mat image(const Stream& stream, const Stream::Entry& entry) const;

  std::string path_;
  BagRequest request_;
  rosbag::Bag bag_;
  std::optional<rosbag::View> view_;
  rosbag::View::iterator next_message_;
  bool at_end_ = false;
  Stream left_;
  Stream second_;
  std::optional<std::int64_t> first_stamp_ns_;
  std::optional<SensorModel> model_;
  std::size_t size_ = 0;
  std::size_t position_ = 0;
  std::size_t unpaired_ = 0;
  double rate_ = 0;
};

}  // namespace mvo_ros
