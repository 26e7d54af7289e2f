// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/processes/started_programs.hpp"

#include <dlfcn.h>
#include <sys/personality.h>
#include <unistd.h>

#include <algorithm>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/traps/library_calls.hpp"

namespace waitpoint::posix {
namespace {

// The path of one of the layer's libraries, all in the folder of this one.
class Library {
 public:
  explicit Library(bool instrumented) {
    Dl_info own{};
    dladdr(reinterpret_cast<const void*>(&kind_to_start), &own);
    WAITPOINT_CHECK(own.dli_fname != nullptr, "the layer's library has no file");
    const char* const slash = std::strrchr(own.dli_fname, '/');
    const int length = slash != nullptr ? static_cast<int>(slash - own.dli_fname) : 0;
    std::snprintf(folder_, sizeof folder_, "%.*s", length, own.dli_fname);
    const char* const name = instrumented ? "libwaitpoint-exec-races.so" : "libwaitpoint-exec.so";
    const int size = std::snprintf(path_, sizeof path_, "%s/%s", folder_, name);
    WAITPOINT_CHECK(size < static_cast<int>(sizeof path_), "the path of the layer's library is too long");
  }
  const char* folder() const { return folder_; }
  const char* path() const { return path_; }

 private:
  char folder_[PATH_MAX];
  char path_[PATH_MAX];
};

bool begins_with(const char* text, const char* with) { return std::strncmp(text, with, std::strlen(with)) == 0; }

/// A variable "NAME=FIRST:REST", where the given list has "NAME=REST".
class PathList {
 public:
  PathList(const char* beginning, const char* first, char* const* given) : beginning_(beginning), first_(first) {
    for (; *given != nullptr; ++given)
      if (replaces(*given)) rest_ = *given + std::strlen(beginning);
  }
  bool replaces(const char* variable) const { return begins_with(variable, beginning_); }
  std::size_t size() const { return std::strlen(beginning_) + std::strlen(first_) + std::strlen(rest_) + 2; }
  void write(char* to) const {
    std::snprintf(to, size(), "%s%s%s%s", beginning_, first_, *rest_ != '\0' ? ":" : "", rest_);
  }

 private:
  const char* beginning_;
  const char* first_;
  const char* rest_ = "";
};

}  // namespace

ProgramKind kind_to_start(const char* path) {
  const ProgramKind kind = kind_of(path);
  const ErrorNumberKept kept;
  const bool lacks_runtime = kind == ProgramKind::instrumented && access(Library(true).path(), R_OK) != 0;
  return lacks_runtime ? ProgramKind::native : kind;
}

StartEnvironment::StartEnvironment(char* const* given, const family::Process* process, ProgramKind kind)
    : given_(given) {
  if (!is_simulated() || given == nullptr) return;
  const ErrorNumberKept kept;
  if (process == nullptr)
    place_at_random();
  else
    make(*process, kind == ProgramKind::instrumented);
}

void StartEnvironment::make(const family::Process& process, bool instrumented) {
  const Library library(instrumented);
  const PathList lists[] = {{"LD_PRELOAD=", library.path(), given_}, {"LD_LIBRARY_PATH=", library.folder(), given_}};
  const std::span<const PathList> added(lists, instrumented ? 2 : 1);
  std::size_t count = 0;
  while (given_[count] != nullptr) ++count;
  // A list of pointers, with those added, the record's and a null, and behind it the words.
  constexpr std::size_t record_size = 64;
  const std::size_t most = count + added.size() + 1;
  std::size_t size = (most + 1) * sizeof(char*) + record_size;
  for (const PathList& list : added) size += list.size();
  auto* const memory = static_cast<char*>(std::malloc(size));
  if (memory == nullptr) return;
  made_ = reinterpret_cast<char**>(memory);
  char* words = memory + (most + 1) * sizeof(char*);
  std::size_t at = 0;
  for (const PathList& list : added) {
    list.write(words);
    made_[at++] = words;
    words += list.size();
  }
  // Of one length in every run: the addresses on the stack depend on it.
  const RunFile& file = family::family->file;
  const int length = std::snprintf(words, record_size, "%s=%09d:%05d:%04d", record_variable, file.watcher,
                                   file.descriptor, static_cast<int>(&process - family::family->processes));
  WAITPOINT_CHECK(length > 0 && length < static_cast<int>(record_size),
                  "a started program's variables do not fit into their memory");
  made_[at++] = words;
  const auto is_replaced = [added](const char* variable) {
    return begins_with(variable, record_variable) ||
           std::any_of(added.begin(), added.end(), [=](const PathList& list) { return list.replaces(variable); });
  };
  for (std::size_t i = 0; i < count; ++i)
    if (!is_replaced(given_[i])) made_[at++] = given_[i];
  WAITPOINT_CHECK(at <= most, "a started program has more variables than there is room for");
  made_[at] = nullptr;
}

// Native programs inherit the traps of system calls, which depend on the C library's address, but have no handler for
// them: their C library must be at another address.
void StartEnvironment::place_at_random() {
  if (!are_library_calls_trapped()) return;
  persona_ = personality(0xFFFFFFFF);
  if (persona_ >= 0) personality(static_cast<unsigned long>(persona_) & ~static_cast<unsigned long>(ADDR_NO_RANDOMIZE));
}

StartEnvironment::~StartEnvironment() {
  const ErrorNumberKept kept;
  if (persona_ >= 0) personality(static_cast<unsigned long>(persona_));
  std::free(made_);
}

}  // namespace waitpoint::posix
