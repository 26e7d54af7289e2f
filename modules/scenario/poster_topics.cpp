// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/poster_topics.hpp"

#include <algorithm>
#include <iterator>

#include "modules/ros1/graph_name.hpp"
#include "modules/scenario/nodes_keys.hpp"
#include "modules/scenario/yaml_reader.hpp"

namespace waitpoint::scenario {

namespace {

/// The map `key` of the robot's `ros`; null without one. BadInput if it is no map.
const YamlNode* table_of(const NodesScenario& nodes, std::string_view key, const std::string& what) {
  const YamlNode* const ros = nodes.document->find("ros");
  const YamlNode* const table = ros == nullptr ? nullptr : ros->find(key);
  if (table == nullptr || table->is_null()) return nullptr;
  if (table->kind != YamlNode::Kind::map)
    throw table->written.bad("expected " + std::string(key) + " to be a map of " + what + ", found " +
                             described(*table));
  return table;
}

void check_topic(const std::string& topic, const std::string& what, const Location& written) {
  if (!ros1::is_graph_name(topic) || topic.starts_with('~'))
    throw written.bad("expected " + what + " to be a name of ROS: letters, digits, '_' and '/', found '" + topic + "'");
}

}  // namespace

std::vector<PosterTopic> poster_topics(const NodesScenario& nodes) {
  std::vector<PosterTopic> table;
  const YamlNode* const publish = table_of(nodes, "publish", "posters and topics");
  if (publish == nullptr) return table;
  for (const YamlEntry& entry : publish->entries) {
    if (entry.value.is_null()) continue;
    const std::string topic = read_text(entry.value, "the topic of '" + entry.key + "'");
    check_topic(topic, "the topic of '" + entry.key + "'", entry.value.written);
    table.push_back({entry.key, topic, entry.written});
  }
  return table;
}

std::vector<ShownTopic> shown_topics(const NodesScenario& nodes) {
  std::vector<ShownTopic> table;
  const YamlNode* const show = table_of(nodes, "show", "topics and their kinds");
  if (show == nullptr) return table;
  for (const YamlEntry& entry : show->entries) {
    if (entry.value.is_null()) continue;
    check_topic(entry.key, "a topic in show", entry.written);
    const std::string kind = read_text(entry.value, "the kind of '" + entry.key + "'");
    const auto* const found = std::find(std::begin(shown_kinds), std::end(shown_kinds), kind);
    if (found == std::end(shown_kinds))
      throw entry.value.written.bad("expected the kind of '" + entry.key + "' to be path, cloud or grid, found '" +
                                    kind + "'");
    table.push_back({entry.key, static_cast<ShownTopic::Kind>(found - std::begin(shown_kinds))});
  }
  return table;
}

bool takes_pose(const RobotScenario& robot) {
  return std::any_of(robot.bridge.begin(), robot.bridge.end(),
                     [](const BridgeRow& row) { return row.device == pose_topic_device; });
}

}  // namespace waitpoint::scenario
