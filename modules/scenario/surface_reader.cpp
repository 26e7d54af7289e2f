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

}  // namespace

world::MeshObstacle read_mesh(const YamlNode& node, const std::string& name, world::LeftOut& left_out) {
  const YamlMap map(node, "'" + name + "'", {"name", "mesh", "at_m", "heading_deg", "scale", "known"});
  world::MeshObstacle obstacle;
  obstacle.name = name;
  map.read("known", obstacle.known);
  const world::MeshPlacement placement = {read_scale(map), world::space_pose(read_place(map), 0, 0, read_heading(map))};
  obstacle.mesh = std::make_shared<const world::TriangleMesh>(
      world::read_mesh_file(resolved(map.require("mesh"), "mesh"), placement, left_out));
  return obstacle;
}

std::vector<world::Obstacle> read_octomap(const YamlNode& node, const std::string& name, world::LeftOut& left_out) {
  const YamlMap map(node, "'" + name + "'", {"name", "octomap", "at_m", "heading_deg", "known"});
  bool known = true;
  map.read("known", known);
  const world::SpaceVector at = read_place(map);
  std::vector<world::Obstacle> boxes = world::read_octree(resolved(map.require("octomap"), "octomap"), name,
                                                          {at.x, at.y, read_heading(map)}, at.z, left_out);
  for (world::Obstacle& box : boxes) box.known = known;
  return boxes;
}

}  // namespace waitpoint::scenario
