// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/scenario_document.hpp"

#include "core/confinement.hpp"
#include "modules/scenario/scenario_keys.hpp"
#include "modules/scenario/yaml_override.hpp"
#include "modules/scenario/yaml_reader.hpp"

namespace waitpoint::scenario {
namespace {

void check_format(const YamlNode& document) {
  if (document.kind != YamlNode::Kind::map) {
    throw document.written.bad("expected keys such as 'format: 1', found " + described(document));
  }
  const YamlNode* format = document.find("format");
  if (format == nullptr) throw document.written.bad("expected key 'format: 1'");
  read_count(*format, "format", scenario_format, scenario_format);
}

/// The floor of a file, as the base of a world. Its default height is copied to its shapes: the world has its own.
YamlNode load_floor(const std::filesystem::path& file) {
  YamlNode floor = load_yaml(file);
  check_format(floor);
  const YamlMap map(floor, "the floor", floor_keys().names());
  if (YamlEntry* shapes = floor.entry("shapes"); shapes != nullptr && map.has("shape_height_m")) {
    const YamlNode& height = map.require("shape_height_m");
    for (YamlNode& shape : shapes->value.items) {
      if (shape.kind == YamlNode::Kind::map && shape.find("height_m") == nullptr) {
        shape.entries.push_back({"height_m", height.written, height});
      }
    }
  }
  YamlNode world;
  world.kind = YamlNode::Kind::map;
  world.written = floor.written;
  for (const YamlEntry& entry : floor.entries) {
    if (entry.key == "map" || entry.key == "shapes") world.entries.push_back(entry);
  }
  return world;
}

/// The path of an `include`; BadInput if it does not exist, or is a pipe or device, which may never end.
std::filesystem::path included_file(const YamlNode& include) {
  std::filesystem::path file = include.written.resolve(read_text(include, "include"));
  if (!Confinement::allows(file))
    throw include.written.bad("'" + file.string() + "' lies outside of the folders that --confined allows");
  if (!std::filesystem::exists(file)) throw include.written.bad("there is no file '" + file.string() + "' to include");
  if (!std::filesystem::is_regular_file(file))
    throw include.written.bad("expected a file to include, found '" + file.string() + "', which is no regular file");
  return file;
}

/// The floor's shapes, overridden by own shapes of the same name, then the other own shapes.
YamlNode joined_shapes(const YamlNode& floor, const YamlNode& own) {
  if (floor.kind != YamlNode::Kind::list || own.kind != YamlNode::Kind::list) return own;
  YamlNode shapes = floor;
  lay_elements_over(shapes, own);
  return shapes;
}

/// Replaces `world.include` by the included floor, if any.
void include_floor(YamlNode& document) {
  YamlEntry* world = document.entry("world");
  const YamlNode* include = world == nullptr ? nullptr : world->value.find("include");
  if (include == nullptr) return;
  YamlNode result = load_floor(included_file(*include));
  result.written = world->value.written;
  for (const YamlEntry& entry : world->value.entries) {
    if (entry.key == "include") continue;
    YamlEntry* below = result.entry(entry.key);
    if (below == nullptr) {
      result.entries.push_back(entry);
    } else {
      below->value = entry.key == "shapes" ? joined_shapes(below->value, entry.value) : entry.value;
    }
  }
  world->value = std::move(result);
}

/// Overlays the scenario's robot types on the included ones, if any.
void include_robot_types(YamlNode& document) {
  YamlEntry* types = document.entry("robot_types");
  const YamlNode* include = types == nullptr ? nullptr : types->value.find("include");
  if (include == nullptr) return;
  YamlNode file = load_yaml(included_file(*include));
  check_format(file);
  const YamlNode& included =
      YamlMap(file, "the file of robot types", robot_types_keys().names()).require("robot_types");
  if (included.kind != YamlNode::Kind::map)
    throw included.written.bad("expected robot_types to be a map of keys, found " + described(included));
  YamlNode own = types->value;
  std::erase_if(own.entries, [](const YamlEntry& entry) { return entry.key == "include"; });
  types->value = laid_over(included, own);
}

}  // namespace

YamlNode scenario_document(const std::filesystem::path& file, const std::vector<std::string>& assignments) {
  YamlNode document = load_yaml(file);
  check_format(document);
  for (const std::string& text : assignments) {
    const Assignment assignment(text);
    if (assignment.path != "world" && assignment.path != "world.include") include_floor(document);
    if (assignment.path != "robot_types" && assignment.path != "robot_types.include") include_robot_types(document);
    assign(document, assignment);
  }
  include_floor(document);
  include_robot_types(document);
  return document;
}

}  // namespace waitpoint::scenario
