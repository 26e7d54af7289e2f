// SPDX-License-Identifier: BSD-3-Clause
#include "tools/nodes/bag_play.hpp"

#include <chrono>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <thread>

#include "core/printable_line.hpp"
#include "fibers/sync/system_calls/system_calls.hpp"
#include "modules/nodes/bag_run.hpp"
#include "modules/ros1/launch.hpp"
#include "tools/command/interruption.hpp"
#include "tools/nodes/bag_summary.hpp"
#include "tools/nodes/node_commands.hpp"
#include "tools/nodes/nodes_library.hpp"
#include "tools/output/output_file.hpp"
#include "tools/output/progress.hpp"

namespace waitpoint::tools {
namespace {

nodes::BagChoice choice_of(const scenario::PlayScenario& play) {
  nodes::BagChoice choice{
      .file = play.bag.string(), .topics = play.topics, .start_ns = play.start.ns(), .duration_ns = std::nullopt};
  if (play.duration) choice.duration_ns = play.duration->ns();
  return choice;
}

nodes::BagSideSetup setup_of(const scenario::Scenario& scenario) {
  nodes::BagSideSetup setup{.choice = choice_of(*scenario.play),
                            .has_clock = scenario.ros.publishes_clock,
                            .has_debian_master = scenario.ros.master == scenario::RosScenario::Master::outside,
                            .hears = scenario.play->hears,
                            .parameters = {}};
  for (const scenario::NodesScenario* const of : scenario.all_nodes())
    for (const auto& [name, parameter] : of->launch->parameters) setup.parameters.emplace_back(name, parameter.value);
  return setup;
}

BadInput bad_bag(const scenario::PlayScenario& play, const std::string& why) {
  return play.bag_written.bad("the bag '" + play.bag.string() + "' " + why);
}

// Virtual time, in which the process lives with its nodes.
class RunClock {
 public:
  /// False after a signal that ends the run.
  bool wait_until(Time time) const {
    std::this_thread::sleep_until(begin_ + std::chrono::nanoseconds(time.since_start().ns()));
    return interruption() == 0;
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace

void check_bag_play(const scenario::Scenario& scenario) {
  const scenario::PlayScenario& play = *scenario.play;
  check_library(play.written);
  (void)node_commands(scenario);
  try {
    library_of_nodes(play.written).check_bag(choice_of(play));
  } catch (const BadInput&) {
    throw;
  } catch (const std::runtime_error& failure) {
    throw bad_bag(play, failure.what());
  }
}

int play_bag(const scenario::Scenario& scenario, std::uint64_t seed, Time limit) {
  const scenario::PlayScenario& play = *scenario.play;
  std::vector<nodes::NodeCommand> commands = node_commands(scenario);
  const NodeOutputs outputs(play.outputs);
  Progress progress(stderr, false, limit.since_start());
  const RunClock clock;
  const nodes::BagRun::Surroundings surroundings{
      .wait_until = [&clock](Time time) { return clock.wait_until(time); },
      .tell = [&progress](Time now, const nodes::NodeNews& news) { progress.log(now, news.node, news.text); }};
  const sync::UnnotedThreads of_ros;
  nodes::BagResult result;
  try {
    std::unique_ptr<nodes::BagSide> side = library_of_nodes(play.written).make_bag_side(setup_of(scenario));
    result = nodes::BagRun(play, scenario.ros.publishes_clock, std::move(side), std::move(commands), surroundings)
                 .run(limit);
  } catch (const BadInput&) {
    throw;
  } catch (const std::runtime_error& failure) {
    throw bad_bag(play, failure.what());
  }
  const std::vector<NodeOutputs::File> files = outputs.read();
  write_standard_output(bag_summary(scenario, seed, result, files));
  return result.faults == 0 ? 0 : 1;
}

}  // namespace waitpoint::tools
