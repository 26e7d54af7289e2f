// SPDX-License-Identifier: BSD-3-Clause
#include "tools/nodes/world_partner.hpp"

#include <stdexcept>

#include "fibers/sync/system_calls/system_calls.hpp"
#include "modules/nodes/node_waits.hpp"
#include "modules/nodes/world_node.hpp"
#include "modules/nodes/world_topics.hpp"
#include "modules/run/known_map.hpp"
#include "tools/command/installed_part.hpp"
#include "tools/nodes/node_commands.hpp"
#include "tools/nodes/nodes_library.hpp"

namespace waitpoint::tools {
namespace {

// Calls of services are watched by a library in the nodes.
nodes::NodeRunOptions options_of(const scenario::Scenario& scenario, std::shared_ptr<nodes::ShownTopics> shown,
                                 bool is_brief) {
  nodes::NodeRunOptions options{.is_brief = is_brief, .shown = std::move(shown)};
  if (scenario.expect.service_call_max_s)
    options.environment.push_back({"LD_PRELOAD", find_part(nodes::calls_library).string()});
  return options;
}

const scenario::RobotScenario& first_with_nodes(const scenario::Scenario& scenario) {
  return scenario.robots[nodes::robots_with_nodes(scenario).front()];
}

}  // namespace

void check_nodes(const scenario::Scenario& scenario) {
  check_library(first_with_nodes(scenario).nodes->written);
  (void)node_commands(scenario);
}

std::unique_ptr<outside::Partner> make_world_partner(const scenario::Scenario& scenario,
                                                     std::shared_ptr<nodes::ShownTopics> shown, bool is_brief) {
  const scenario::RobotScenario& first = first_with_nodes(scenario);
  std::vector<nodes::NodeCommand> commands = node_commands(scenario);
  std::optional<scenario::MapFile> map = scenario.map;
  if (map) map->read();
  const OccupancyGrid known = run::known_map(scenario, map ? map->contents.get() : nullptr, first);
  std::unique_ptr<nodes::WorldTopics> topics;
  const sync::UnnotedThreads of_ros;
  try {
    topics = std::make_unique<nodes::WorldTopics>(
        scenario, known, library_of_nodes(first.nodes->written).make(nodes::node_side_setup(scenario)));
  } catch (const BadInput&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw first.nodes->written.bad(error.what());
  }
  return std::make_unique<nodes::WorldNode>(scenario, std::move(topics), std::move(commands),
                                            options_of(scenario, std::move(shown), is_brief));
}

}  // namespace waitpoint::tools
