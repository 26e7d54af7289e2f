// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/node_processes.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <thread>

namespace waitpoint::nodes {
namespace {

constexpr Duration registration = std::chrono::seconds(10);  // until an unregistered node is reported
constexpr Duration end_patience = std::chrono::seconds(2), kill_patience = std::chrono::seconds(2);
constexpr std::chrono::milliseconds look(10);

std::vector<std::string> words_of(const NodeCommand& command) {
  std::vector<std::string> words = command.words;
  for (const ros1::Remapping& remapping : command.node.remappings)
    words.push_back(remapping.from + ":=" + remapping.to);
  words.push_back("__name:=" + command.node.name);
  return words;
}

HostedProgram program_of(const NodeCommand& command, const MasterSide& master,
                         const std::vector<EnvironmentVariable>& environment) {
  const ros1::Node& node = command.node;
  HostedProgram program{.name = node.global_name(), .words = words_of(command), .after = node.after};
  program.environment = node.environment;
  program.environment.insert(program.environment.end(), environment.begin(), environment.end());
  program.environment.push_back({"ROS_MASTER_URI", master.master_address()});
  program.environment.push_back({"ROS_IP", "127.0.0.1"});
  if (node.ns != "/") program.environment.push_back({"ROS_NAMESPACE", node.ns});
  // A run prints its summary only.
  using Output = HostedProgram::Output;
  program.output = node.output == ros1::Node::Output::screen ? Output::errors : Output::nothing;
  return program;
}

}  // namespace

NodeProcesses::NodeProcesses(std::vector<NodeCommand> commands, const MasterSide& master, NodeEnds ends,
                             const std::vector<EnvironmentVariable>& environment)
    : master_(master),
      ends_(ends),
      programs_(processes_, [this](const StartCondition& condition) { return is_advertised(condition); }) {
  nodes_.reserve(commands.size());
  for (NodeCommand& command : commands) {
    programs_.add(program_of(command, master, environment));
    nodes_.push_back({.command = std::move(command)});
  }
}

bool NodeProcesses::is_advertised(const StartCondition& condition) const {
  if (condition.kind == StartCondition::Kind::topic) return master_.is_published(condition.of);
  if (condition.kind == StartCondition::Kind::service) return master_.is_served(condition.of);
  return holds_outside(condition);
}

void NodeProcesses::go_on(Time now) {
  note_ends();
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    start_if_due(i, now);
    if (programs_.runs(i)) watch(i, now);
  }
}

void NodeProcesses::start_if_due(std::size_t number, Time now) {
  WatchedNode& node = nodes_[number];
  try {
    if (programs_.start_if_due(number)) node.started = now;
  } catch (const HostingError& error) {
    node.is_end_noted = true;
    news_.push_back({node.name(), error.what(), true, !node.is_test()});
    is_over_ = is_over_ || node.command.node.required;
  }
}

void NodeProcesses::watch(std::size_t number, Time now) {
  WatchedNode& node = nodes_[number];
  if (node.is_registered || node.is_missed) return;
  node.is_registered = master_.is_registered(node.name());
  if (node.is_registered || now - node.started < registration) return;
  node.is_missed = true;
  news_.push_back(
      {node.name(), fmt::format("has not registered with the master in {} s", registration.seconds()), true});
}

void NodeProcesses::note_ends() {
  processes_.note_ends();
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (const std::optional<ProgramEnd> end = programs_.end_of(i); end && !nodes_[i].is_end_noted)
      note_end(nodes_[i], *end);
}

void NodeProcesses::note_end(WatchedNode& node, const ProgramEnd& end) {
  node.is_end_noted = true;
  if (is_ending_) return;
  news_.push_back({node.name(), end.in_words(), end.is_failure(), end.is_failure() && !node.is_test()});
  const auto is_open = [](const WatchedNode& one) { return one.is_test() && !one.is_end_noted; };
  is_over_ = is_over_ || node.command.node.required || (node.is_test() && std::ranges::none_of(nodes_, is_open));
}

std::vector<std::string> NodeProcesses::unmet_tests(std::optional<Time> now) const {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const WatchedNode& node = nodes_[i];
    if (!node.is_test()) continue;
    const std::optional<ProgramEnd> end = programs_.end_of(i);
    const bool is_late = !now || (programs_.runs(i) && *now - node.started > *node.command.time_limit);
    if (!end && is_late) lines.push_back("test " + node.name() + " has not ended");
    if (end && end->is_failure()) lines.push_back("test " + node.name() + " " + end->in_words());
  }
  return lines;
}

std::vector<std::string> NodeProcesses::not_started() const {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (!programs_.has_started(i))
      lines.push_back("node " + nodes_[i].name() + " was not started: what it is to wait for did not come");
  return lines;
}

bool NodeProcesses::have_tests() const { return std::ranges::any_of(nodes_, &WatchedNode::is_test); }

bool NodeProcesses::are_there() const {
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (programs_.runs(i) && !nodes_[i].is_registered && !nodes_[i].is_missed) return false;
  return true;
}

// One after the other, the last one first: roscpp's nodes poll for a tenth of a second before they end, and several
// that do so at once would hand over to each other all the time.
void NodeProcesses::end() {
  is_ending_ = true;
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    for (const auto& [signal, patience] : {std::pair(SIGINT, end_patience), std::pair(SIGKILL, kill_patience)}) {
      if (signal == SIGINT && ends_ == NodeEnds::killed) continue;
      if (!programs_.runs(i)) break;
      processes_.send(i, signal);
      for (Duration waited; waited < patience && programs_.runs(i); waited = waited + look) {
        std::this_thread::sleep_for(look);
        note_ends();
      }
    }
  }
}

}  // namespace waitpoint::nodes
