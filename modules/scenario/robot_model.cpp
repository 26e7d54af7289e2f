// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/robot_model.hpp"

#include <algorithm>

#include "core/exact_math.hpp"
#include "core/file_contents.hpp"
#include "core/nearest_name.hpp"
#include "world/formats/limits.hpp"
#include "world/formats/upright.hpp"

namespace waitpoint::scenario {
namespace {

// Empty values are text, too: most namespaces are.
world::XacroArguments read_arguments(const YamlNode& node) {
  if (node.kind != YamlNode::Kind::map) throw node.written.bad("expected arguments to be a map of names and values");
  world::XacroArguments arguments;
  for (const YamlEntry& entry : node.entries) {
    if (entry.value.kind == YamlNode::Kind::list || entry.value.kind == YamlNode::Kind::map)
      throw entry.written.bad("expected " + entry.key + " to be a text, found " + described(entry.value));
    arguments.emplace(entry.key, entry.value.text);
  }
  return arguments;
}

}  // namespace

std::optional<RobotModel> read_robot_model(const YamlMap& robot) {
  const YamlNode* named = robot.find("urdf");
  if (named == nullptr) return std::nullopt;
  world::XacroArguments arguments;
  if (named->kind == YamlNode::Kind::map) {
    const YamlMap map(*named, "the urdf", {"file", "arguments"});
    if (const YamlNode* given = map.find("arguments")) arguments = read_arguments(*given);
    named = &map.require("file");
  }
  const std::string file = named->written.resolve(read_text(*named, "urdf")).string();
  world::LeftOut left_out;
  RobotModel model;
  model.robot = world::parse_urdf(file_contents(file, "a URDF", world::tree_bytes_max), file, left_out, arguments);
  model.warnings = left_out.warnings();
  return model;
}

void mount_at_frame(const YamlNode& laser, const std::optional<RobotModel>& model, world::LaserDescription& device) {
  const YamlNode* frame = laser.find("frame");
  if (frame == nullptr) return;
  if (!model) throw frame->written.bad("expected no frame: the robot has no urdf");
  for (const char* other : {"mount", "height_m"})
    if (laser.find(other) != nullptr) throw frame->written.bad(std::string("expected either frame or ") + other);
  const std::string name = read_text(*frame, "frame");
  const std::vector<world::UrdfFrame>& frames = model->robot.frames;
  const auto found = std::find_if(frames.begin(), frames.end(), [&](const auto& link) { return link.link == name; });
  if (found == frames.end()) {
    std::vector<std::string_view> names;
    names.reserve(frames.size());
    for (const world::UrdfFrame& link : frames) names.push_back(link.link);
    throw frame->written.bad("there is no link '" + name + "' in the urdf" + did_you_mean(name, names));
  }
  const world::SpacePose& pose = found->pose;
  if (exact::hypot(pose.axes[2].x, pose.axes[2].y) > world::tilt_max_rad)
    throw frame->written.bad("expected link '" + name + "' to be level, as scans are");
  device.mount = {pose.position.x, pose.position.y, exact::atan2(pose.axes[0].y, pose.axes[0].x)};
  device.height_m = pose.position.z;
}

}  // namespace waitpoint::scenario
