// SPDX-License-Identifier: BSD-3-Clause
// Frames: the state of the floor at an instant, as JSON, with the changes since the frame before: true and
// estimated poses, scans, sonars, routes, segments mapped, goals, obstacles. Reading is not an event: a run is the same
// with and without it.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "modules/posters/base.hpp"
#include "modules/posters/followed_route.hpp"
#include "modules/posters/laser.hpp"
#include "modules/run/experiment.hpp"
#include "tools/record/robot_posters.hpp"
#include "tools/view/view_json.hpp"

namespace waitpoint::tools::view {

/// The part of the floor that a viewer looks at, in metres.
struct Section {
  Point low, high;

  bool holds(Point p) const { return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y; }
};

struct FrameOptions {
  int line = 0;                        ///< the line of time that it is of
  bool scans = true;                   ///< of lasers and sonars
  std::optional<Section> section{};    ///< robots elsewhere are left out
  std::optional<std::size_t> robot{};  ///< of the others there is only where they are and how far they have come
  bool whole = false;                  ///< for a reader that has no frame before it
};

/// {"scans", "view": [left, bottom, right, top], "robot", "whole"} of a request for frames; BadInput for others.
FrameOptions frame_options(const Json& request, std::size_t robots);

class FrameReader {
 public:
  /// Before the run. The scenario, which is the experiment's, and the experiment must outlive this.
  FrameReader(const scenario::Scenario& scenario, const run::Experiment& experiment);

  /// {"kind":"frame","line":0,"time":...,"news":...}, without the last brace, for the state at `now`; between events
  /// of the run. "news": it has parts that further frames leave out as unchanged. A whole frame without obstacles has
  /// those of the scene.
  std::string read(Time now, const FrameOptions& options);

 private:
  struct OfRobot {
    const bridge::Robot& robot;
    world::BodyId body;
    std::vector<RecordedSensor<world::Lasers>> lasers;
    RobotPosters posters;
    NewValues<posters::Sonars> sonars;
    NewValues<posters::SegmentMap> segments;
    const posters::FollowedRoute* module;  // that follows a route; null: none
    std::optional<std::vector<Point>> route = {};
    std::optional<Pose> odometry = {};
    std::optional<posters::PositionEstimate> position = {};
  };

  void take_up_robots();
  bool shows_as_drawn() const;
  void add(OfRobot& robot, const FrameOptions& options, std::string& text);
  static void add_poses(OfRobot& robot, std::string& text);
  static void add_scans(OfRobot& robot, std::string& text);
  void add_news(OfRobot& robot, std::string& text);
  void add_obstacles(std::string& text);

  const scenario::Scenario& scenario_;
  const run::Experiment& experiment_;
  std::deque<OfRobot> robots_;
  std::vector<world::Shape> at_start_, drawn_;  // the obstacles of the scene, and of the last frame
  bool has_news_ = false;                       // the frame that is being made
};

}  // namespace waitpoint::tools::view
