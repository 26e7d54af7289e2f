// SPDX-License-Identifier: BSD-3-Clause
// Collects the messages of a recording by topic, whatever its file format, and makes a log of one laser and the base's
// odometry of them.
//
//   scans       sensor_msgs LaserScan, foxglove.LaserScan
//   odometry    nav_msgs Odometry; foxglove.PoseInFrame of topics that end in "odometry"; without any, the frames
//               (tf2_msgs or tf TFMessage, foxglove.FrameTransform) whose parent is "odom", by their child
//   mount       the frames from that of the odometry's child down to the laser's; where they do not lead there, the one
//               frame above the laser's
//
// A laser that is upside down or turns clockwise has its beams in the other order. Ranges below the least, above the
// greatest and such as are no numbers are no echoes.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "modules/logs/messages.hpp"
#include "modules/logs/sensor_log.hpp"

namespace waitpoint::logs {

class TopicLog {
 public:
  /// `name` is the file's; it must outlive this.
  explicit TopicLog(const std::string& name) : name_(name) {}

  /// BadInput, naming topic and number of the message, if it is cut off or damaged. Messages of other types are
  /// counted.
  void add(const std::string& topic, const std::string& type, Encoding encoding, std::string_view message);
  /// BadInput if there are no scans or no odometry, or several topics and `choice` does not name one of them.
  SensorLog finish(const std::string& format, const LogChoice& choice);

 private:
  struct Scans {
    std::string frame;
    std::vector<LoggedScan> scans;
  };
  struct Odometry {
    std::string child;  ///< may be unknown: empty
    std::vector<LoggedOdometry> reports;
  };

  void add_scan(const std::string& place, const std::string& topic, Encoding encoding, std::string_view message);
  void add_odometry(const std::string& place, const std::string& topic, Encoding encoding, std::string_view message);
  void add_frames(const std::string& place, Encoding encoding, std::string_view message);
  void add_frame(Time stamp, const std::string& child, const SpaceFrame& frame);
  void find_mount(const Scans& scans, const std::string& base, SensorLog& log) const;

  const std::string& name_;
  std::map<std::string, Scans> scans_;
  std::map<std::string, Odometry> odometry_, odometry_of_frames_;
  std::map<std::string, SpaceFrame> frames_;  // by child: the first
  std::map<std::string, std::uint64_t> others_;
  std::map<std::string, std::uint64_t> messages_;  // by topic: their number so far
  std::uint64_t places_ = 0;
};

}  // namespace waitpoint::logs
