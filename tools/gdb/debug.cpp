// SPDX-License-Identifier: BSD-3-Clause
#include "tools/gdb/debug.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/error.hpp"
#include "core/program_path.hpp"
#include "tools/command/installed_part.hpp"
#include "tools/command/own_command_line.hpp"
#include "tools/command/shell_words.hpp"
#include "tools/exec/exec.hpp"
#include "tools/exec/program_file.hpp"
#include "tools/exec/program_process.hpp"
#include "tools/explore/replay/program_replay.hpp"

namespace waitpoint::tools {
namespace {

std::filesystem::path own_program() { return std::filesystem::read_symlink("/proc/self/exe"); }

[[noreturn]] void become_gdb(const DebugOptions& options, const std::vector<std::string>& first,
                             const std::vector<std::string>& program) {
  std::vector<std::string> words = {"gdb", "-q", "-x", find_gdb_script("waitpoint-gdb.py").string()};
  for (const auto* some : {&first, &options.gdb_options}) words.insert(words.end(), some->begin(), some->end());
  words.push_back("--args");
  words.insert(words.end(), program.begin(), program.end());
  execvp("gdb", pointers(words).data());
  throw BadInput("gdb", errno == ENOENT ? "gdb is not installed" : std::string("gdb: ") + std::strerror(errno));
}

/// gdb starts the program itself, with the environment of `waitpoint exec`. `streams`: words of a shell.
[[noreturn]] void debug_process(const DebugOptions& options, const ProgramFiles& files, const RunMemory& memory,
                                const std::string& streams) {
  std::vector<std::string> words = files.words;
  words.front() = files.program.string();
  std::vector<std::string> first = {"-iex", "set breakpoint pending on", "-ex"};
  first.emplace_back("handle SIGSYS nostop noprint pass");  // raw system calls, which the layer answers
  if (!files.accesses.empty()) first.insert(first.end(), {"-ex", "handle SIGTRAP nostop noprint pass"});
  first.insert(first.end(), {"-ex", "set exec-wrapper env" + quoted(environment_of(files, memory))});
  if (!streams.empty())
    first.insert(first.end(),
                 {"-ex", "set args" + quoted(std::vector<std::string>(words.begin() + 1, words.end())) + streams});
  become_gdb(options, first, words);
}

[[noreturn]] void debug_program(const DebugOptions& options, const ExecOptions& program) {
  const ProgramFiles files(program.words);
  program.conditions.check(files.named());
  debug_process(options, files, RunMemory(settings_of(program, program.seed)), "");
}

/// A descriptor that programs do not expect, and that they inherit.
int moved_up(int descriptor) { return fcntl(descriptor, F_DUPFD, least_descriptor); }

/// The writing end of a pipe whose bytes go to standard output. The process that copies them is nobody's child.
int output_of_replay() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw BadInput("gdb", std::string("cannot create a pipe: ") + std::strerror(errno));
  if (const pid_t parent = fork(); parent != 0) {
    close(ends[0]);
    waitpid(parent, nullptr, 0);
    return moved_up(ends[1]);
  }
  if (fork() != 0) _exit(0);
  close(ends[1]);
  char bytes[4096];
  for (ssize_t size = 0; (size = read(ends[0], bytes, sizeof bytes)) > 0;)
    if (write(STDOUT_FILENO, bytes, static_cast<std::size_t>(size)) < 0) break;
  _exit(0);
}

// A pipe of the user's is as the file of a search.
[[noreturn]] void debug_replay(const DebugOptions& options, const ExploreOptions& replayed) {
  replay_in(replayed, [&](const ProgramFiles& files, const RunMemory& memory, int input) {
    const std::string folder = "/proc/self/fd/";
    const std::string streams = " < " + folder + std::to_string(moved_up(input)) + " > " + folder +
                                std::to_string(output_of_replay()) + " 2>&1";
    debug_process(options, files, memory, streams);
  });
  std::abort();
}

}  // namespace

void declare(Command& command, DebugOptions& options) {
  command.description = "Starts gdb with commands for simulated threads (docs/gdb.md).";
  command.examples = {"-- run office --until 60", "-- ./program", "-- explore --replay wx1... -- ./program"};
  command.usages = {"[OPTIONS OF GDB] -- run SCENARIO ...", "[OPTIONS OF GDB] -- PROGRAM ..."};
  command.takes_program = true;
  command.takes_all_words = true;
  command.finally([&command, &options] {
    const std::vector<std::string>& words = command.program();
    const auto dashes = std::ranges::find(words, "--");
    if (dashes == words.end() || dashes + 1 == words.end())
      throw BadInput("gdb",
                     "expected a command to run: waitpoint gdb -- run SCENARIO ..., or waitpoint gdb -- PROGRAM ...");
    options.gdb_options.assign(words.begin(), dashes);
    options.words.assign(dashes + 1, words.end());
  });
}

void debug(const DebugOptions& options) {
  if (!options.own && find_program(options.words.front()).empty())
    throw BadInput("gdb", "there is no program '" + options.words.front() + "'");
  std::vector<std::string> words = options.words;
  if (options.own) words.insert(words.begin(), own_program().string());
  if (options.program) debug_program(options, *options.program);
  if (options.replayed) debug_replay(options, *options.replayed);
  become_gdb(options, {}, words);
}

}  // namespace waitpoint::tools
