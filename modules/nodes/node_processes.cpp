// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/node_processes.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "core/start_condition.hpp"

extern char** environ;

namespace waitpoint::nodes {
namespace {

constexpr Duration registration = std::chrono::seconds(10);  // until a node that has not registered is told of
constexpr Duration end_patience = std::chrono::seconds(2), kill_patience = std::chrono::seconds(2);
constexpr std::chrono::milliseconds look(10);

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// The environment of this process, with the given variables in the place of those of their names.
std::vector<std::string> environment_with(const std::vector<ros1::EnvironmentVariable>& more) {
  std::vector<std::string> all;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text = *entry;
    const std::string_view name = text.substr(0, text.find('='));
    if (std::none_of(more.begin(), more.end(), [&](const auto& variable) { return variable.name == name; }))
      all.emplace_back(text);
  }
  // Of several with one name the last counts.
  for (auto variable = more.begin(); variable != more.end(); ++variable)
    if (std::none_of(variable + 1, more.end(), [&](const auto& later) { return later.name == variable->name; }))
      all.push_back(variable->name + "=" + variable->value);
  return all;
}

std::vector<std::string> words_of(const NodeCommand& command) {
  std::vector<std::string> words = command.words;
  for (const ros1::Remapping& remapping : command.node.remappings)
    words.push_back(remapping.from + ":=" + remapping.to);
  words.push_back("__name:=" + command.node.name);
  return words;
}

std::string ending(int status) {
  if (WIFSIGNALED(status)) return fmt::format("ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  return fmt::format("ended with status {}", WEXITSTATUS(status));
}

}  // namespace

NodeProcesses::NodeProcesses(std::vector<NodeCommand> commands, const MasterSide& master, NodeEnds ends,
                             std::vector<ros1::EnvironmentVariable> environment)
    : master_(master), ends_(ends), environment_(std::move(environment)) {
  processes_.reserve(commands.size());
  for (NodeCommand& command : commands) processes_.push_back({.command = std::move(command)});
}

void NodeProcesses::go_on(Time now) {
  reap();
  for (Process& process : processes_) {
    if (process.state == State::waiting && may_start(process)) start(process, now);
    if (process.state == State::running) watch(process, now);
  }
}

bool NodeProcesses::may_start(const Process& process) const {
  return std::all_of(process.command.node.after.begin(), process.command.node.after.end(),
                     [this](const ros1::NodeCondition& condition) { return holds(condition); });
}

bool NodeProcesses::holds(const ros1::NodeCondition& condition) const {
  if (const auto* of = std::get_if<ros1::Advertisement>(&condition))
    return of->kind == ros1::Advertisement::Kind::topic ? master_.is_published(of->name) : master_.is_served(of->name);
  const StartCondition& start = std::get<StartCondition>(condition);
  if (!start.is_of_program()) return holds_outside(start);
  const Process* const other = find(start.of);
  if (other == nullptr) return false;
  return start.kind == StartCondition::Kind::end ? other->state == State::ended : other->state != State::waiting;
}

const NodeProcesses::Process* NodeProcesses::find(const std::string& name) const {
  for (const Process& process : processes_)
    if (process.command.node.global_name() == name) return &process;
  return nullptr;
}

void NodeProcesses::start(Process& process, Time now) {
  const ros1::Node& node = process.command.node;
  std::vector<ros1::EnvironmentVariable> variables = node.environment;
  variables.insert(variables.end(), environment_.begin(), environment_.end());
  variables.push_back({"ROS_MASTER_URI", master_.master_address()});
  variables.push_back({"ROS_IP", "127.0.0.1"});
  if (node.ns != "/") variables.push_back({"ROS_NAMESPACE", node.ns});
  std::vector<std::string> words = words_of(process.command), environment = environment_with(variables);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  // What a run prints is its summary.
  if (node.output == ros1::Node::Output::screen)
    posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  else
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  const int error = posix_spawnp(&process.id, words.front().c_str(), &actions, nullptr, pointers_to(words).data(),
                                 pointers_to(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  process.started = now;
  process.state = error == 0 ? State::running : State::ended;
  if (error == 0) return;
  process.status = W_EXITCODE(EXIT_FAILURE, 0);
  news_.push_back({node.global_name(), fmt::format("cannot be started: {}: {}", words.front(), std::strerror(error)),
                   true, !process.command.time_limit});
  is_over_ = is_over_ || node.required;
}

void NodeProcesses::watch(Process& process, Time now) {
  if (process.is_registered || process.is_missed) return;
  const std::string name = process.command.node.global_name();
  process.is_registered = master_.is_registered(name);
  if (process.is_registered || now - process.started < registration) return;
  process.is_missed = true;
  news_.push_back({name, fmt::format("has not registered with the master in {} s", registration.seconds()), true});
}

void NodeProcesses::reap() {
  for (Process& process : processes_) {
    int status = 0;
    if (process.state == State::running && waitpid(process.id, &status, WNOHANG) == process.id)
      note_end(process, status);
  }
}

void NodeProcesses::note_end(Process& process, int status) {
  process.state = State::ended;
  process.status = status;
  if (is_ending_) return;
  const bool is_failure = !WIFEXITED(status) || WEXITSTATUS(status) != 0;
  const bool is_test = process.command.time_limit.has_value();
  news_.push_back({process.command.node.global_name(), ending(status), is_failure, is_failure && !is_test});
  const auto is_open = [](const Process& one) { return one.command.time_limit && one.state != State::ended; };
  is_over_ = is_over_ || process.command.node.required ||
             (is_test && std::none_of(processes_.begin(), processes_.end(), is_open));
}

std::vector<std::string> NodeProcesses::unmet_tests(std::optional<Time> now) const {
  std::vector<std::string> lines;
  for (const Process& process : processes_) {
    if (!process.command.time_limit) continue;
    const std::string name = "test " + process.command.node.global_name();
    const bool is_late =
        !now || (process.state == State::running && *now - process.started > *process.command.time_limit);
    if (process.state != State::ended && is_late)
      lines.push_back(name + " has not ended");
    else if (process.state == State::ended && process.status != 0)
      lines.push_back(name + " " + ending(process.status));
  }
  return lines;
}

std::vector<std::string> NodeProcesses::not_started() const {
  std::vector<std::string> lines;
  for (const Process& process : processes_)
    if (process.state == State::waiting)
      lines.push_back("node " + process.command.node.global_name() +
                      " was not started: what it is to wait for did not come");
  return lines;
}

bool NodeProcesses::have_tests() const {
  return std::ranges::any_of(processes_, [](const Process& process) { return process.command.time_limit.has_value(); });
}

bool NodeProcesses::have_ended() const {
  return std::ranges::all_of(processes_, [](const Process& process) { return process.state == State::ended; });
}

bool NodeProcesses::are_there() const {
  return std::ranges::all_of(processes_, [](const Process& process) {
    return process.state != State::running || process.is_registered || process.is_missed;
  });
}

// One after the other, the last one first: roscpp's nodes poll for a tenth of a second before they end, and several
// that do so at once would hand over to each other all the time.
void NodeProcesses::end() {
  is_ending_ = true;
  for (auto process = processes_.rbegin(); process != processes_.rend(); ++process) {
    for (const auto& [signal, patience] : {std::pair(SIGINT, end_patience), std::pair(SIGKILL, kill_patience)}) {
      if (signal == SIGINT && ends_ == NodeEnds::killed) continue;
      if (process->state != State::running) break;
      kill(process->id, signal);
      for (Duration waited; waited < patience && process->state == State::running; waited = waited + look) {
        std::this_thread::sleep_for(look);
        reap();
      }
    }
  }
}

}  // namespace waitpoint::nodes
