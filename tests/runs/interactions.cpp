// SPDX-License-Identifier: BSD-3-Clause
#include "tests/runs/interactions.hpp"

#include <algorithm>
#include <cmath>

#include "modules/posters/base.hpp"

namespace waitpoint::runs {
namespace {

constexpr double wider_m = 0.05;  // margin by which other bodies are widened

// Interval of distances along a beam (direction of length 1) inside a shape; none: low > high.
struct Span {
  double low = 0, high = 0;
};
constexpr Span none{1, 0};

Span inside_disc(Point to_centre, Point direction, double radius_m) {
  const double along = dot(to_centre, direction), across = cross(to_centre, direction);
  const double square = radius_m * radius_m - across * across;
  if (square < 0) return none;
  return {along - std::sqrt(square), along + std::sqrt(square)};
}

// Interval inside the strip |coordinate| <= half, for a coordinate that starts at `from` and grows by `slope` a metre.
Span inside_strip(double from, double slope, double half) {
  if (slope == 0) return std::fabs(from) <= half ? Span{-1e9, 1e9} : none;
  const double a = (-half - from) / slope, b = (half - from) / slope;
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

Interactions::Interactions(run::Experiment& experiment) : experiment_(experiment) {
  for (const world::BodyDescription& description : experiment.world().description().bodies) {
    WAITPOINT_CHECK(description.shape.kind == world::Shape::Kind::cylinder, "a robot that is no cylinder");
    Body body{description.name, description.shape.radius_m, {}, {}, description.start.position()};
    for (const world::LaserDescription& device : description.sensors<world::Lasers>()) {
      Eye eye{device, {}};
      for (std::uint32_t i = 0; i < device.beams; ++i) {
        const auto [s, c] = exact::sincos(device.field_of_view_rad * (i / (device.beams - 1.0) - 0.5));
        eye.directions.push_back({c, s});
      }
      body.eyes.push_back(std::move(eye));
    }
    body.now = body.before;
    bodies_.push_back(std::move(body));
  }
  for (const world::Obstacle& obstacle : experiment.world().description().obstacles) {
    const auto [s, c] = exact::sincos(obstacle.shape.pose.heading);
    obstacles_.push_back({obstacle.shape, {c, s}, {-s, c}});
  }
}

void Interactions::observe() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    bodies_[i].before = bodies_[i].now;
    bodies_[i].now = experiment_.world().body(world::BodyId(i)).pose.position();
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    for (std::size_t j = 0; j < bodies_.size(); ++j) {
      const Body &body = bodies_[i], &other = bodies_[j];
      const auto pair = std::minmax(body.name, other.name);
      if (i == j || pairs_.contains(pair)) continue;
      const bool touch = length(body.now - other.now) < body.radius_m + other.radius_m + wider_m;
      const Pose& pose = experiment_.world().body(world::BodyId(i)).pose;
      if (touch || hears(body, i, other) || sees(body, pose, other)) pairs_.insert(pair);
    }
  }
}

bool Interactions::sees(const Body& body, const Pose& pose, const Body& other) {
  for (const Eye& eye : body.eyes) {
    const Pose at = compose(pose, eye.device.mount);
    for (const Point centre : {other.now, other.before})
      if (sees(eye, at, centre, other.radius_m + wider_m)) return true;
  }
  return false;
}

bool Interactions::sees(const Eye& eye, const Pose& at, Point centre, double radius_m) {
  const Point to_centre = centre - at.position();
  if (length(to_centre) > eye.device.range_max_m + radius_m) return false;
  const auto [s, c] = exact::sincos(at.heading);
  for (const Point& d : eye.directions) {
    const Point direction = {c * d.x - s * d.y, s * d.x + c * d.y};
    const Span span = inside_disc(to_centre, direction, radius_m);
    if (span.low > span.high || span.high < 0 || span.low > eye.device.range_max_m) continue;
    if (!hidden(at.position(), direction, span.low, eye.device.height_m)) return true;
  }
  return false;
}

// True if a fixed obstacle stops the beam before `distance_m`.
bool Interactions::hidden(Point origin, Point direction, double distance_m, double height_m) {
  if (!obstacles_.empty() && hides(obstacles_[hid_last_], origin, direction, distance_m, height_m)) return true;
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    if (!hides(obstacles_[i], origin, direction, distance_m, height_m)) continue;
    hid_last_ = i;
    return true;
  }
  return false;
}

bool Interactions::hides(const Obstacle& obstacle, Point origin, Point direction, double distance_m, double height_m) {
  const world::Shape& shape = obstacle.shape;
  if (height_m < shape.z_low_m || height_m > shape.z_high_m) return false;
  const Point to_centre = shape.pose.position() - origin;
  Span span = inside_disc(to_centre, direction, shape.radius_m);
  if (shape.kind == world::Shape::Kind::box) {
    const Point &x_axis = obstacle.x_axis, &y_axis = obstacle.y_axis;
    const Span x = inside_strip(-dot(to_centre, x_axis), dot(direction, x_axis), 0.5 * shape.length_m);
    const Span y = inside_strip(-dot(to_centre, y_axis), dot(direction, y_axis), 0.5 * shape.width_m);
    span = {std::max(x.low, y.low), std::min(x.high, y.high)};
  }
  return span.low <= span.high && span.high >= 0 && span.low < distance_m;
}

bool Interactions::hears(const Body& body, std::size_t number, const Body& other) const {
  const world::BodyDescription& description = experiment_.world().description().bodies[number];
  if (description.sensors<world::Sonars>().empty()) return false;
  const auto* poster = dynamic_cast<const genom::Poster<posters::BaseCommand>*>(
      experiment_.robots().at(number)->names().find_poster("rflex.command"));
  const auto command = poster != nullptr ? poster->look() : std::nullopt;
  if (!command || !command->sonars_on) return false;
  double reach_m = 0;
  for (const world::SonarRingDescription& ring : description.sensors<world::Sonars>())
    reach_m = std::max(reach_m, ring.ring_radius_m + ring.range_max_m);
  return length(body.now - other.now) < reach_m + other.radius_m + wider_m;
}

std::set<std::string> related(const std::string& robot, const Pairs& pairs) {
  std::set<std::string> found = {robot};
  for (std::size_t before = 0; before != found.size();) {
    before = found.size();
    for (const auto& [a, b] : pairs) {
      if (found.contains(a)) found.insert(b);
      if (found.contains(b)) found.insert(a);
    }
  }
  return found;
}

}  // namespace waitpoint::runs
