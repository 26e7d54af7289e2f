// SPDX-License-Identifier: BSD-3-Clause
#include "tools/debug.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/error.hpp"
#include "tools/data_folder.hpp"
#include "tools/exec/program_file.hpp"

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
  throw BadInput("gdb",
                 "the commands for gdb are not installed: expected " + (installed / "waitpoint-gdb.py").string());
}

}  // namespace

void debug(const DebugOptions& options) {
  if (!options.own && find_program(options.words.front()).empty())
    throw BadInput("gdb", "there is no program '" + options.words.front() + "'");
  std::vector<std::string> words = {"gdb", "-q", "-x", commands().string()};
  words.insert(words.end(), options.gdb_options.begin(), options.gdb_options.end());
  words.push_back("--args");
  if (options.own) words.push_back(own_program().string());
  words.insert(words.end(), options.words.begin(), options.words.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execvp("gdb", arguments.data());
  throw BadInput("gdb", errno == ENOENT ? "gdb is not installed" : std::string("gdb: ") + std::strerror(errno));
}

}  // namespace waitpoint::tools
