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

Json size_schema(SchemaDefinitions&) { return numbers_schema(ranges::length, 2, 2); }
Json corners_schema(SchemaDefinitions&) { return numbers_schema(ranges::coordinate, 4, 4); }

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

const KeyTable& body_shape_keys() {
  static const KeyTable keys =
      KeyTable("shape of a robot")
          .add("centre_m", point_form().schema, "centre in the robot's frame")
          .add("size_m", size_schema, "of a box: length and width")
          .add("heading_deg", heading_form().schema, "of a box")
          .add("radius_m", number_form(ranges::length).schema, "of a cylinder")
          .add("low_m", number_form(ranges::height).schema, "height of the lower end")
          .add("height_m", number_form(ranges::length).schema, "height of the upper end", Need::required)
          .require({{"oneOf", {needed({"size_m"}), needed({"radius_m"})}}});
  return keys;
}

const KeyTable& obstacle_keys() {
  static const Json about_centre = needed({"centre_m"});
  static const KeyTable keys =
      KeyTable("shape")
          .add("name", text_form().schema, "its name in messages")
          .add("corners_m", corners_schema, "of a box along the axes: two opposite corners, `[x, y, x, y]`")
          .add("centre_m", point_form().schema, "of a turned box or a cylinder")
          .add("size_m", size_schema, "of a turned box: length and width")
          .add("heading_deg", heading_form().schema, "of a turned box")
          .add("radius_m", number_form(ranges::length).schema, "of a cylinder")
          .add("low_m", number_form(ranges::height).schema, "height of the lower end")
          .add("height_m", number_form(ranges::length).schema, "height of the upper end")
          .add("known", truth_form().schema, "`false`: it exists, but is on no map of the robots")
          .add("mass_kg", number_form(mass_number).schema, "in a dynamic world it can be pushed")
          .add("friction", number_form(friction_number).schema, "of one with a mass: with the floor")
          .require(
              {{"oneOf", {needed({"corners_m"}), needed({"centre_m", "size_m"}), needed({"centre_m", "radius_m"})}}})
          .require({{"if", needed({"corners_m"})},
                    {"then", {{"not", {{"anyOf", {about_centre, needed({"heading_deg"})}}}}}}})
          .require({{"if", needed({"friction"})}, {"then", needed({"mass_kg"})}});
  return keys;
}

Shape read_body_shape(const YamlNode& node) {
  return read_shape(YamlMap(node, "the shape", body_shape_keys().names()), false, std::nullopt);
}

std::string shape_name(const YamlNode& node, std::size_t number) {
  const std::string_view given = name_of(node);
  return given.empty() ? "shape " + std::to_string(number) : std::string(given);
}

world::Obstacle read_obstacle(const YamlNode& node, double height_m, std::size_t number) {
  const std::string name = shape_name(node, number);
  const YamlMap map(node, "'" + name + "'", obstacle_keys().names());
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
