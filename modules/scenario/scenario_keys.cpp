// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/scenario_keys.hpp"

#include "core/hosting/program_host.hpp"
#include "modules/scenario/expectation_reader.hpp"
#include "modules/scenario/log_reader.hpp"
#include "modules/scenario/medium_reader.hpp"
#include "modules/scenario/nodes_keys.hpp"
#include "modules/scenario/play_reader.hpp"
#include "modules/scenario/robot_keys.hpp"
#include "modules/scenario/shape_reader.hpp"
#include "modules/scenario/surface_reader.hpp"

namespace waitpoint::scenario {
namespace {

using namespace std::chrono_literals;

constexpr std::string_view engines[] = {"fcl", "slice", "bullet"};

/// Complete where nothing is included; otherwise laid over what is.
SchemaMaker unless_included(SchemaMaker whole) {
  return [whole](SchemaDefinitions& definitions) {
    if (definitions.is_partial()) return whole(definitions);
    return Json{{"if", needed({"include"})}, {"then", definitions.part(whole)}, {"else", whole(definitions)}};
  };
}

Form<Duration> step_form() {
  Form<Duration> form = duration_form(1ms);
  form.read = [read = form.read](const YamlNode& node, std::string_view what, Duration& step) {
    read(node, what, step);
    if (step > Duration(1s)) throw node.written.bad("expected step_ms to be at most 1000, found " + described(node));
  };
  form.schema = [schema = form.schema](SchemaDefinitions& definitions) {
    Json number = schema(definitions);
    number["maximum"] = 1000;
    return number;
  };
  return form;
}

Json format_schema(SchemaDefinitions&) { return {{"const", scenario_format}}; }

Json title_schema(SchemaDefinitions&) {
  Json schema = text_schema();
  schema["maxLength"] = 200;
  return schema;
}

Json shapes_schema(SchemaDefinitions& definitions) {
  const Json mesh = mesh_keys().schema(definitions), octomap = octomap_keys().schema(definitions),
             obstacle = obstacle_keys().schema(definitions);
  if (definitions.is_partial()) return list_schema(any_of({mesh, octomap, obstacle}));
  return list_schema({{"if", needed({"mesh"})},
                      {"then", mesh},
                      {"else", {{"if", needed({"octomap"})}, {"then", octomap}, {"else", obstacle}}}});
}

Json types_schema(SchemaDefinitions& definitions) {
  return {{"type", "object"},
          {"properties", {{"include", described("a file of robot types", text_schema())}}},
          {"additionalProperties", robot_type_keys().schema(definitions)}};
}

/// The keys that head each kind of file; a file that is included only has its name and description for people.
KeyTable headed(std::string name, const SchemaMaker& title, const SchemaMaker& description) {
  return KeyTable(std::move(name))
      .add("format", format_schema, "the version of the format", Need::required)
      .add("name", title, "for people; that of a scenario heads summary and picture")
      .add("description", description, "for people");
}

KeyTable headed_as_included(std::string name) {
  const SchemaMaker any = [](SchemaDefinitions&) { return Json::object(); };
  return headed(std::move(name), any, any);
}

/// Beside a log there is one robot, without a body, and no world.
Json keys_beside_log(const KeyTable& keys) {
  Json properties = Json::object();
  for (const std::string_view key : keys.names()) properties[std::string(key)] = {{"type", "null"}};
  for (const char* good : {"format", "name", "description", "until_s", "log", "robot_types", "robots"})
    properties.erase(good);
  return {{"if", needed({"log"})}, {"then", {{"properties", properties}, {"required", {"robots"}}}}};
}

/// A log's robot has no body.
Json robots_schema(SchemaDefinitions& definitions) {
  return list_schema(any_of({robot_schema(definitions), robot_of_log_schema(definitions)}), 1);
}

/// The two kinds of robots told apart, for those who see the whole scenario.
Json bodies_of_robots(SchemaDefinitions& definitions) {
  const auto robots = [](Json robot) { return Json{{"properties", {{"robots", {{"items", std::move(robot)}}}}}}; };
  return {{"if", needed({"log"})},
          {"then", robots(robot_of_log_schema(definitions))},
          {"else", robots(robot_schema(definitions))}};
}

/// Types have a shape, but where a map may give it or an included type.
Json shapes_of_types() {
  const Json shape = {{"anyOf", {needed({"shape"}), needed({"urdf"})}}};
  const Json types = {{"if", needed({"include"})},
                      {"else", {{"properties", {{"include", Json::object()}}}, {"additionalProperties", shape}}}};
  return {{"if", {{"not", needed({"robots_from_map"})}}}, {"then", {{"properties", {{"robot_types", types}}}}}};
}

}  // namespace

const Keys<Scenario>& world_keys() {
  static const Keys<Scenario> keys =
      Keys<Scenario>("world")
          .add("step_ms", &Scenario::step, step_form(),
               "period of the world's step, at most 1000; a warning if above the least period of the robots' software")
          .add("engine", &Scenario::engine, word_form<world::Engine>(engines),
               "the engine for beams and for obstacles near a robot: `fcl`, or `slice`, which is faster; both give the "
               "same bits, so the same digest. Or `bullet`: another world server, with masses and forces")
          .add("include", text_form().schema,
               "a floor: a file with `format`, `shapes`, `shape_height_m`, `map`, on which this world is built")
          .add("map", text_or(map_keys().table()),
               "`FILE`, or `{file, height_m, known}`: a map of ROS's `map_server`, a segment map, an SDF world, a "
               "world of Stage")
          .add("shape_height_m", number_form(ranges::length).schema, "height of shapes that have none of their own")
          .add("shapes", shapes_schema, "the list of shapes; one with the name of a floor's shape changes that one");
  return keys;
}

const Keys<MapFile>& map_keys() {
  static const Keys<MapFile> keys =
      Keys<MapFile>("map")
          .add("file", text_form().schema,
               "a map of ROS's `map_server`, a segment map, an SDF world or a world of Stage", Need::required)
          .add("height_m", &MapFile::height_m, optional_form(number_form(ranges::length)),
               "height of obstacles without one of their own")
          .add("known", &MapFile::known, truth_form(), "`false`: the robots know its extent only");
  return keys;
}

const KeyTable& floor_keys() {
  static const KeyTable keys = headed_as_included("floor")
                                   .add("map", text_or(map_keys().table()), "as of a world")
                                   .add("shape_height_m", number_form(ranges::length).schema, "as of a world")
                                   .add("shapes", shapes_schema, "as of a world");
  return keys;
}

const KeyTable& robot_types_keys() {
  static const KeyTable keys = headed_as_included("file of robot types")
                                   .add("robot_types", types_schema, "robots' equipment by name", Need::required);
  return keys;
}

const KeyTable& scenario_keys() {
  static const KeyTable keys = [] {
    KeyTable table =
        headed("scenario", title_schema, text_form().schema)
            .add("expect", map_of(expectation_table().table()),
                 "expected results over all robots, otherwise exit status 1: `goals_reached: all` or a number, "
                 "`collisions`, `position_error_max_m`, `plans: completed`; of nodes of ROS `node_failures`, "
                 "`service_call_max_s`, `topics`, `tests: passed`")
            .add("until_s", duration_form(1s).schema, "time limit, in virtual time")
            .add("world", unless_included(map_of(world_keys().table())), "the obstacles, and how the world is stepped")
            .add("hosting", word_form<Hosting>(hosting_words).schema,
                 "how robots' programs are hosted: `processes`, or `in-process`")
            .add("medium", map_of(medium_keys().table()), "model of communication between robots")
            .add("robot_types", unless_included(types_schema),
                 "robots' equipment by name; `include: FILE` reads a file of types")
            .add("robots", robots_schema, "the list of robots")
            .add("robots_from_map", robots_from_map_schema, "software for the robots in the map's file")
            .add("control", control_schema, "rules of execution control for all robots without their own")
            .add("log", text_or(log_keys().table()), "in place of `world`: a log of a real robot")
            .add("ros", map_of(ros_keys().table()), "what the nodes of ROS of all robots have in common")
            .add("play", map_of(play_keys().table()), "a bag of ROS in the place of a world, for nodes")
            .add("launch", launch_schema, "beside `play`: a launch file of ROS")
            .add("nodes", nodes_schema, "beside `play`: nodes of ROS");
    table.require_also(keys_beside_log(table));
    table.require_also(bodies_of_robots);
    table.require_also(shapes_of_types());
    table.require_also({{"if", {{"not", {{"anyOf", {needed({"robots_from_map"}), needed({"play"})}}}}}},
                        {"then", needed({"robots"})}});
    return table;
  }();
  return keys;
}

}  // namespace waitpoint::scenario
