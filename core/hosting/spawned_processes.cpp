// SPDX-License-Identifier: BSD-3-Clause
#include "core/hosting/spawned_processes.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

extern char** environ;

namespace waitpoint {
namespace {

using Output = HostedProgram::Output;

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// The environment of this process, with the given variables in the place of those of their names.
std::vector<std::string> environment_with(const std::vector<EnvironmentVariable>& more) {
  std::vector<std::string> all;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text = *entry;
    const std::string_view name = text.substr(0, text.find('='));
    if (std::ranges::none_of(more, [&](const auto& variable) { return variable.name == name; })) all.emplace_back(text);
  }
  for (auto variable = more.begin(); variable != more.end(); ++variable)
    if (std::none_of(variable + 1, more.end(), [&](const auto& later) { return later.name == variable->name; }))
      all.push_back(variable->name + "=" + variable->value);
  return all;
}

/// The streams of a program that are not its owner's.
class StreamActions {
 public:
  explicit StreamActions(const HostedProgram& program)
      : are_any_(!program.has_input || program.output != Output::output) {
    if (!are_any_) return;
    posix_spawn_file_actions_init(&actions_);
    if (!program.has_input) posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    if (program.output == Output::errors)
      posix_spawn_file_actions_adddup2(&actions_, STDERR_FILENO, STDOUT_FILENO);
    else if (program.output == Output::nothing)
      posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  }
  ~StreamActions() {
    if (are_any_) posix_spawn_file_actions_destroy(&actions_);
  }
  StreamActions(const StreamActions&) = delete;
  StreamActions& operator=(const StreamActions&) = delete;
  const posix_spawn_file_actions_t* all() const { return are_any_ ? &actions_ : nullptr; }

 private:
  bool are_any_;
  posix_spawn_file_actions_t actions_{};
};

}  // namespace

void SpawnedProcesses::start(std::size_t program) {
  Process& process = processes_[program];
  std::vector<std::string> words = process.program.words, environment = environment_with(process.program.environment);
  const StreamActions actions(process.program);
  const int error = posix_spawnp(&process.id, words.front().c_str(), actions.all(), nullptr, pointers_to(words).data(),
                                 pointers_to(environment).data());
  if (error == 0) return;
  process.id = 0;
  process.end = ProgramEnd::by_exit(ProgramEnd::not_started);
  throw HostingError("cannot be started: " + words.front() + ": " + std::strerror(error));
}

bool SpawnedProcesses::await_end(int flags) {
  int status = 0;
  const pid_t ended = waitpid(-1, &status, flags);
  const auto process = std::ranges::find(processes_, ended, &Process::id);
  if (ended > 0 && process != processes_.end()) process->end = ProgramEnd(status);
  return ended > 0;
}

void SpawnedProcesses::note_ends() {
  for (Process& process : processes_) {
    int status = 0;
    if (process.id != 0 && !process.end && waitpid(process.id, &status, WNOHANG) == process.id)
      process.end = ProgramEnd(status);
  }
}

void SpawnedProcesses::send(std::size_t program, int signal) const {
  const Process& process = processes_[program];
  if (process.id != 0 && !process.end) kill(process.id, signal);
}

}  // namespace waitpoint
