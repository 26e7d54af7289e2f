// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/process_ticks.hpp"

#include <fstream>
#include <string>

namespace waitpoint::exploration {

std::optional<std::uint64_t> ticks_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(file, text, ')');  // skips the process id and the name, which may contain blanks
  char state = 0;
  file >> state;
  constexpr int fields_between = 10;
  for (int i = 0; i < fields_between; ++i) file >> text;
  std::uint64_t user = 0, system = 0;
  if (!(file >> user >> system) || state == 'T' || state == 't') return std::nullopt;
  return user + system;
}

}  // namespace waitpoint::exploration
