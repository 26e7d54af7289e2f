// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/linked_libraries.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <sstream>

#include "core/error.hpp"
#include "tools/command/shell_words.hpp"
#include "tools/exec/program_file.hpp"

namespace waitpoint::tools {
namespace {

/// What the command writes to its standard output.
std::string output_of(const std::string& command) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> output(popen(command.c_str(), "re"), pclose);
  std::string text;
  if (output == nullptr) return text;
  std::array<char, 4096> part;
  for (std::size_t got = 0; (got = std::fread(part.data(), 1, part.size(), output.get())) > 0;)
    text.append(part.data(), got);
  return text;
}

[[noreturn]] void refuse_library(const std::string& expected, const std::string& name) {
  throw BadInput("--switch-at", expected + ", found '" + name + "'");
}

bool is_of_layer(const std::filesystem::path& layer, const LinkedLibrary& library) {
  return needs_library(layer, std::filesystem::path(library.name).filename().string());
}

bool is_same_file(const LinkedLibrary& one, const LinkedLibrary& other) {
  std::error_code ignored;
  return std::filesystem::equivalent(one.file, other.file, ignored);
}

// libstdc++ is in each program in C++, which calls it where it makes threads and waits.
bool is_of_user(const std::filesystem::path& layer, const LinkedLibrary& library) {
  return !is_of_layer(layer, library) && !library.name.starts_with("libstdc++.so");
}

bool has_name(const LinkedLibrary& library, const std::string& name) {
  const std::string file = library.file.filename();
  return library.name == name || file == name || std::filesystem::canonical(library.file).filename() == name ||
         library.name.starts_with(name + ".");
}

LinkedLibrary library_named(const std::string& name, const std::vector<LinkedLibrary>& linked,
                            const std::filesystem::path& program) {
  if (name.find('/') != std::string::npos) {
    if (!is_shared_object(name)) refuse_library("expected a shared object for x86-64", name);
    return {std::filesystem::path(name).filename(), name};
  }
  const auto found = std::ranges::find_if(linked, [&](const LinkedLibrary& one) { return has_name(one, name); });
  if (found != linked.end()) return *found;
  std::string names;
  for (const LinkedLibrary& one : linked)
    if (one.name.find('/') == std::string::npos) names += (names.empty() ? "" : ", ") + one.name;
  refuse_library("expected a library of " + program.filename().string() + " (" + names +
                     "), or the path of one that it loads later",
                 name);
}

}  // namespace

// Lines such as "\tlibz.so.1 => /lib/x86_64-linux-gnu/libz.so.1 (0x00007f6a1c8e5000)".
std::vector<LinkedLibrary> linked_libraries(const std::filesystem::path& program) {
  const std::string linker = interpreter_of(program);
  if (linker.empty()) return {};
  std::istringstream lines(output_of(quoted(linker) + " --list " + quoted(program.string()) + " 2>/dev/null"));
  std::vector<LinkedLibrary> linked;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name, arrow, file;
    words >> name >> arrow >> file;
    if (arrow == "=>" && file.starts_with('/')) linked.push_back({name, file});
  }
  return linked;
}

Waits waits_of(const std::filesystem::path& program, const std::filesystem::path& layer) {
  Waits waits{waits_by_futexes(program), waits_by_calls(program), makes_threads(program)};
  for (const LinkedLibrary& library : linked_libraries(program)) {
    if (!is_of_user(layer, library)) continue;
    waits.by_futexes = waits.by_futexes || waits_by_futexes(library.file);
    waits.by_calls = waits.by_calls || waits_by_calls(library.file);
    waits.has_threads = waits.has_threads || makes_threads(library.file);
  }
  return waits;
}

std::vector<LinkedLibrary> watched_libraries(const std::filesystem::path& program, const std::filesystem::path& layer,
                                             const std::vector<std::string>& named) {
  const std::vector<LinkedLibrary> linked = linked_libraries(program);
  std::vector<LinkedLibrary> watched;
  const auto add = [&watched](const LinkedLibrary& library) {
    const bool is_new =
        std::ranges::none_of(watched, [&](const LinkedLibrary& one) { return is_same_file(one, library); });
    if (is_new) watched.push_back(library);
    return is_new;
  };
  for (const std::string& name : named) {
    const LinkedLibrary library = library_named(name, linked, program);
    if (is_of_layer(layer, library))
      refuse_library("expected a library whose calls are not simulated, and that waitpoint does not use itself", name);
    if (!add(library)) refuse_library("expected each library once", name);
  }
  for (const LinkedLibrary& library : linked)
    if (is_of_user(layer, library) && waits_by_futexes(library.file)) (void)add(library);
  return watched;
}

}  // namespace waitpoint::tools
