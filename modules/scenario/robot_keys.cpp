// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/robot_keys.hpp"

#include "modules/scenario/body_reader.hpp"
#include "modules/scenario/nodes_keys.hpp"
#include "modules/scenario/sensor_reader.hpp"
#include "modules/scenario/shape_reader.hpp"

namespace waitpoint::scenario {
namespace {

constexpr NumberRange latency{0, 3.6e9, "a number from 0 to 3600000000"};

Json name_schema(SchemaDefinitions&) {
  Json schema = text_schema();
  schema["pattern"] = "^[A-Za-z0-9_-]{1,40}$";
  schema["not"] = {{"enum", {"environment", "base"}}};
  return schema;
}

Json dotted_schema(SchemaDefinitions&) { return {{"type", "string"}, {"pattern", "^[^.]+[.]."}}; }

/// A definition that is given from outside, `name` in parts, and `complete`.
SchemaMaker outer(std::string name, std::string complete) {
  return [name, complete](SchemaDefinitions& definitions) {
    return Json{{"$ref", "#/$defs/" + (definitions.is_partial() ? name : complete)}};
  };
}

Json names_schema(SchemaDefinitions& definitions) {
  Json schema = list_schema(name_schema(definitions));
  schema["uniqueItems"] = true;
  return schema;
}

/// Of a value that replaces another one as a whole.
SchemaMaker whole(SchemaMaker make) {
  return [make](SchemaDefinitions& definitions) { return definitions.whole(make); };
}

Json goals_schema(SchemaDefinitions& definitions) {
  return list_schema(any_of({numbers_schema(ranges::coordinate, 2, 2), definitions.whole(map_of(goal_keys()))}));
}

Json urdf_schema(SchemaDefinitions&) {
  const Json value = {{"type", {"string", "number", "boolean", "null"}}};
  return any_of(
      {text_schema(),
       {{"type", "object"},
        {"properties",
         {{"file", described("the URDF, or a file of xacro", text_schema())},
          {"arguments", described("values of xacro's arguments by their names", or_null(map_schema(value)))}}},
        {"required", {"file"}},
        {"additionalProperties", false}}});
}

Json modules_schema(SchemaDefinitions& definitions) {
  return list_schema(outer("module", "complete_module")(definitions));
}

/// What a robot consists of, without its body.
KeyTable software(std::string name) {
  return KeyTable(std::move(name))
      .add("modules", modules_schema,
           "a list, in starting order: `name`, `type` (default: the name), `enabled`, and the module's own parameters, "
           "which the module checks")
      .add("bridge", whole(list_of(bridge_row_keys())),
           "the table: rows `{poster: MODULE.POSTER, device: DEVICE.VALUE}`; devices are `base`, the lasers by name, "
           "rings as `sonar`, `sonar_1` and so on, "
           "and the other sensors by their keys; values are `command` and `reading` (of sensors but lasers only "
           "`reading`)")
      .add("executive", outer("executive", "executive"),
           "parameters of the executive; `clock`, `processor`, `priority` as of a module's task; `tcl`, a script in "
           "Tcl in place of the executive, or below a `plan`")
      .add("processors", names_schema,
           "a list of names: processors that tasks of the modules can share; without it, each task has one of its own")
      .add("programs", list_of(program_keys()),
           "a list: `name`, `command` (a program and its arguments: processes), or `file` (a shared object with a "
           "`main()`, from unmodified sources) and `arguments`, `after` (what its start waits for), `enabled`")
      .add("control", control_schema,
           "a file of rules between the clients of the modules and the modules, or `{rules: FILE}` with `clock`, "
           "`processor`, `priority` of the controller's task")
      .add("ros", map_of(robot_ros_keys()), "names and topics of the robot's nodes of ROS")
      .add("launch", launch_schema,
           "a launch file, or `{file, args}` with values of its arguments; the file may begin with `$(find PACKAGE)`, "
           "`$(env NAME)` or `$(optenv NAME DEFAULT)`")
      .add("nodes", nodes_schema, "nodes of ROS, after those of the launch file");
}

Json battery_twice() {
  const Json of_base = {{"anyOf",
                         {needed({"battery_volts_full"}), needed({"battery_volts_empty"}),
                          needed({"battery_capacity_s"}), needed({"battery_capacity_m"})}}};
  return {{"not", {{"required", {"battery", "base"}}, {"properties", {{"base", of_base}}}}}};
}

/// The keys of a type.
KeyTable equipment(std::string name) {
  return KeyTable(std::move(name))
      .add("shape", map_of(body_shape_keys()),
           "`{radius_m, height_m}` or `{size_m: [length, width], height_m}`, about the robot's centre")
      .add("urdf", urdf_schema,
           "instead of `shape`: a URDF (or `{file, arguments}`, with values for arguments of xacro), for the shape and "
           "for the places of lasers, whose `frame` names a link")
      .add(device_keys())
      .add(software(""))
      .require(battery_twice())
      .require({{"not", needed({"shape", "urdf"})}});
}

/// A robot whose modules a log drives.
const KeyTable& logged_robot_keys() {
  static const KeyTable keys = KeyTable("robot of a log")
                                   .add("name", name_schema, "its name", Need::required)
                                   .add("type", text_form().schema, "one of `robot_types`")
                                   .add("modules", modules_schema, "as of a robot")
                                   .add("bridge", whole(list_of(bridge_row_keys())), "as of a robot")
                                   .add("processors", names_schema, "as of a robot");
  return keys;
}

Json no_goals() { return {{"properties", {{"goals", {{"maxItems", 0}}}}}}; }

}  // namespace

const KeyTable& goal_keys() {
  static const KeyTable keys = KeyTable("goal")
                                   .add("x_m", number_form(ranges::coordinate).schema, "on the map", Need::required)
                                   .add("y_m", number_form(ranges::coordinate).schema, "on the map", Need::required)
                                   .add("name", text_form().schema, "its name in messages");
  return keys;
}

const KeyTable& bridge_row_keys() {
  static const KeyTable keys =
      KeyTable("row of the bridge")
          .add("poster", dotted_schema, "`MODULE.POSTER`", Need::required)
          .add("device", dotted_schema,
               "`DEVICE.VALUE`: `base`, a laser by its name, `bumpers`, ...; `command` or `reading`", Need::required)
          .add("latency_us", duration_form(std::chrono::microseconds(1), latency).schema,
               "duration of the module's accesses to that poster");
  return keys;
}

const KeyTable& program_keys() {
  static const KeyTable keys =
      KeyTable("program")
          .add("name", name_schema, "its name", Need::required)
          .add("file", text_form().schema,
               "a shared object with a `main()`: in-process, unless `hosting` says otherwise")
          .add("arguments", texts(), "of the shared object")
          .add("command", texts(1), "a program and its arguments: processes, unless `hosting` says otherwise")
          .add("after", texts(), "what its start waits for: `NAME`, `NAME.started`, `tcp:PORT`, a path with a `/`")
          .add("enabled", truth_form().schema, "`false`: it is left out")
          .require({{"oneOf", {needed({"file"}), needed({"command"})}}})
          .require({{"not", needed({"command", "arguments"})}});
  return keys;
}

const KeyTable& robot_type_keys() {
  static const KeyTable keys = equipment("robot type");
  return keys;
}

const KeyTable& robot_of_map_keys() {
  static const KeyTable keys = KeyTable("row of robots from the map")
                                   .add("model", text_form().schema, "of these robots of the map alone")
                                   .add("type", text_form().schema, "one of `robot_types`")
                                   .add("goals", goals_schema, "as of a robot")
                                   .add(equipment(""));
  return keys;
}

const KeyTable& robot_keys() {
  static const KeyTable keys =
      KeyTable("robot")
          .add("name", name_schema, "of letters, digits, `_` and `-`", Need::required)
          .add("type", text_form().schema, "one of `robot_types`, whose keys the robot's own override")
          .add("start", whole(pose_form().schema), "`[x, y, heading_deg]`", Need::required)
          .add("goals", goals_schema, "a list of `[x, y]` or `{x_m, y_m, name}`")
          .add("start_height_m", number_form(ranges::height).schema, "of an aerial robot above the floor")
          .add("plan", text_form().schema, "in place of goals: the file of a temporal plan")
          .add("trajectory", text_form().schema, "in place of goals and plan: the file of a trajectory")
          .add(equipment(""))
          .require({{"anyOf", {needed({"shape"}), needed({"urdf"})}}})
          .require({{"if", needed({"start_height_m"})},
                    {"then",
                     {{"required", {"base"}},
                      {"properties",
                       {{"base",
                         {{"type", "object"},
                          {"required", {"kind"}},
                          {"properties", {{"kind", {{"const", "aerial"}}}}}}}}}}}})
          .require({{"if", {{"anyOf", {needed({"plan"}), needed({"trajectory"})}}}}, {"then", no_goals()}})
          .require({{"not", needed({"plan", "trajectory"})}});
  return keys;
}

Json robot_schema(SchemaDefinitions& definitions) {
  const Json alone = robot_keys().schema(definitions);
  // What a robot of a type must have is a name and a start: the rest may be the type's.
  const Json of_type = {{"allOf", {definitions.part(map_of(robot_keys())), needed({"name", "start"})}}};
  return {{"if", needed({"type"})}, {"then", of_type}, {"else", alone}};
}

Json robot_of_log_schema(SchemaDefinitions& definitions) { return logged_robot_keys().schema(definitions); }

Json robots_from_map_schema(SchemaDefinitions& definitions) {
  Json row = definitions.part(map_of(robot_of_map_keys()));
  return any_of({text_schema(), list_schema(std::move(row), 1)});
}

Json control_schema(SchemaDefinitions& definitions) {
  return any_of({text_schema(), outer("control", "complete_control")(definitions)});
}

}  // namespace waitpoint::scenario
