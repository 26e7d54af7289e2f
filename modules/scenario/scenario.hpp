// SPDX-License-Identifier: BSD-3-Clause
// A scenario as values: what is to be run, what is expected of it, and where each part was written.
//
// What the files say is all here, except what a map file holds beside robots: the assembly adds its obstacles. Module
// parameters stay text (core/setting.hpp): only the module knows their types.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/pose.hpp"
#include "core/setting.hpp"
#include "core/time.hpp"
#include "fibers/io/medium.hpp"
#include "modules/scenario/location.hpp"
#include "world/description.hpp"
#include "world/formats/world_file.hpp"

namespace waitpoint::scenario {

/// What the author says a run comes to; what is left out is not expected.
struct Expectation {
  bool all_goals_reached = false;
  std::optional<std::uint64_t> goals_reached;  ///< exactly so many, over all robots
  std::optional<std::uint64_t> collisions;     ///< exactly so many, over all robots
  std::optional<double> position_error_max_m;  ///< of any robot's fused position, at most
};

/// The keys of `expect`, one for each of its figures.
inline std::initializer_list<std::string_view> expectation_keys() {
  static const std::initializer_list<std::string_view> keys = {"goals_reached", "collisions", "position_error_max_m"};
  return keys;
}

/// A file of another's making that says what stands in the world: world/formats/world_file.hpp lists the kinds.
struct MapFile {
  static constexpr double height_default_m = 2;

  std::filesystem::path file;           ///< resolved
  std::optional<double> height_m = {};  ///< of what the file gives no height; where it is left out, the default
  Location written;
  /// The file's, once it has been read: by then where its robots are the scenario's.
  std::shared_ptr<const world::WorldFile> contents = nullptr;
  std::size_t robots_taken = 0;  ///< of the file's robots, as the scenario's

  /// Reads the file if it has not been read. BadInput as of world::read_world_file().
  void read();
};

struct Goal {
  Point position;
  std::string name;  ///< may be empty
  Location written;
};

struct ModuleScenario {
  std::string name;
  std::string type;  ///< by which the module was registered
  bool enabled = true;
  std::vector<Setting> settings;
  Location written;
};

/// A program whose threads are tasks of the robot, in place of a module made for this frame or beside those.
struct ProgramScenario {
  std::string name;
  std::filesystem::path file;  ///< a shared object with a main(): resolved
  std::vector<std::string> arguments;
  Location written;
};

/// One row of the bridge's table: the poster and the world's value that are one.
struct BridgeRow {
  std::string poster;  ///< "rflex.command": module.poster
  std::string device;  ///< "base.command": device.value; a laser is named by its name
  Duration latency;    ///< of the module's accesses to the poster
  Location written;
};

struct RobotScenario {
  std::string name;
  world::BodyDescription body;           ///< with the robot's name
  std::vector<std::string> laser_names;  ///< in the order of body.lasers
  std::vector<std::string> warnings;     ///< of what it is read from
  std::vector<Goal> goals;               ///< in the order of the round
  std::vector<ModuleScenario> modules;   ///< in the order in which they start, those switched off included
  std::vector<BridgeRow> bridge;
  std::vector<ProgramScenario> programs;  ///< those switched on
  std::vector<std::string> processors;    ///< that its modules' tasks can share
  std::vector<Setting> executive;
  Location written, start_written;
};

struct Scenario {
  std::string file, name, description;
  std::uint64_t fingerprint = 0;  ///< of all that the files and options say, wherever they say it
  Expectation expect;
  Duration until = std::chrono::hours(1);
  Duration step = std::chrono::milliseconds(10);
  world::Engine engine = world::Engine::fcl;
  Location engine_written;  ///< where it is not left out
  std::optional<MapFile> map;
  std::optional<io::Medium> medium;         ///< between robots; none: they cannot send to each other
  std::vector<world::Obstacle> shapes;      ///< without the map's
  std::vector<Location> shapes_written;     ///< of each shape
  std::vector<world::MeshObstacle> meshes;  ///< of the shapes that are meshes
  std::vector<Location> meshes_written;
  std::vector<RobotScenario> robots;  ///< in the order of the file, those of the map last; their names differ
  std::vector<std::string> warnings;  ///< of the map's robots, and of the shapes' files

  /// The world without the map's obstacles; bodies in the order of the robots.
  world::WorldDescription world_without_map() const;
};

}  // namespace waitpoint::scenario
