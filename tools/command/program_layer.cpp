// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/program_layer.hpp"

#include <sys/personality.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "fibers/posix/host/in_process_host.hpp"
#include "modules/run/robot_program.hpp"
#include "tools/command/installed_part.hpp"

namespace waitpoint::tools {
namespace {

/// Set in the restarted process, to prevent an endless loop of restarts.
constexpr char tried_variable[] = "WAITPOINT_PROGRAM_LAYER";

std::vector<std::string> command_line() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  return words;
}

}  // namespace

void begin_with_program_layer(const scenario::Scenario& scenario) {
  const bool tried = std::getenv(tried_variable) != nullptr;
  unsetenv(tried_variable);
  if (run::has_programs(scenario, Hosting::processes))
    setenv(run::library_variable, find_part("libwaitpoint-exec.so").c_str(), 1);
  if (!run::has_programs(scenario, Hosting::in_process) || posix::InProcessHost::is_possible()) return;
  const std::filesystem::path library = find_part("libwaitpoint-in-process.so");
  if (tried) throw BadInput(library, 0, "the library for robots' programs cannot be loaded into this program");
  setenv(tried_variable, "1", 1);
  const char* const others = std::getenv("LD_PRELOAD");
  setenv("LD_PRELOAD", (others != nullptr ? library.string() + ":" + others : library.string()).c_str(), 1);
  // Programs may order and hash by addresses: equal runs need equal addresses.
  const int persona = personality(0xFFFFFFFF);
  if (persona >= 0) personality(static_cast<unsigned long>(persona) | ADDR_NO_RANDOMIZE);
  std::vector<std::string> words = command_line();
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(std::filesystem::read_symlink("/proc/self/exe").c_str(), pointers.data());
  throw BadInput("waitpoint", std::string("this program cannot be started again: ") + std::strerror(errno));
}

}  // namespace waitpoint::tools
