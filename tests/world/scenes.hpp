// SPDX-License-Identifier: BSD-3-Clause
// Helpers to make worlds for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "world/kinematic/kinematic_world.hpp"
#include "world/planar/outline.hpp"

namespace waitpoint::world {

inline Shape box(const Pose& pose, double length_m, double width_m) {
  Shape shape;
  shape.pose = pose;
  shape.length_m = length_m;
  shape.width_m = width_m;
  return shape;
}

inline Shape cylinder(Point centre, double radius_m) {
  Shape shape;
  shape.kind = Shape::Kind::cylinder;
  shape.pose = {centre.x, centre.y, 0};
  shape.radius_m = radius_m;
  return shape;
}

/// The upright prism over the convex hull of the points, which are in the frame of `at` and must not be collinear.
inline Shape prism(const Pose& at, const std::vector<Point>& points) {
  const PlacedPolygon hull = hull_of(points, 0).value();
  Shape shape;
  shape.kind = Shape::Kind::prism;
  shape.pose = compose(at, {hull.origin.x, hull.origin.y, 0});
  shape.length_m = 2 * hull.polygon->half_size().x;
  shape.width_m = 2 * hull.polygon->half_size().y;
  shape.polygon = hull.polygon;
  return shape;
}

/// For example "r3".
inline std::string numbered(const char* word, std::size_t number) {
  std::string name = word;
  name += std::to_string(number);
  return name;
}

/// A body that reaches any commanded velocity in one step, with a perfect odometer.
inline BodyDescription nimble_body(const std::string& name, const Shape& shape, const Pose& start) {
  BodyDescription body;
  body.name = name;
  body.shape = shape;
  body.start = start;
  body.base.v_max_m_s = body.base.w_max_rad_s = 1e5;
  body.base.v_acceleration_m_s2 = body.base.w_acceleration_rad_s2 = 1e9;
  return body;
}

/// A laser without errors.
inline LaserDescription perfect_laser(double height_m) {
  LaserDescription laser;
  laser.height_m = height_m;
  laser.range_noise_m = laser.resolution_m = 0;
  return laser;
}

/// Uniform draws, in sequence.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : stream_(seed, "test", "draws") {}
  double operator()(double low, double high) { return low + (high - low) * stream_.uniform(tick_++); }
  std::uint64_t below(std::uint64_t bound) { return stream_.below(bound, tick_++); }

 private:
  RandomStream stream_;
  std::uint64_t tick_ = 0;
};

/// A prism of 3 to 20 corners, within a box of that size.
inline Shape random_prism(Draws& draw, const Pose& at, double length_m, double width_m) {
  const std::uint64_t count = 3 + draw.below(3) * draw.below(10);
  std::vector<Point> points = {{-0.5 * length_m, -0.3 * width_m}, {0.5 * length_m, 0.2 * width_m}, {0, 0.5 * width_m}};
  while (points.size() < count) {
    // Near the edge of an ellipse, where more of them are corners.
    const double x = draw(-0.5, 0.5), y = (draw.below(2) == 0 ? -0.5 : 0.5) * std::sqrt(1 - 4 * x * x) * draw(0.9, 1);
    points.push_back({length_m * x, width_m * y});
  }
  return prism(at, points);
}

/// A box, a prism or a cylinder somewhere in a square about the origin.
inline Shape random_shape(Draws& draw, double half_square_m, double size_max_m) {
  const double x = draw(-half_square_m, half_square_m), y = draw(-half_square_m, half_square_m);
  if (draw(0, 1) < 0.4) return cylinder({x, y}, draw(0.05, 0.5 * size_max_m));
  const double heading = draw(0, 1) < 0.4 ? 0 : draw(-3, 3);
  const double length = draw(0.05, size_max_m), width = draw(0.05, size_max_m);
  if (draw(0, 1) < 0.35) return random_prism(draw, {x, y, heading}, length, width);
  return box({x, y, heading}, length, width);
}

/// Shapes of at most 2.5 m in such a square; some are lower than 0.5 m, some begin above 0.45 m.
inline std::vector<Shape> random_shapes(std::uint64_t seed, int count, double half_square_m) {
  Draws draw(seed);
  std::vector<Shape> shapes;
  for (int i = 0; i < count; ++i) {
    Shape shape = random_shape(draw, half_square_m, 2.5);
    if (i % 7 == 0) shape.z_high_m = 0.5;
    if (i % 11 == 0) shape.z_low_m = 0.45;
    shapes.push_back(shape);
  }
  return shapes;
}

/// The sensor's last reading, or that of now.
template <class S>
typename S::Reading reading(const World& world, BodyId id = BodyId(0), std::uint64_t number = 0) {
  typename S::Reading reading;
  world.read<S>(id, number, reading);
  return reading;
}

/// The ranges of a ring's sonars after the firing of that number, from 0; those that do not fire keep theirs.
inline void fire(const World& world, BodyId id, std::size_t ring, std::uint64_t firing, std::vector<double>& range_m) {
  Sonars::Reading reading;
  for (const double range : range_m) reading.range_m.push_back(range);
  world.read<Sonars>(id, firing + 1, reading, ring);
  range_m.assign(reading.range_m.begin(), reading.range_m.end());
}

/// A direction from `origin` that only just touches the outline: to a corner, or along a tangent.
inline Point grazing_direction(const Outline& outline, Point origin, Draws& draw) {
  if (outline.is_box || outline.polygon != nullptr) {
    const CorePoints corners = core_points(outline);
    const Point d = corners[draw.below(corners.count())] - origin;
    return (1 / length(d)) * d;
  }
  const Point d = outline.centre - origin;
  const double distance = length(d), sine = std::min(outline.radius_m / distance, 1.0);
  const double cosine = std::sqrt(1 - sine * sine), side = draw.below(2) == 0 ? sine : -sine;
  return (1 / distance) * Point{cosine * d.x - side * d.y, side * d.x + cosine * d.y};
}

}  // namespace waitpoint::world
