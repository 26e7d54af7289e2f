// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/world/places.hpp"

#include "core/random.hpp"
#include "world/planar/separation.hpp"

namespace waitpoint::bench {
namespace {

using world::Shape;

constexpr std::size_t stations = 200;
constexpr double radius_m = 0.25, apart_m = 0.1;

Shape box(const Pose& pose, double length_m, double width_m) {
  Shape shape;
  shape.pose = pose;
  shape.length_m = length_m;
  shape.width_m = width_m;
  return shape;
}

Shape disc(Point centre, double radius_m) {
  Shape shape;
  shape.kind = Shape::Kind::cylinder;
  shape.pose = {centre.x, centre.y, 0};
  shape.radius_m = radius_m;
  return shape;
}

class Draws {
 public:
  explicit Draws(const std::string& place) : stream_(1, place, "place") {}
  double operator()(double low, double high) { return low + (high - low) * stream_.uniform(tick_++); }

 private:
  RandomStream stream_;
  std::uint64_t tick_ = 0;
};

bool touches(const std::vector<Shape>& shapes, const Shape& shape, double gap_m) {
  const world::Outline outline = world::outline_of(shape);
  for (const Shape& other : shapes)
    if (world::separation(outline, world::outline_of(other)).distance_m < gap_m) return true;
  return false;
}

void wall(Place& place, double x0, double y0, double x1, double y1, double thick_m = 0.15) {
  place.obstacles.push_back(
      box({0.5 * (x0 + x1), 0.5 * (y0 + y1), 0}, std::max(x1 - x0, thick_m), std::max(y1 - y0, thick_m)));
}

void outer_walls(Place& place) {
  wall(place, 0, 0, place.length_m, 0);
  wall(place, 0, place.width_m, place.length_m, place.width_m);
  wall(place, 0, 0, 0, place.width_m);
  wall(place, place.length_m, 0, place.length_m, place.width_m);
}

// Draws solids by `draw_one` until `count` of them are in place without contact.
template <class DrawOne>
void furnish(Place& place, std::size_t obstacles, double gap_m, DrawOne draw_one) {
  while (place.obstacles.size() < obstacles) {
    const Shape shape = draw_one();
    if (!touches(place.obstacles, shape, gap_m)) place.obstacles.push_back(shape);
  }
}

void populate(Place& place, std::size_t robots, Draws& draw) {
  std::vector<Shape> all = place.obstacles;
  while (place.stations.size() < stations) {
    const Pose at = {draw(1, place.length_m - 1), draw(1, place.width_m - 1), draw(-exact::pi, exact::pi)};
    const Shape body = disc(at.position(), radius_m);
    if (touches(all, body, apart_m)) continue;
    place.stations.push_back(at);
    if (place.robots.size() == robots) continue;
    place.robots.push_back(body);
    all.push_back(body);
  }
  if (robots > 0) {
    place.name += ", " + std::to_string(robots) + " robots";
    place.stations.resize(robots);
  }
}

}  // namespace

Place office(std::size_t robots) {
  Place place{"office", 40, 30, {}, {}, {}};
  outer_walls(place);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double x = 10 * i, y = 10 * j;  // a door of a metre in the middle of each wall
      if (i > 0) wall(place, x, y, x, y + 4.5), wall(place, x, y + 5.5, x, y + 10);
      if (j > 0) wall(place, x, y, x + 4.5, y), wall(place, x + 5.5, y, x + 10, y);
    }
  }
  Draws draw(place.name);
  furnish(place, 300, 0.05, [&] {
    const Point at = {draw(0.5, 39.5), draw(0.5, 29.5)};
    const double kind = draw(0, 1), heading = draw(0, 1) < 0.6 ? 0 : draw(-1.5, 1.5);
    if (kind < 0.3) return disc(at, draw(0.05, 0.4));
    const double width = draw(0.3, 0.9), length = draw(0.3, 1.8);
    return box({at.x, at.y, heading}, length, width);
  });
  populate(place, robots, draw);
  return place;
}

Place warehouse(std::size_t robots) {
  Place place{"warehouse", 200, 200, {}, {}, {}};
  outer_walls(place);
  for (int i = 0; i < 14; ++i)  // racks with aisles of 4 and 6 m
    for (int j = 0; j < 38; ++j) wall(place, 3 + 14 * i, 5 + 5 * j, 13 + 14 * i, 6 + 5 * j, 1);
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) place.obstacles.push_back(disc({2 + 10.0 * i, 3 + 10.0 * j}, 0.2));
  Draws draw(place.name);
  furnish(place, 5000, 0.02, [&] {
    const Pose at = {draw(0.5, 199.5), draw(0.5, 199.5), draw(0, 1) < 0.5 ? 0 : draw(-1.5, 1.5)};
    if (draw(0, 1) < 0.3) return disc(at.position(), draw(0.05, 0.4));
    const double width = draw(0.3, 0.8), length = draw(0.3, 1.2);
    return box(at, length, width);
  });
  populate(place, robots, draw);
  return place;
}

std::vector<Point> corners(const Shape& shape) {
  const world::Outline outline = world::outline_of(shape);
  std::vector<Point> around;
  if (outline.is_box) {
    for (const Point corner : world::core_points(outline)) around.push_back(corner);
    return around;
  }
  constexpr int sides = 16;
  for (int i = 0; i < sides; ++i) {
    const auto [s, c] = exact::sincos(2 * exact::pi * i / sides);
    around.push_back(outline.centre + outline.radius_m * Point{c, s});
  }
  return around;
}

}  // namespace waitpoint::bench
