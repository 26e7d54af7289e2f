// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/files/process_paths.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {
namespace {

constexpr char folder[] = "/proc/";
constexpr std::size_t folder_length = sizeof folder - 1;

// The text behind `word`, if that is the first part of `path`; else null.
const char* behind_part(const char* path, const char* word) {
  const std::size_t length = std::strlen(word);
  if (std::strncmp(path, word, length) != 0 || (path[length] != '\0' && path[length] != '/')) return nullptr;
  return path + length;
}

// The number that is the first part of `path`, and the text behind it; 0 if it is none.
long leading_number(const char* path, const char*& behind) {
  if (*path < '1' || *path > '9') return 0;
  char* end = nullptr;
  const long number = std::strtol(path, &end, 10);
  behind = end;
  return (*end == '\0' || *end == '/') && number <= INT_MAX ? number : 0;
}

}  // namespace

bool is_in_proc(const char* path) {
  return path != nullptr && can_be_read(path) && std::strncmp(path, folder, folder_length) == 0;
}

ProcessPath::ProcessPath(const char* path) {
  if (!is_simulated() || family::own == nullptr || std::strncmp(path, folder, folder_length) != 0) return;
  const char* const at = path + folder_length;
  for (const char* const word : {"self", "thread-self"})
    if (const char* const behind = behind_part(at, word); behind != nullptr) {
      process = family::own;
      rest = behind;
    }
  if (const long number = process == nullptr ? leading_number(at, rest) : 0; number != 0) {
    process = family::find(static_cast<pid_t>(number));
    if (process == nullptr && thread_with_id(static_cast<int>(number)) != nullptr) process = family::own;
    is_by_number = true;
  }
  is_own = process != nullptr && process == family::own;
  constexpr char threads[] = "/task/";
  if (process == nullptr || std::strncmp(rest, threads, sizeof threads - 1) != 0) return;
  const char* behind = rest;
  if (leading_number(rest + sizeof threads - 1, behind) == 0) return;
  is_by_number = true;
  rest = behind;
}

PathInSystem::PathInSystem(const char* path) : path_(path) {
  if (!is_simulated() || !is_in_proc(path)) return;
  const ProcessPath found(path);
  if (found.process == nullptr || !found.is_by_number) return;
  const int size = std::snprintf(changed_, sizeof changed_, "%s%d%s", folder,
                                 static_cast<int>(found.process->real_id.load()), found.rest);
  if (size > 0 && static_cast<std::size_t>(size) < sizeof changed_) path_ = changed_;
}

}  // namespace waitpoint::posix
