// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/poster_topics.hpp"

#include <algorithm>

#include "modules/ros1/graph_name.hpp"
#include "modules/scenario/yaml_reader.hpp"

namespace waitpoint::scenario {

std::vector<PosterTopic> poster_topics(const NodesScenario& nodes) {
  std::vector<PosterTopic> table;
  const YamlNode* const ros = nodes.document->find("ros");
  const YamlNode* const publish = ros == nullptr ? nullptr : ros->find("publish");
  if (publish == nullptr || publish->is_null()) return table;
  if (publish->kind != YamlNode::Kind::map)
    throw publish->written.bad("expected publish to be a map of posters and topics, found " + described(*publish));
  for (const YamlEntry& entry : publish->entries) {
    if (entry.value.is_null()) continue;
    const std::string topic = read_text(entry.value, "the topic of '" + entry.key + "'");
    if (!ros1::is_graph_name(topic) || topic.starts_with('~'))
      throw entry.value.written.bad("expected the topic of '" + entry.key +
                                    "' to be a name of ROS: letters, digits, '_' and '/', found '" + topic + "'");
    table.push_back({entry.key, topic, entry.written});
  }
  return table;
}

bool takes_pose(const RobotScenario& robot) {
  return std::any_of(robot.bridge.begin(), robot.bridge.end(),
                     [](const BridgeRow& row) { return row.device == pose_topic_device; });
}

}  // namespace waitpoint::scenario
