// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/replay_command.hpp"

#include <cerrno>

#include "tools/command/shell_words.hpp"

namespace waitpoint::tools {
namespace {

std::string accesses_of(const std::vector<std::string>& libraries) {
  std::string words = "accesses";
  for (const std::string& library : libraries) words += (&library == &libraries.front() ? ":" : ",") + library;
  return words;
}

/// Without the program's name.
std::string explore_words(const ExploreOptions& options, const std::string& replayed) {
  std::string line = "explore";
  const bool is_program = !options.program.empty() && !options.has_nodes;
  if (!is_program) line += " " + quoted(options.scenario.string());
  line += " --seed " + std::to_string(options.seed);
  if (options.has_until()) line += " --until " + to_string(options.until);
  if (is_program) line += options.conditions.words();
  if (options.races != Races::report) line += options.races == Races::fail ? " --races fail" : " --races ignore";
  if (is_program && options.switch_at == SwitchAt::accesses)
    line += " --switch-at " + quoted(accesses_of(options.libraries));
  if (options.memory == Memory::weak) line += " --memory weak";
  if (options.from) line += " --from " + to_string(Time() + *options.from);
  for (std::size_t i = 0; i < options.sets; ++i) line += " --set " + quoted(options.assignments[i]);
  for (const std::string& property : options.properties) line += " --property " + quoted(property);
  if (!replayed.empty()) line += " --replay " + quoted(replayed);
  if (is_program) line += " --" + quoted(options.program);
  return line;
}

}  // namespace

std::string replay_command(const ExploreOptions& options, const std::string& replayed) {
  return quoted(program_invocation_name) + " " + explore_words(options, replayed);
}

std::string debug_command(const ExploreOptions& options, const std::string& replayed) {
  const std::string program = program_invocation_name;
  const bool is_own = program.substr(program.rfind('/') + 1) == "waitpoint";
  // A program is forked, just before its main().
  const std::string gdb = options.program.empty() ? " gdb -- " : " gdb -ex 'set follow-fork-mode child' -- ";
  return (is_own ? quoted(program) + gdb : "waitpoint" + gdb + quoted(program) + " ") +
         explore_words(options, replayed);
}

}  // namespace waitpoint::tools
