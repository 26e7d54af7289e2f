// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/program_layer.hpp"

#include <sys/personality.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "fibers/posix/host/in_process_host.hpp"
#include "modules/run/robot_program.hpp"
#include "tools/command/installed_part.hpp"
#include "tools/command/own_command_line.hpp"

namespace waitpoint::tools {
void begin_with_program_layer(const scenario::Scenario& scenario) {
  const bool tried = std::getenv(layer_variable) != nullptr;  // against an endless loop of restarts
  unsetenv(layer_variable);
  if (run::has_programs(scenario, Hosting::processes))
    setenv(run::library_variable, find_part("libwaitpoint-exec.so").c_str(), 1);
  if (!run::has_programs(scenario, Hosting::in_process) || posix::InProcessHost::is_possible()) return;
  const std::filesystem::path library = find_part("libwaitpoint-in-process.so");
  if (tried) throw BadInput(library, 0, "the library for robots' programs cannot be loaded into this program");
  setenv(layer_variable, "1", 1);
  const char* const others = std::getenv("LD_PRELOAD");
  setenv("LD_PRELOAD", (others != nullptr ? library.string() + ":" + others : library.string()).c_str(), 1);
  // Programs may order and hash by addresses: equal runs need equal addresses.
  const int persona = personality(0xFFFFFFFF);
  if (persona >= 0) personality(static_cast<unsigned long>(persona) | ADDR_NO_RANDOMIZE);
  const std::vector<std::string> words = own_command_line();
  execv(std::filesystem::read_symlink("/proc/self/exe").c_str(), pointers(words).data());
  throw BadInput("waitpoint", std::string("this program cannot be started again: ") + std::strerror(errno));
}

}  // namespace waitpoint::tools
