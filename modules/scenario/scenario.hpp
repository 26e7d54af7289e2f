// SPDX-License-Identifier: BSD-3-Clause
// A scenario as values: world, robots, expectations, and the place of each in the input.
//
// It contains all that the files say except the obstacles of a map file, which the assembly adds. Module parameters
// remain text (core/setting.hpp): only the module knows their types.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/hosting/program_host.hpp"
#include "core/pose.hpp"
#include "core/setting.hpp"
#include "core/time.hpp"
#include "fibers/io/medium.hpp"
#include "modules/logs/given_laser.hpp"
#include "modules/logs/sensor_log.hpp"
#include "modules/scenario/location.hpp"
#include "modules/scenario/yaml_tree.hpp"
#include "world/description.hpp"
#include "world/formats/world_file.hpp"

namespace waitpoint::ros1 {
struct Launch;
}

namespace waitpoint::scenario {

/// A number in each message of a topic of ROS is to be within a bound.
struct TopicExpectation {
  enum class Relation : unsigned char { at_least, at_most, equal };

  std::string topic, field;
  Relation relation = Relation::equal;
  double limit = 0;
  std::string text;  ///< as written
};

/// Parses "TOPIC[.FIELD]>=NUMBER", with ">=", "<=" or "=="; the field is `data` by default. False if it is no such
/// text.
bool parse(const std::string& text, TopicExpectation& expectation);
/// What is said of such a text.
std::string topic_expectation_words(const std::string& text);

/// Expected results of a run; omitted ones are not checked.
struct Expectation {
  bool all_goals_reached = false;
  std::optional<std::uint64_t> goals_reached;  ///< exact number, over all robots
  std::optional<std::uint64_t> collisions;     ///< exact number, over all robots
  std::optional<double> position_error_max_m;  ///< upper bound for every robot's fused position
  bool plans_completed = false;                ///< every robot's temporal plan

  // Of nodes of ROS.
  std::optional<std::uint64_t> node_failures;  ///< the most that may end by a signal, or with another status than 0
  std::optional<double> service_call_max_s;    ///< upper bound for a call of a service
  std::vector<TopicExpectation> topics;
  bool tests_passed = false;  ///< all tests of the launch files, which take part in the run
};

/// The keys of `expect`.
std::span<const std::string_view> expectation_keys();

/// A file in another format with a world's obstacles: world/formats/world_file.hpp lists the formats.
struct MapFile {
  static constexpr double height_default_m = 2;

  std::filesystem::path file;           ///< resolved
  bool known = true;                    ///< false: the robots plan without it
  std::optional<double> height_m = {};  ///< height of obstacles without one in the file; none: height_default_m
  Location written;
  /// Null until read().
  std::shared_ptr<const world::WorldFile> contents = nullptr;
  std::size_t robots_taken = 0;  ///< number of the file's robots that became the scenario's

  /// Reads the file unless it has been read. BadInput as from world::read_world_file().
  void read();
};

/// A log of sensors that drives the modules of one robot, in place of a world.
struct LogFile {
  std::filesystem::path file;  ///< resolved
  logs::LogChoice choice;
  logs::GivenLaser laser;
  Location written;
};

struct Goal {
  Point position;
  std::string name;  ///< may be empty
  Location written;
};

struct ModuleScenario {
  std::string name;
  std::string type;  ///< name under which the module class is registered
  bool enabled = true;
  std::vector<Setting> settings;
  Location written;
};

/// A program of the robot, instead of or beside modules.
struct ProgramScenario {
  std::string name;
  std::vector<std::string> words;  ///< its file, resolved, and its arguments
  bool is_shared_object = false;   ///< the file is one, with a main()
  Hosting hosting = Hosting::processes;
  std::vector<StartCondition> after;  ///< its start waits for all; names are of the robot's programs
  Location written;
};

/// One row of the bridge's table: a poster and the device value that it is connected to.
struct BridgeRow {
  std::string poster;  ///< module.poster: "rflex.command"
  std::string device;  ///< device.value: "base.command"; lasers by their names
  Duration latency;    ///< of the module's accesses to the poster
  Location written;
};

/// Execution control: rules between the clients of the modules and the modules (modules/control).
struct ControlScenario {
  std::string file;               ///< resolved
  std::string rules;              ///< its contents
  std::vector<Setting> settings;  ///< clock and processor of the controller's task
};

/// A script of Tcl in place of the executive, or, with a plan, below it.
struct ScriptScenario {
  std::string file;  ///< resolved
  std::string text;
  std::vector<std::string> folders;  ///< that it may read and write: the scenario's, then others
  Location written;
};

/// The file of a trajectory, which the robot follows in place of goals.
struct TrajectoryScenario {
  std::string file;  ///< resolved
  std::string text;
  Location written;
};

/// The nodes of ROS that are a robot's software, and the names of what it publishes to them.
struct NodesScenario {
  std::string ns = "/";           ///< global, without a '/' at its end: of the robot's topics and nodes
  bool gives_map_to_odom = true;  ///< the true one is published; false: a node estimates it
  std::string tf_prefix;          ///< in front of the names of its frames, with a '/' between; may be empty
  std::shared_ptr<const ros1::Launch> launch;  ///< modules/ros1/launch.hpp: of the launch file, then of `nodes`
  std::shared_ptr<const YamlNode> document;    ///< the keys, as written
  Location written;
};

/// What the nodes of all robots have in common.
struct RosScenario {
  enum class Master : unsigned char { inside, outside };

  bool publishes_clock = false;    ///< the topic /clock
  Master master = Master::inside;  ///< outside: the one of ROS_MASTER_URI
  Duration delay;                  ///< of what is sent over a connection within a robot
  Location written;
};

/// A bag of ROS, in the place of a world: its topics are for nodes.
struct PlayScenario {
  std::filesystem::path bag;                     ///< resolved
  std::vector<std::string> topics;               ///< global names; empty: all
  Duration start;                                ///< of the bag's time, from its first message
  std::optional<Duration> duration;              ///< of the bag's time, from `start`; none: up to its end
  double rate = 1;                               ///< of the bag's time by virtual time
  Duration delay = std::chrono::seconds(1);      ///< from when the nodes are there to the first message
  Duration idle = std::chrono::seconds(1);       ///< without a message of a node, after the last one: the run's end
  Duration end_most = std::chrono::seconds(10);  ///< after the last message: the run's end in any case
  double clock_hz = 100;                         ///< of /clock, if it is published
  bool hears = false;                            ///< the run subscribes to what nodes publish
  std::vector<std::string> outputs;              ///< files of the nodes, relative to the current directory
  Location written, bag_written, topics_written;
};

struct RobotScenario {
  std::string name;
  world::BodyDescription body;           ///< including the robot's name
  std::vector<std::string> laser_names;  ///< in the order of body.sensors<world::Lasers>()
  std::vector<std::string> warnings;     ///< from its input files
  std::vector<Goal> goals;               ///< in the order of the round
  std::vector<ModuleScenario> modules;   ///< in starting order, including disabled ones
  std::vector<BridgeRow> bridge;
  std::vector<ProgramScenario> programs;  ///< enabled ones
  std::vector<std::string> processors;    ///< that tasks of its modules can share
  std::vector<Setting> executive;
  std::optional<ControlScenario> control;
  std::shared_ptr<const YamlNode> plan;  ///< the document of its temporal plan, in the place of goals; null: none
  std::optional<ScriptScenario> script;
  std::optional<TrajectoryScenario> trajectory;
  std::optional<NodesScenario> nodes;
  Location written, start_written;

  /// The name of the device values NAME.reading, NAME.command of its sensor number `number` of type S.
  template <class S>
  std::string device_name(std::size_t number) const {
    if constexpr (requires { S::named; })
      return laser_names[number];
    else if constexpr (world::HasSeveral<S>)
      return std::string(S::device) + (number == 0 ? "" : "_" + std::to_string(number));
    else
      return std::string(S::key);
  }
  /// True if its goals are not the executive's: with nodes, and no enabled module.
  bool goals_are_for_nodes() const;
};

struct Scenario {
  std::string file, name, description;
  std::uint64_t fingerprint = 0;  ///< of all files and options, without their places
  Expectation expect;
  Duration until = std::chrono::hours(1);  ///< with a log: no limit, unless given
  Duration step = std::chrono::milliseconds(10);
  world::Engine engine = world::Engine::fcl;
  Location engine_written;  ///< valid if given
  std::optional<MapFile> map;
  std::optional<LogFile> log;  ///< then the world is empty, and there is one robot
  RosScenario ros;
  std::optional<PlayScenario> play;         ///< then nothing is done by the robots but by their nodes
  std::optional<NodesScenario> nodes;       ///< of no robot, beside `play`
  std::optional<io::Medium> medium;         ///< between robots; none: no communication between robots
  std::vector<world::Obstacle> shapes;      ///< without those of the map
  std::vector<Location> shapes_written;     ///< of each shape
  std::vector<world::MeshObstacle> meshes;  ///< of the shapes that are meshes
  std::vector<Location> meshes_written;
  std::vector<RobotScenario> robots;  ///< in the order of the file, then those of the map; unique names
  std::vector<std::string> warnings;  ///< from the map's robots and the files of shapes

  /// True if there are nodes, of robots or beside a bag.
  bool has_nodes() const;
  /// Those beside a bag, then those of the robots.
  std::vector<const NodesScenario*> all_nodes() const;
  /// The world without the map's obstacles; bodies in the order of the robots.
  world::WorldDescription world_without_map() const;
};

}  // namespace waitpoint::scenario
