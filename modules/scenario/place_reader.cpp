// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/place_reader.hpp"

#include "core/exact_math.hpp"

namespace waitpoint::scenario {
namespace {

double read_degrees_of_heading(const YamlNode& node) {
  return exact::wrap_angle(radians(read_number(node, "heading_deg", heading_range)));
}

void read_written_point(const YamlNode& node, std::string_view what, Point& point) {
  if (node.kind == YamlNode::Kind::map) {
    const YamlMap map(node, std::string(what), {"x_m", "y_m"});
    point.x = map.number("x_m", ranges::coordinate);
    point.y = map.number("y_m", ranges::coordinate);
  } else {
    const std::vector<double> xy = read_numbers(node, what, 2, 2, ranges::coordinate);
    point = {xy[0], xy[1]};
  }
}

void read_written_pose(const YamlNode& node, std::string_view what, Pose& pose) {
  if (node.kind == YamlNode::Kind::map) {
    const YamlMap map(node, std::string(what), {"x_m", "y_m", "heading_deg"});
    const double x = map.number("x_m", ranges::coordinate), y = map.number("y_m", ranges::coordinate);
    pose = {x, y, read_heading(map)};
  } else {
    const std::vector<double> numbers = read_numbers(node, what, 2, 3, ranges::coordinate);
    pose = {numbers[0], numbers[1], 0};
    if (numbers.size() == 3) pose.heading = read_degrees_of_heading(node.items[2]);
  }
}

/// Of a map with x_m and y_m.
Json place_map_schema(const SchemaDefinitions& definitions, Json properties) {
  properties["x_m"] = described("forward, or to the east on a map [m]", number_schema(ranges::coordinate));
  properties["y_m"] = described("to the left, or to the north on a map [m]", number_schema(ranges::coordinate));
  Json schema = {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
  if (!definitions.is_partial()) schema["required"] = {"x_m", "y_m"};
  return schema;
}

Json pose_list_schema() {
  const Json coordinate = number_schema(ranges::coordinate);
  Json schema = list_schema(number_schema(heading_range), 2);
  schema["prefixItems"] = {coordinate, coordinate};
  schema["maxItems"] = 3;
  return schema;
}

}  // namespace

Form<double> heading_form() {
  Form<double> form = degrees_form(heading_range);
  form.read = [](const YamlNode& node, std::string_view, double& heading_rad) {
    heading_rad = read_degrees_of_heading(node);
  };
  return form;
}

Form<Point> point_form() {
  return {read_written_point,
          [](SchemaDefinitions& definitions) {
            return any_of({numbers_schema(ranges::coordinate, 2, 2), place_map_schema(definitions, Json::object())});
          },
          [](const Point& point) {
            return Json::array({point.x, point.y});
          }};
}

Form<Pose> pose_form() {
  return {read_written_pose,
          [](SchemaDefinitions& definitions) {
            return any_of(
                {pose_list_schema(),
                 place_map_schema(definitions, {{"heading_deg", described("counter-clockwise [deg]",
                                                                          or_null(number_schema(heading_range)))}})});
          },
          [](const Pose& pose) {
            return Json::array({pose.x, pose.y, pose.heading / exact::pi * 180});
          }};
}

Point read_point(const YamlNode& node, std::string_view what) {
  Point point;
  read_written_point(node, what, point);
  return point;
}

Pose read_pose(const YamlNode& node, std::string_view what) {
  Pose pose;
  read_written_pose(node, what, pose);
  return pose;
}

double read_heading(const YamlMap& map) {
  const YamlNode* const heading = map.find("heading_deg");
  return heading == nullptr ? 0 : read_degrees_of_heading(*heading);
}

}  // namespace waitpoint::scenario
