// SPDX-License-Identifier: BSD-3-Clause
// Messages of ROS's package nav_msgs. Metres, radians, seconds.
#pragma once

#include "modules/messages/geometry_msgs.hpp"
#include "modules/messages/message.hpp"
#include "modules/messages/std_msgs.hpp"

namespace waitpoint::messages::nav_msgs {

struct Odometry {
  static constexpr std::string_view type_name = "nav_msgs/Odometry";
  std_msgs::Header header;
  std::string child_frame_id;
  geometry_msgs::PoseWithCovariance pose;
  geometry_msgs::TwistWithCovariance twist;
  static void fields(auto field) {
    field("header", &Odometry::header);
    field("child_frame_id", &Odometry::child_frame_id);
    field("pose", &Odometry::pose);
    field("twist", &Odometry::twist);
  }
};

struct Path {
  static constexpr std::string_view type_name = "nav_msgs/Path";
  std_msgs::Header header;
  std::vector<geometry_msgs::PoseStamped> poses;
  static void fields(auto field) {
    field("header", &Path::header);
    field("poses", &Path::poses);
  }
};

struct MapMetaData {
  static constexpr std::string_view type_name = "nav_msgs/MapMetaData";
  Stamp map_load_time;
  float resolution = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  geometry_msgs::Pose origin;
  static void fields(auto field) {
    field("map_load_time", &MapMetaData::map_load_time);
    field("resolution", &MapMetaData::resolution);
    field("width", &MapMetaData::width);
    field("height", &MapMetaData::height);
    field("origin", &MapMetaData::origin);
  }
};

struct OccupancyGrid {
  static constexpr std::string_view type_name = "nav_msgs/OccupancyGrid";
  std_msgs::Header header;
  MapMetaData info;
  std::vector<std::int8_t> data;
  static void fields(auto field) {
    field("header", &OccupancyGrid::header);
    field("info", &OccupancyGrid::info);
    field("data", &OccupancyGrid::data);
  }
};

/// The response of the service nav_msgs/GetMap, whose request is empty.
struct GetMapResponse {
  static constexpr std::string_view type_name = "nav_msgs/GetMapResponse";
  OccupancyGrid map;
  static void fields(auto field) { field("map", &GetMapResponse::map); }
};

}  // namespace waitpoint::messages::nav_msgs
