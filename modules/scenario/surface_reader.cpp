// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/surface_reader.hpp"

#include "modules/scenario/shape_reader.hpp"
#include "world/formats/mesh_file.hpp"
#include "world/formats/octree.hpp"

namespace waitpoint::scenario {
namespace {

constexpr NumberRange scale_number{1e-6, 1e6, "a number from 0.000001 to 1000000"};

std::string resolved(const YamlNode& file, std::string_view what) {
  return file.written.resolve(read_text(file, what)).string();
}

/// `at_m`: [x, y] or [x, y, z].
world::SpaceVector read_place(const YamlMap& map) {
  const YamlNode* node = map.find("at_m");
  if (node == nullptr) return {};
  const std::vector<double> at = read_numbers(*node, "at_m", 2, 3, ranges::coordinate);
  return {at[0], at[1], at.size() == 3 ? at[2] : 0};
}

world::SpaceVector read_scale(const YamlMap& map) {
  const YamlNode* node = map.find("scale");
  if (node == nullptr) return {1, 1, 1};
  if (node->kind == YamlNode::Kind::scalar) {
    const double scale = read_number(*node, "scale", scale_number);
    return {scale, scale, scale};
  }
  const std::vector<double> scale = read_numbers(*node, "scale", 3, 3, scale_number);
  return {scale[0], scale[1], scale[2]};
}

Json place_schema(SchemaDefinitions&) { return numbers_schema(ranges::coordinate, 2, 3); }
Json scale_schema(SchemaDefinitions&) {
  return any_of({number_schema(scale_number), numbers_schema(scale_number, 3, 3)});
}

}  // namespace

const KeyTable& mesh_keys() {
  static const KeyTable keys = KeyTable("mesh")
                                   .add("name", text_form().schema, "its name in messages")
                                   .add("mesh", text_form().schema, "the file", Need::required)
                                   .add("at_m", place_schema, "`[x, y]` or `[x, y, z]` of the file's origin")
                                   .add("heading_deg", heading_form().schema, "of the file's x axis")
                                   .add("scale", scale_schema, "a factor, or one for each axis")
                                   .add("known", truth_form().schema, "`false`: it is on no map of the robots");
  return keys;
}

const KeyTable& octomap_keys() {
  static const KeyTable keys = KeyTable("octomap")
                                   .add("name", text_form().schema, "its name in messages")
                                   .add("octomap", text_form().schema, "the file", Need::required)
                                   .add("at_m", place_schema, "`[x, y]` or `[x, y, z]` of the file's origin")
                                   .add("heading_deg", heading_form().schema, "of the file's x axis")
                                   .add("known", truth_form().schema, "`false`: it is on no map of the robots");
  return keys;
}

world::MeshObstacle read_mesh(const YamlNode& node, const std::string& name, world::LeftOut& left_out) {
  const YamlMap map(node, "'" + name + "'", mesh_keys().names());
  world::MeshObstacle obstacle;
  obstacle.name = map.text("name", name);
  map.read("known", obstacle.known);
  const world::MeshPlacement placement = {read_scale(map), world::space_pose(read_place(map), 0, 0, read_heading(map))};
  obstacle.mesh = std::make_shared<const world::TriangleMesh>(
      world::read_mesh_file(resolved(map.require("mesh"), "mesh"), placement, left_out));
  return obstacle;
}

std::vector<world::Obstacle> read_octomap(const YamlNode& node, const std::string& name, world::LeftOut& left_out) {
  const YamlMap map(node, "'" + name + "'", octomap_keys().names());
  bool known = true;
  map.text("name", name);
  map.read("known", known);
  const world::SpaceVector at = read_place(map);
  std::vector<world::Obstacle> boxes = world::read_octree(resolved(map.require("octomap"), "octomap"), name,
                                                          {at.x, at.y, read_heading(map)}, at.z, left_out);
  for (world::Obstacle& box : boxes) box.known = known;
  return boxes;
}

}  // namespace waitpoint::scenario
