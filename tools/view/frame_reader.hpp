// SPDX-License-Identifier: BSD-3-Clause
// Frames: the state of the floor at an instant, as JSON, with what has changed since the frame before: true and
// estimated poses, scans, sonars, routes, segments mapped, goals, obstacles. Reading is not an event: a run is the same
// with and without it.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "modules/posters/base.hpp"
#include "modules/posters/followed_route.hpp"
#include "modules/run/experiment.hpp"
#include "tools/record/robot_posters.hpp"

namespace waitpoint::tools::view {

/// The part of the floor that a viewer looks at, in metres.
struct Section {
  Point low, high;

  bool holds(Point p) const { return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y; }
};

struct FrameOptions {
  int line = 0;                      ///< the line of time that it is of
  bool scans = true;                 ///< of lasers and sonars
  std::optional<Section> section{};  ///< robots elsewhere are left out
};

class FrameReader {
 public:
  /// The scenario, which is the experiment's, and the experiment must outlive this.
  FrameReader(const scenario::Scenario& scenario, const run::Experiment& experiment);

  /// {"kind":"frame","line":0,"time":...}, without the last brace, for the state at `now`; between events of the run.
  std::string read(Time now, const FrameOptions& options);

 private:
  struct OfRobot {
    const bridge::Robot& robot;
    world::BodyId body;
    std::vector<RecordedLaser> lasers;
    RobotPosters posters;
    NewValues<posters::Sonars> sonars;
    NewValues<posters::SegmentMap> segments;
    const posters::FollowedRoute* module;  // that follows a route; null: none
    std::optional<std::vector<Point>> route = {};
    std::optional<Pose> odometry = {};
    std::optional<posters::PositionEstimate> position = {};
  };

  void add(OfRobot& robot, const FrameOptions& options, std::string& text);
  static void add_scans(OfRobot& robot, std::string& text);
  static void add_news(OfRobot& robot, std::string& text);
  void add_obstacles(std::string& text);

  const run::Experiment& experiment_;
  std::deque<OfRobot> robots_;
  std::vector<world::Shape> drawn_;  // the obstacles of the last frame
};

}  // namespace waitpoint::tools::view
