// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/report/source_lines.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string_view>

namespace waitpoint::sync {
namespace {

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

// Frames that implement the primitives say nothing about the user's program. If the file is known it decides: inlined
// user code may carry the name of one of our functions.
bool is_ours(const std::string& line) {
  if (contains(line, "tests/fibers/")) return false;
  const std::size_t place = line.rfind(" at ");
  if (place == std::string::npos)
    return contains(line, "waitpoint::kernel::") || contains(line, "waitpoint::sync::") ||
           contains(line, "waitpoint::races::") || contains(line, "waitpoint::tools::") || line.starts_with("std::");
  for (const char* folder : {"fibers/switch/", "fibers/kernel/", "fibers/clocks/", "fibers/sync/", "fibers/io/",
                             "fibers/laas/", "core/error.", "fibers/explore/races/", "tools/run/"})
    if (line.find(folder, place) != std::string::npos) return true;
  const std::size_t headers = line.find("/include/", place);
  return headers != std::string::npos && line.find("/c++/", headers) != std::string::npos;
}

// A call, and the functions inlined there, innermost first: "function at file:line".
struct Place : CodePlace {
  std::vector<std::string> lines;
};

// Of the C and C++ runtimes: a crash is raised and a thread begins there, which says nothing about the program.
bool is_of_runtime(const Place& place) {
  const std::string_view name = std::string_view(place.module).substr(place.module.rfind('/') + 1);
  for (const std::string_view runtime :
       {"libc.so", "libstdc++.so", "libpthread.so", "libc++.so", "libgcc_s.so", "ld-linux"})
    if (name.starts_with(runtime)) return true;
  return false;
}

// "function at file:line", shortened: a lambda compiled into std::function or a thread's call gets its own name, found
// as the first argument of some template; long names lose their template arguments.
std::string readable(const std::string& line) {
  constexpr std::size_t long_name = 100;
  const std::size_t end = line.rfind(" at ");
  const std::string name = line.substr(0, end);
  const std::string place = end == std::string::npos ? "" : line.substr(end);
  const std::size_t lambda = name.find("{lambda");
  const bool calls = name.starts_with("std::_Function_handler<") || name.starts_with("std::thread::_State_impl<") ||
                     name.starts_with("waitpoint::sync::CallOf<");
  if (calls && lambda != std::string::npos) {
    const std::size_t begin = name.find_last_of("<,", lambda) + 1;
    return name.substr(begin, name.find('}', lambda) + 1 - begin) + place;
  }
  if (name.size() <= long_name) return line;
  std::string kept;
  int depth = 0;
  for (const char letter : name) {
    if (letter == '<' && depth++ == 0) kept += "<...";
    if (letter == '>' && depth > 0) --depth;
    if (depth == 0) kept += letter;
  }
  return kept + place;
}

bool is_entry(const std::string& line) {
  return contains(line, "waitpoint::sync::(anonymous namespace)::run_thread") ||
         contains(line, "waitpoint::kernel::task_main");
}

std::string name_from_symbols(const Place& place) {
  if (place.module.empty()) return "?";
  if (!place.symbol.empty()) return demangled(place.symbol);
  char text[64];
  std::snprintf(text, sizeof text, "+0x%zx", static_cast<std::size_t>(place.offset));
  return place.module + text;
}

constexpr int patience_s = 20;  // it reads all of a program's debugging information

// Looks up all places of one module by one addr2line: most of its time is its start.
void add_lines(const std::vector<Place*>& asked, const std::string& module) {
  if (contains(module, "'")) return;
  std::string command = "timeout " + std::to_string(patience_s) + " addr2line -aCfip -e '" + module + "'";
  for (const Place* place : asked) {
    char text[32];
    std::snprintf(text, sizeof text, " 0x%zx", static_cast<std::size_t>(place->offset));
    command += text;
  }
  FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r");
  if (pipe == nullptr) return;
  std::size_t begun = 0;
  char text[4096];
  while (std::fgets(text, sizeof text, pipe) != nullptr) {
    std::string line = text;
    while (!line.empty() && line.back() == '\n') line.pop_back();
    constexpr std::string_view inlined = " (inlined by) ";
    if (line.starts_with("0x")) {
      ++begun;
      line.erase(0, line.find(": ") + 2);
    } else if (line.starts_with(inlined)) {
      line.erase(0, inlined.size());
    }
    line.erase(std::min(line.find(" (discriminator "), line.size()));  // the compiler's number of a block on one line
    if (begun > 0 && begun <= asked.size() && !contains(line, "??")) asked[begun - 1]->lines.push_back(line);
  }
  pclose(pipe);
}

// The lines of one stack with known places.
std::vector<std::string> lines_of(std::span<const Place> places, const std::string& own_library, bool with_runtime,
                                  std::size_t most) {
  std::vector<std::string> found;
  for (const Place& place : places) {
    if (!place.module.empty() && place.module == own_library) continue;
    if (!with_runtime && is_of_runtime(place)) continue;
    const std::vector<std::string> without = {name_from_symbols(place)};
    for (const std::string& line : place.lines.empty() ? without : place.lines) {
      if (is_entry(line)) return found;
      if (is_ours(line)) continue;
      found.push_back(readable(line));
      if (found.size() == most) return found;
    }
  }
  return found;
}

std::vector<std::string> user_lines(std::span<const Place> places, const std::string& own_library, std::size_t most) {
  std::vector<std::string> found = lines_of(places, own_library, false, most);
  return found.empty() ? lines_of(places, own_library, true, most) : found;
}

}  // namespace

std::vector<std::vector<std::string>> user_source_lines(std::span<const ReturnAddresses> stacks, std::size_t most) {
  std::vector<CodePlaces> places(stacks.size());
  for (std::size_t i = 0; i < stacks.size(); ++i)
    for (void* address : stacks[i]) places[i].push_back(code_place_of(address));
  return user_source_lines(places, most);
}

std::vector<std::vector<std::string>> user_source_lines(std::span<const CodePlaces> stacks, std::size_t most) {
  std::vector<std::vector<Place>> places(stacks.size());
  for (std::size_t i = 0; i < stacks.size(); ++i)
    for (const CodePlace& place : stacks[i]) places[i].push_back({place, {}});
  std::map<std::string, std::vector<Place*>> modules;
  for (std::vector<Place>& stack : places)
    for (Place& place : stack)
      if (!place.module.empty()) modules[place.module].push_back(&place);
  for (const auto& [module, asked] : modules) add_lines(asked, module);
  Dl_info own{};
  const bool known = dladdr(reinterpret_cast<void*>(&is_entry), &own) != 0;
  // If this library is a shared one, all of its frames are ours, also without debugging information.
  const std::string own_library = known && contains(own.dli_fname, ".so") ? own.dli_fname : "";
  std::vector<std::vector<std::string>> lines;
  lines.reserve(places.size());
  for (const std::vector<Place>& stack : places) lines.push_back(user_lines(stack, own_library, most));
  return lines;
}

}  // namespace waitpoint::sync
