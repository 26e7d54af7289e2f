// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/map_robots.hpp"

#include <algorithm>

#include "core/nearest_name.hpp"
#include "modules/posters/laser.hpp"
#include "modules/scenario/robot_reader.hpp"
#include "world/formats/distinct_names.hpp"
#include "world/formats/left_out.hpp"

namespace waitpoint::scenario {
namespace {

struct Row {
  YamlNode node;
  std::string model;  // empty: any
  bool used = false;
};

std::vector<Row> read_rows(const YamlNode& node) {
  if (node.kind == YamlNode::Kind::scalar) {
    YamlNode row;
    row.kind = YamlNode::Kind::map;
    row.written = node.written;
    row.entries.push_back({"type", node.written, node});
    return {{row, "", false}};
  }
  std::vector<Row> rows;
  for (const YamlNode& item : read_list(node, "robots_from_map")) {
    const YamlNode* model = item.find("model");
    rows.push_back({item, model == nullptr ? "" : read_text(*model, "model"), false});
  }
  if (rows.empty()) throw node.written.bad("expected robots_from_map to have a row");
  return rows;
}

Row* row_for(std::vector<Row>& rows, const std::string& name, const world::RobotOrigin& origin) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const Row& row) {
    return row.model.empty() || row.model == name ||
           std::find(origin.types.begin(), origin.types.end(), row.model) != origin.types.end();
  });
  return found == rows.end() ? nullptr : &*found;
}

void check_used(const std::vector<Row>& rows, const MapFile& map) {
  for (const Row& row : rows) {
    if (row.used) continue;
    if (row.model.empty())
      throw row.node.written.bad("the row matches no robot: earlier rows match all robots of the map");
    std::vector<std::string_view> known;
    for (const world::BodyDescription& body : map.contents->bodies) known.push_back(body.name);
    for (const world::RobotOrigin& origin : map.contents->origins)
      known.insert(known.end(), origin.types.begin(), origin.types.end());
    if (std::find(known.begin(), known.end(), row.model) != known.end())
      throw row.node.written.bad("the row matches no robot: earlier rows match all robots '" + row.model +
                                 "' of the map");
    throw row.node.written.bad("there is no robot '" + row.model + "', and none of that type, in '" +
                               map.file.string() + "'" + did_you_mean(row.model, known));
  }
}

/// Limits lasers to the number of beams that the posters hold.
BodyReading as_devices(world::BodyDescription body, const world::RobotOrigin& origin, world::LeftOut& left_out) {
  for (world::LaserDescription& laser : body.sensors<world::Lasers>()) {
    if (laser.beams <= world::Lasers::count_max) continue;
    const std::string most = std::to_string(world::Lasers::count_max);
    left_out.add(origin.file, origin.line, "a laser of more than " + most + " beams", "is taken with " + most);
    laser.beams = world::Lasers::count_max;
  }
  return {std::move(body), origin.laser_names, {}};
}

/// The first `own_robots` robots are the scenario's own.
void check_names(const Scenario& scenario, std::size_t own_robots) {
  const auto behind_own = scenario.robots.begin() + static_cast<std::ptrdiff_t>(own_robots);
  for (auto own = scenario.robots.begin(); own != behind_own; ++own) {
    const auto same =
        std::find_if(behind_own, scenario.robots.end(), [&](auto& robot) { return robot.name == own->name; });
    if (same != scenario.robots.end())
      throw own->written.bad("the map has a robot '" + own->name + "' too, at " + same->start_written.text());
  }
}

}  // namespace

void read_robots_from_map(const YamlNode& node, const YamlNode* types, Scenario& scenario) {
  if (!scenario.map) throw node.written.bad("expected a world.map for robots_from_map");
  MapFile& map = *scenario.map;
  map.read();
  const world::WorldFile& file = *map.contents;
  if (file.bodies.empty()) throw node.written.bad("expected robots in '" + map.file.string() + "', which has none");
  std::vector<Row> rows = read_rows(node);
  const std::size_t own_robots = scenario.robots.size();
  world::DistinctNames names;
  world::LeftOut left_out;
  for (std::size_t i = 0; i < file.bodies.size(); ++i) {
    const world::RobotOrigin& origin = file.origins[i];
    Row* row = row_for(rows, file.bodies[i].name, origin);
    if (row == nullptr) continue;
    row->used = true;
    const std::string name = names.take(fitting_name(file.bodies[i].name));
    RobotScenario robot = read_robot_of_map(row->node, types, name, as_devices(file.bodies[i], origin, left_out));
    robot.start_written = {origin.file, origin.line};
    scenario.robots.push_back(std::move(robot));
  }
  check_used(rows, map);
  check_names(scenario, own_robots);
  map.robots_taken = scenario.robots.size() - own_robots;
  scenario.warnings = left_out.warnings();
}

}  // namespace waitpoint::scenario
