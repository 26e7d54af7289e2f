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
// Messages are in the order in which the recorder got them, as `rosbag play` has it; the order in the file, in which
// chunks may overlap, decides among those of one time. A laser that is upside down or turns clockwise has its beams in
// the other order. Ranges below the least, above the greatest and such as are no numbers are no echoes.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "modules/logs/recorded_message.hpp"
#include "modules/logs/sensor_log.hpp"
#include "modules/messages/tf2_msgs.hpp"

namespace waitpoint::logs {

class TopicLog {
 public:
  /// `name` is the file's; it must outlive this.
  explicit TopicLog(const std::string& name) : name_(name) {}

  /// BadInput, naming topic and number of the message, if it is cut off or damaged. Messages of other types are
  /// counted.
  void add(const RecordedMessage& message);
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

  struct Frame {
    Time received;
    std::string parent;
    messages::geometry_msgs::Transform transform;
  };

  std::string next_place(const std::string& topic);
  void add_scan(const RecordedMessage& message, const std::string& frame, LoggedScan scan);
  void add_odometry(const RecordedMessage& message, const std::string& child, Time stamp, const Pose& pose);
  void add_frame(const RecordedMessage& message, const std::string& place,
                 const messages::geometry_msgs::TransformStamped& frame);
  void find_mount(const Scans& scans, const std::string& base, SensorLog& log) const;

  const std::string& name_;
  std::map<std::string, Scans> scans_;
  std::map<std::string, Odometry> odometry_, odometry_of_frames_;
  std::map<std::string, Frame> frames_;  // by child: the first
  std::map<std::string, std::uint64_t> others_;
  std::map<std::string, std::uint64_t> messages_;  // by topic: their number so far
  std::uint64_t places_ = 0;
};

}  // namespace waitpoint::logs
