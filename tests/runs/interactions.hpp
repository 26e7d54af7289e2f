// SPDX-License-Identifier: BSD-3-Clause
// The pairs of robots that interact in a run, computed from the truth alone: the poses of bodies, the obstacles between
// them, and the directions of their lasers. Digests and readings are not used.
//
// Two robots interact if a beam of one would end on the other, if they are near a contact, or if one is within the
// range of the other's sonars while these are on. Errors are on the safe side: other bodies are widened a little and do
// not hide each other, and every step counts as a scan.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "modules/run/experiment.hpp"

namespace waitpoint::runs {

/// Names of two robots; the lesser name first.
using Pairs = std::set<std::pair<std::string, std::string>>;

class Interactions {
 public:
  /// All bodies must be cylinders centred on their robots.
  explicit Interactions(run::Experiment& experiment);

  /// Call at the start and after every step of the world.
  void observe();
  const Pairs& pairs() const { return pairs_; }

 private:
  struct Eye {  // a laser of a robot
    world::LaserDescription device;
    std::vector<Point> directions;  // of its beams, in its own frame
  };
  struct Body {
    std::string name;
    double radius_m = 0;
    std::vector<Eye> eyes;
    Point now, before;  // at this step and at the previous one
  };

  struct Obstacle {
    world::Shape shape;
    Point x_axis, y_axis;  // of a box
  };

  bool sees(const Body& body, const Pose& pose, const Body& other);
  bool sees(const Eye& eye, const Pose& at, Point centre, double radius_m);
  bool hidden(Point origin, Point direction, double distance_m, double height_m);
  static bool hides(const Obstacle& obstacle, Point origin, Point direction, double distance_m, double height_m);
  bool hears(const Body& body, std::size_t number, const Body& other) const;

  run::Experiment& experiment_;
  std::vector<Body> bodies_;
  std::vector<Obstacle> obstacles_;
  std::size_t hid_last_ = 0;  // the obstacle that hid the last beam: it most likely hides the next one too
  Pairs pairs_;
};

/// The robot and all robots related to it by interactions, directly or through others.
std::set<std::string> related(const std::string& robot, const Pairs& pairs);

}  // namespace waitpoint::runs
