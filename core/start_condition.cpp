// SPDX-License-Identifier: BSD-3-Clause
#include "core/start_condition.hpp"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <string_view>
#include <vector>

namespace waitpoint {
namespace {

constexpr std::string_view of_port = "tcp:", of_start = ".started";

// Looks into the system's table of sockets: a connection would disturb the server.
bool is_listening_at(int port, const char* table) {
  constexpr unsigned listening = 0x0A;
  std::FILE* const file = std::fopen(table, "r");
  if (file == nullptr) return false;
  char line[512];
  bool is_found = false;
  while (!is_found && std::fgets(line, sizeof line, file) != nullptr) {
    unsigned local = 0, state = 0;
    if (std::sscanf(line, " %*d: %*[0-9A-Fa-f]:%x %*[0-9A-Fa-f]:%*x %x", &local, &state) == 2)
      is_found = state == listening && local == static_cast<unsigned>(port);
  }
  std::fclose(file);
  return is_found;
}

}  // namespace

bool parse(const std::string& text, StartCondition& condition) {
  if (text.empty()) return false;
  if (text.starts_with(of_port)) {
    condition.kind = StartCondition::Kind::port;
    const char* const begin = text.data() + of_port.size();
    const char* const end = text.data() + text.size();
    const auto [behind, error] = std::from_chars(begin, end, condition.port);
    return error == std::errc() && behind == end && condition.port > 0 && condition.port < 65536;
  }
  condition.of = text;
  if (text.find('/') != std::string::npos) {
    condition.kind = StartCondition::Kind::file;
  } else if (text.ends_with(of_start)) {
    condition.kind = StartCondition::Kind::start;
    condition.of.resize(text.size() - of_start.size());
  }
  return !condition.of.empty();
}

std::size_t first_never_started(std::span<const ConditionedStart> programs) {
  std::vector<bool> can_start(programs.size());
  const auto holds = [&](const StartCondition& condition) {
    if (!condition.is_of_program()) return true;
    for (std::size_t i = 0; i < programs.size(); ++i)
      if (programs[i].name == condition.of) return static_cast<bool>(can_start[i]);
    return false;
  };
  for (bool any = true; any;) {
    any = false;
    for (std::size_t i = 0; i < programs.size(); ++i) {
      if (can_start[i] || !std::all_of(programs[i].after.begin(), programs[i].after.end(), holds)) continue;
      can_start[i] = any = true;
    }
  }
  return static_cast<std::size_t>(std::find(can_start.begin(), can_start.end(), false) - can_start.begin());
}

bool holds_outside(const StartCondition& condition) {
  if (condition.kind == StartCondition::Kind::file) return access(condition.of.c_str(), F_OK) == 0;
  return is_listening_at(condition.port, "/proc/net/tcp") || is_listening_at(condition.port, "/proc/net/tcp6");
}

}  // namespace waitpoint
