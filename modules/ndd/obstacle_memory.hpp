// SPDX-License-Identifier: BSD-3-Clause
// Known obstacle points around the robot: the echoes of the newest scan, and those of earlier scans outside its view.
//
// The laser sees only half the plane, from a place other than the robot's centre; an obstacle that has just left the
// view may be right beside the robot. Points are kept in the odometry frame, which is smooth, and are deleted when a
// beam passes through them, when they are far, or when they are old.
#pragma once

#include <span>
#include <vector>

#include "modules/ndd/parameters.hpp"
#include "modules/posters/laser.hpp"

namespace waitpoint::ndd {

class ObstacleMemory {
 public:
  explicit ObstacleMemory(const Parameters& parameters);

  /// Adds a scan made with the robot at `robot` in the odometry frame.
  void see(const Pose& robot, const posters::Echoes& echoes);
  void forget() { scan_.clear(), past_.clear(); }

  /// Replaces `points` by all known points, in the frame of `robot` (a pose in the odometry frame).
  void points_from(const Pose& robot, std::vector<Point>& points) const;

  /// The newest scan's points in the odometry frame.
  std::span<const Point> newest() const { return scan_; }
  std::size_t remembered() const { return past_.size(); }

 private:
  struct Remembered {
    Point point;
    Time seen;
  };
  void drop_contradicted(const Pose& device, const posters::LaserReading& scan);
  void keep_newest(const Pose& robot);

  Parameters parameters_;
  Time seen_;                     // date of scan_
  std::vector<Point> scan_;       // odometry frame
  std::vector<Remembered> past_;  // odometry frame, oldest first
};

}  // namespace waitpoint::ndd
