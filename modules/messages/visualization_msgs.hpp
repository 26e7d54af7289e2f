// SPDX-License-Identifier: BSD-3-Clause
// Messages of ROS's package visualization_msgs. Metres, radians, seconds.
#pragma once

#include "modules/messages/geometry_msgs.hpp"
#include "modules/messages/message.hpp"
#include "modules/messages/std_msgs.hpp"

namespace waitpoint::messages::visualization_msgs {

struct Marker {
  static constexpr std::string_view type_name = "visualization_msgs/Marker";
  static constexpr Constant<std::uint8_t> constants[] = {
      {"ARROW", 0},          {"CUBE", 1},           {"SPHERE", 2},      {"CYLINDER", 3}, {"LINE_STRIP", 4},
      {"LINE_LIST", 5},      {"CUBE_LIST", 6},      {"SPHERE_LIST", 7}, {"POINTS", 8},   {"TEXT_VIEW_FACING", 9},
      {"MESH_RESOURCE", 10}, {"TRIANGLE_LIST", 11}, {"ADD", 0},         {"MODIFY", 0},   {"DELETE", 2},
      {"DELETEALL", 3}};
  std_msgs::Header header;
  std::string ns;
  std::int32_t id = 0;
  std::int32_t type = 0;
  std::int32_t action = 0;
  geometry_msgs::Pose pose;
  geometry_msgs::Vector3 scale;
  std_msgs::ColorRGBA color;
  Span lifetime;
  bool frame_locked = false;
  std::vector<geometry_msgs::Point> points;
  std::vector<std_msgs::ColorRGBA> colors;
  std::string text;
  std::string mesh_resource;
  bool mesh_use_embedded_materials = false;
  static void fields(auto field) {
    field("header", &Marker::header);
    field("ns", &Marker::ns);
    field("id", &Marker::id);
    field("type", &Marker::type);
    field("action", &Marker::action);
    field("pose", &Marker::pose);
    field("scale", &Marker::scale);
    field("color", &Marker::color);
    field("lifetime", &Marker::lifetime);
    field("frame_locked", &Marker::frame_locked);
    field("points", &Marker::points);
    field("colors", &Marker::colors);
    field("text", &Marker::text);
    field("mesh_resource", &Marker::mesh_resource);
    field("mesh_use_embedded_materials", &Marker::mesh_use_embedded_materials);
  }
};

struct MarkerArray {
  static constexpr std::string_view type_name = "visualization_msgs/MarkerArray";
  std::vector<Marker> markers;
  static void fields(auto field) { field("markers", &MarkerArray::markers); }
};

}  // namespace waitpoint::messages::visualization_msgs
