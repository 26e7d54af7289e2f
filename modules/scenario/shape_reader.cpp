// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/shape_reader.hpp"

#include <cmath>
#include <optional>

#include "core/exact_math.hpp"

namespace waitpoint::scenario {
namespace {

using world::Shape;

void read_corners(const YamlMap& map, Shape& shape) {
  if (map.has("centre_m") || map.has("size_m") || map.has("radius_m") || map.has("heading_deg")) {
    throw map.node().written.bad("expected " + map.what() +
                                 " to have corners_m alone, or centre_m with size_m or radius_m");
  }
  const YamlNode& node = map.require("corners_m");
  const std::vector<double> c = read_numbers(node, "corners_m", 4, 4, ranges::coordinate);
  shape.length_m = std::fabs(c[2] - c[0]);
  shape.width_m = std::fabs(c[3] - c[1]);
  if (shape.length_m == 0 || shape.width_m == 0)
    throw node.written.bad("expected corners_m to be opposite corners of a box");
  shape.pose = {(c[0] + c[2]) / 2, (c[1] + c[3]) / 2, 0};
}

void read_about_centre(const YamlMap& map, bool centre_needed, Shape& shape) {
  if (map.has("size_m") == map.has("radius_m")) {
    throw map.node().written.bad("expected " + map.what() + " to have " +
                                 (centre_needed ? "corners_m, or centre_m with " : "either ") + "size_m or radius_m");
  }
  Point centre;
  if (centre_needed || map.has("centre_m")) centre = read_point(map.require("centre_m"), "centre_m");
  shape.pose = {centre.x, centre.y, read_heading(map)};
  if (map.has("radius_m")) {
    shape.kind = Shape::Kind::cylinder;
    shape.radius_m = map.number("radius_m", ranges::length);
  } else {
    const std::vector<double> size = read_numbers(map.require("size_m"), "size_m", 2, 2, ranges::length);
    shape.length_m = size[0];
    shape.width_m = size[1];
  }
}

Shape read_shape(const YamlMap& map, bool of_world, std::optional<double> height_m) {
  Shape shape;
  if (of_world && map.has("corners_m")) {
    read_corners(map, shape);
  } else {
    read_about_centre(map, of_world, shape);
  }
  map.read("low_m", shape.z_low_m, ranges::height);
  shape.z_high_m = height_m && !map.has("height_m") ? *height_m : map.number("height_m", ranges::length);
  if (shape.z_high_m <= shape.z_low_m) {
    throw map.node().written.bad("expected height_m of " + map.what() + " to be above its low_m");
  }
  return shape;
}

}  // namespace

Shape read_body_shape(const YamlNode& node) {
  const YamlMap map(node, "the shape", {"centre_m", "size_m", "heading_deg", "radius_m", "low_m", "height_m"});
  return read_shape(map, false, std::nullopt);
}

std::string shape_name(const YamlNode& node, std::size_t number) {
  const std::string_view given = name_of(node);
  return given.empty() ? "shape " + std::to_string(number) : std::string(given);
}

world::Obstacle read_obstacle(const YamlNode& node, double height_m, std::size_t number) {
  const std::string name = shape_name(node, number);
  const YamlMap map(node, "'" + name + "'",
                    {"name", "corners_m", "centre_m", "size_m", "heading_deg", "radius_m", "low_m", "height_m", "known",
                     "mass_kg", "friction"});
  map.text("name", name);
  world::Obstacle obstacle{name, read_shape(map, true, height_m)};
  map.read("known", obstacle.known);
  map.read("mass_kg", obstacle.mass_kg, mass_number);
  if (const YamlNode* friction = map.find("friction")) {
    if (!obstacle.loose()) throw friction->written.bad("expected no friction: " + map.what() + " has no mass_kg");
    map.read("friction", obstacle.friction, friction_number);
  }
  return obstacle;
}

}  // namespace waitpoint::scenario
