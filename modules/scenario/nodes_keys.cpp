// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/nodes_keys.hpp"

namespace waitpoint::scenario {
namespace {

constexpr std::string_view masters[] = {"inside", "outside"};

Json matching(const char* pattern) { return {{"type", {"string", "boolean"}}, {"pattern", pattern}}; }

/// Names in front of others, which may be empty.
Json prefix_schema(SchemaDefinitions&) { return any_of({{{"const", ""}}, ros_name_schema()}); }
Json base_name_schema(SchemaDefinitions&) { return matching("^[A-Za-z][A-Za-z0-9_]*$"); }
Json namespace_schema(SchemaDefinitions&) { return ros_name_schema(); }
Json name_map_schema(SchemaDefinitions&) { return map_schema(or_null(ros_name_schema())); }
Json text_map_schema(SchemaDefinitions&) { return map_schema(or_null(text_schema())); }
Json any_map_schema(SchemaDefinitions&) { return {{"type", "object"}}; }

}  // namespace

Json ros_name_schema() { return matching("^(/|(/|~/?)?[A-Za-z][A-Za-z0-9_]*(/[A-Za-z0-9_]+)*)$"); }

const Keys<RosScenario>& ros_keys() {
  static const Keys<RosScenario> keys =
      Keys<RosScenario>("ros")
          .add("clock", &RosScenario::publishes_clock, truth_form(), "the topic `/clock` is published")
          .add("master", &RosScenario::master, word_form<RosScenario::Master>(masters),
               "`inside`: the run has one of its own; `outside`: Debian's `rosmaster`, which is started as a process "
               "of the run, in its virtual time")
          .add("delay_us", &RosScenario::delay, duration_form(std::chrono::microseconds(1)),
               "of what is sent over a connection within a robot, and between it and the world, in virtual "
               "microseconds");
  return keys;
}

const KeyTable& robot_ros_keys() {
  static const KeyTable keys =
      KeyTable("ros of a robot")
          .add("namespace", prefix_schema, "the namespace of its topics and nodes; no two robots have one")
          .add("tf_prefix", prefix_schema, "in front of the names of its frames")
          .add(
              "map_to_odom", [](SchemaDefinitions&) { return word_schema(map_to_odom_words); },
              "`truth`: the true transform from `map` to `odom` is published; `nodes`: a node estimates it")
          .add("publish", name_map_schema, "a map of posters and topics: what modules write is published")
          .add(
              "show", [](SchemaDefinitions&) { return map_schema(or_null(word_schema(shown_kinds))); },
              "a map of topics to `path`, `cloud` or `grid`: what pictures and recordings have of what nodes publish");
  return keys;
}

const KeyTable& node_keys() {
  static const KeyTable keys =
      KeyTable("node")
          .add("name", base_name_schema, "of letters, digits and `_`", Need::required)
          .add("command", texts(1),
               "a program and its arguments; a program with a `/` is relative to the scenario's file, others are found "
               "by `PATH`")
          .add("package", text_form().schema, "the package of an executable `type`")
          .add("type", text_form().schema, "the executable")
          .add("arguments", texts(), "further arguments")
          .add("namespace", namespace_schema, "within the robot's, unless it begins with `/`")
          .add("params", any_map_schema,
               "its private parameters: texts, numbers, truth values, lists, and maps of them; words have the types of "
               "YAML 1.1 as in `rosparam` (`1e3` is a text, `1.0e+3` a number; also `deg(90)`, `rad(pi/2)`)")
          .add("remap", name_map_schema, "a map of names: those of its code to those used instead")
          .add("environment", text_map_schema, "a map of variables")
          .add("after", texts(),
               "what its start waits for, all of it: `NODE` (has ended), `NODE.started`, `topic:NAME` and "
               "`service:NAME` (offered by a node), `tcp:PORT`, a path with a `/`")
          .add("required", truth_form().schema, "its end is the end of the run")
          .add(
              "output", [](SchemaDefinitions&) { return word_schema(output_words); },
              "of its messages: `log` or `screen`")
          .add("clear_params", truth_form().schema, "parameters in its private namespace are deleted before")
          .add("clock", text_form().schema,
               "the time that its computing takes: `fixed:US`, `interval:US..US` or `counted[:NS]`")
          .add("enabled", truth_form().schema, "`false`: it is left out")
          .require({{"oneOf", {needed({"command"}), needed({"package", "type"})}}});
  return keys;
}

const KeyTable& launch_keys() {
  static const KeyTable keys = KeyTable("launch file")
                                   .add("file", text_form().schema, "the launch file", Need::required)
                                   .add("args", text_map_schema, "values of its arguments");
  return keys;
}

Json launch_schema(SchemaDefinitions& definitions) { return text_or(launch_keys())(definitions); }

Json nodes_schema(SchemaDefinitions& definitions) { return list_of(node_keys())(definitions); }

}  // namespace waitpoint::scenario
