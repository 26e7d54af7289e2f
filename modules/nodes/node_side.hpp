// SPDX-License-Identifier: BSD-3-Clause
// The side of a run that ROS nodes see: a master, and a node that is the world. It is in a library of its own, which is
// loaded by the first scenario with nodes, so that other programs do not need ROS.
//
//   world -> WorldNode (world_node.hpp) -> NodeSide -> topics -> nodes
//   nodes -> topics -> NodeSide -> WorldNode -> interventions -> world
//
// Names and frames are those of REP 103 and 105: x ahead, y to the left, angles counter-clockwise; map -> odom ->
// base_link. Metres, radians, seconds.
//
// C++17, and plain values only: ROS's messages do not compile as C++20.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "modules/nodes/bag_side.hpp"
#include "modules/nodes/master_side.hpp"

namespace waitpoint::nodes {

struct Place {
  double x = 0, y = 0, heading = 0, z = 0;
};

struct Speeds {
  double ahead = 0, left = 0, up = 0, turn = 0;
};

struct LaserTopic {
  std::string topic, frame;
  Place mount;  ///< in base_link
  double range_max = 0, period_s = 0;
};

/// A ring of sonars, one message for each.
struct SonarTopic {
  std::string topic;
  std::vector<std::string> frames;
  std::vector<Place> mounts;
  double field_of_view = 0, range_min = 0, range_max = 0;
};

/// A topic of nodes that is shown: a path, a cloud of poses or a grid.
struct ShownTopic {
  enum class Kind : unsigned char { path, cloud, grid };
  std::string topic;
  Kind kind = Kind::path;
};

struct RobotTopics {
  std::string space;   ///< of its topics: "/" or "/rackham"
  std::string prefix;  ///< of its frames: "" or "rackham/"
  Place start;         ///< in the map
  std::vector<LaserTopic> lasers;
  std::vector<SonarTopic> sonars;
  bool has_imu = false;
  std::vector<std::string> posters;  ///< topics of modules' posters, within `space`
  std::vector<ShownTopic> shown;
  bool takes_pose = false;         ///< from the topic `pose`
  bool gives_map_to_odom = false;  ///< the transform between them is the true one, as no node estimates it
};

/// A map known to the robots.
struct GridValues {
  int width = 0, height = 0;
  double resolution = 0;
  Place origin;                    ///< the outer corner of the first cell
  std::vector<std::int8_t> cells;  ///< row by row: 0 free, 100 occupied, -1 unknown
};

/// What messages of a topic are to be, each of them.
struct TopicBound {
  enum class Relation : unsigned char { at_least, at_most, equal };

  std::string topic, field;  ///< "/odom", "pose.pose.position.x"
  Relation relation = Relation::equal;
  double limit = 0;
  std::string text;  ///< as written: "/odom.pose.pose.position.x<=10"
};

struct NodeSideSetup {
  bool has_clock = false;          ///< publishes /clock; use_sim_time is set
  bool has_debian_master = false;  ///< in place of one inside
  std::vector<RobotTopics> robots;
  GridValues map;
  std::vector<std::pair<std::string, nlohmann::json>> parameters;  ///< by global name; maps only within lists
  std::vector<TopicBound> bounds;
};

struct ScanReading {
  std::size_t laser = 0;
  std::int64_t date_ns = 0;  ///< virtual
  double first_angle = 0, angle_step = 0;
  std::vector<double> ranges;  ///< from range_max on: no echo
};

struct SonarReading {
  std::size_t ring = 0;
  std::vector<double> ranges;  ///< from range_max on: no echo
};

struct ImuReading {
  double turn = 0;                     ///< rad/s
  double ahead = 0, left = 0, up = 0;  ///< m/s2
};

struct BatteryReading {
  double volts = 0, current_a = 0;
  double charge = 1;  ///< of 1
};

// What modules have in their posters: poster_topics.hpp.
struct PoseReading {
  Place place;                         ///< in the map
  std::array<double, 9> covariance{};  ///< of x, y, heading, in row order
};
struct OdometryReading {
  Place place;  ///< in the frame of the module that has made it
  std::array<double, 9> covariance{};
  Speeds speeds;
};
struct EchoesReading {
  double first_angle = 0, angle_step = 0, range_max = 0;
  std::vector<double> ranges;  ///< from range_max on: no echo
};
using PosterValue = std::variant<PoseReading, OdometryReading, EchoesReading, Speeds, ImuReading>;
struct PosterReading {
  std::size_t topic = 0;     ///< of RobotTopics::posters; one topic has values of one type
  std::int64_t date_ns = 0;  ///< virtual
  PosterValue value;
};

/// What a node has published as `pose`.
struct PublishedPose {
  std::int64_t date_ns = 0;  ///< virtual, of its stamp
  PoseReading pose;
};

/// A message of a topic that is shown.
struct ShownReading {
  std::string topic;  ///< global
  ShownTopic::Kind kind = ShownTopic::Kind::path;
  std::int64_t date_ns = 0;
  std::string frame;
  std::vector<Place> places;  ///< of paths and clouds
  GridValues grid;            ///< of grids
};

/// Of one robot, after a step of the world.
struct RobotReadings {
  bool has_odometry = false;                    ///< odometry and transforms are due: what follows up to `measured`
  Place truth;                                  ///< in the map
  Speeds speeds;                                ///< true
  Place odometry;                               ///< in `odom`, which is where the robot started
  std::array<double, 9> odometry_covariance{};  ///< of x, y, heading, in row order
  Speeds measured;
  std::vector<ScanReading> scans;    ///< those that are due
  std::vector<SonarReading> sonars;  ///< those that are due
  std::optional<ImuReading> imu;
  std::optional<BatteryReading> battery;
  std::vector<PosterReading> posters;  ///< those with new values
};

/// What nodes ask of a robot by cmd_vel.
struct Command {
  Speeds speeds;               ///< as they are, of the newest message
  std::uint32_t messages = 1;  ///< those that came, as far as the queue has kept them
};

class NodeSide : public MasterSide {
 public:
  /// The readings of all robots at the world's step at this virtual time.
  virtual void publish(std::int64_t now_ns, const std::vector<RobotReadings>& robots) = 0;
  /// True if somebody takes the robot's goals.
  virtual bool has_driver(std::size_t robot) const = 0;
  /// The robot's next goal, in the map.
  virtual void send_goal(std::size_t robot, const Place& goal) = 0;
  /// By robot, what has come since the last call.
  virtual std::vector<std::optional<Command>> take_commands() = 0;
  /// After that: by robot, the newest pose since the last call, as it is.
  virtual std::vector<std::optional<PublishedPose>> take_poses() = 0;
  /// Since the last call, of each bound the first message that is not as expected, in words.
  virtual std::vector<std::string> take_breaches() = 0;
  /// The topics with bounds of which no message has come.
  virtual std::vector<std::string> unheard_topics() const = 0;
  /// Likewise, all messages of a robot's topics that are shown.
  virtual std::vector<ShownReading> take_shown(std::size_t robot) = 0;
};

/// What the library offers.
struct Library {
  static constexpr const char* file = "libwaitpoint-nodes.so";
  static constexpr const char* symbol = "waitpoint_nodes";

  /// Starts the master. Throws std::runtime_error.
  std::unique_ptr<NodeSide> (*make)(const NodeSideSetup& setup);
  /// Reads the bag from its beginning to its end. Throws std::runtime_error for what cannot be played: a line.
  void (*check_bag)(const BagChoice& choice);
  /// Starts the master, and advertises the topics. Throws std::runtime_error.
  std::unique_ptr<BagSide> (*make_bag_side)(const BagSideSetup& setup);
};

}  // namespace waitpoint::nodes
