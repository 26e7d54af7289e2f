// SPDX-License-Identifier: BSD-3-Clause
#include "tools/gdb/debug.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/error.hpp"
#include "core/program_path.hpp"
#include "tools/command/data_folder.hpp"
#include "tools/command/shell_words.hpp"
#include "tools/exec/exec.hpp"
#include "tools/exec/program_file.hpp"
#include "tools/exec/program_process.hpp"

namespace waitpoint::tools {
namespace {

std::filesystem::path own_program() { return std::filesystem::read_symlink("/proc/self/exe"); }

std::filesystem::path commands() {
  const std::filesystem::path folder = own_program().parent_path();
  const std::filesystem::path installed = std::filesystem::path(data_folder) / "gdb";
  for (const std::filesystem::path& place : {folder / "gdb", folder / "../share/waitpoint/gdb", installed}) {
    const std::filesystem::path script = place / "waitpoint-gdb.py";
    if (std::filesystem::exists(script)) return script.lexically_normal();
  }
  throw BadInput("gdb", "the gdb commands are not installed: expected " + (installed / "waitpoint-gdb.py").string());
}

[[noreturn]] void become_gdb(const DebugOptions& options, const std::vector<std::string>& first,
                             const std::vector<std::string>& program) {
  std::vector<std::string> words = {"gdb", "-q", "-x", commands().string()};
  for (const auto* some : {&first, &options.gdb_options}) words.insert(words.end(), some->begin(), some->end());
  words.push_back("--args");
  words.insert(words.end(), program.begin(), program.end());
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execvp("gdb", arguments.data());
  throw BadInput("gdb", errno == ENOENT ? "gdb is not installed" : std::string("gdb: ") + std::strerror(errno));
}

/// gdb starts the program itself, with the environment of `waitpoint exec`.
[[noreturn]] void debug_program(const DebugOptions& options, const ExecOptions& program) {
  const ProgramFiles files(program.words);
  program.conditions.check(files.named());
  const RunMemory memory(settings_of(program, program.seed));
  std::vector<std::string> words = files.words;
  words.front() = files.program.string();
  const std::string handled = "handle SIGSYS nostop noprint pass";  // raw system calls, which the layer answers
  const std::string wrapper = "set exec-wrapper env" + quoted(environment_of(files, memory));
  become_gdb(options, {"-iex", "set breakpoint pending on", "-ex", handled, "-ex", wrapper}, words);
}

}  // namespace

void declare(Command& command, DebugOptions& options) {
  command.description = "Starts gdb with commands for simulated threads (docs/gdb.md).";
  command.examples = {"-- run office --until 60", "-- ./program"};
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
  become_gdb(options, {}, words);
}

}  // namespace waitpoint::tools
