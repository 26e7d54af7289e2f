// SPDX-License-Identifier: BSD-3-Clause
// Which robots had to do with each other in a run, found from the truth alone: where the bodies were, what stands
// between them, and how their lasers look. Neither the digest nor what the robots measured is asked.
//
// Two robots interact when a beam of one would end on the other, when they come near to a contact, or when one is
// within reach of the other's sonars while these are on. Where this errs, it finds an interaction that was none: other
// bodies are taken a little wider than they are and do not hide each other, and every step counts as one at which a
// laser looks.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "modules/run/experiment.hpp"

namespace waitpoint::runs {

/// Robots by their names; the lesser name first.
using Pairs = std::set<std::pair<std::string, std::string>>;

class Interactions {
 public:
  /// All bodies must be cylinders about the robots' centres.
  explicit Interactions(bridge::Experiment& experiment);

  /// To be called at the start and after every step of the world.
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
    Point now, before;  // as of this step and of the one before
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

  bridge::Experiment& experiment_;
  std::vector<Body> bodies_;
  std::vector<Obstacle> obstacles_;
  std::size_t hid_last_ = 0;  // the obstacle that will most likely hide the next beam too
  Pairs pairs_;
};

/// The robot, all that interact with it, all that interact with those, and so on.
std::set<std::string> related(const std::string& robot, const Pairs& pairs);

}  // namespace waitpoint::runs
