// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/processes/started_programs.hpp"

#include <dlfcn.h>
#include <sys/personality.h>

#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/traps/library_calls.hpp"

namespace waitpoint::posix {
namespace {

constexpr char preload[] = "LD_PRELOAD=";

// The library's own file.
const char* library() {
  Dl_info information{};
  dladdr(reinterpret_cast<const void*>(&library), &information);
  WAITPOINT_CHECK(information.dli_fname != nullptr, "the layer's library has no file");
  return information.dli_fname;
}

bool begins_with(const char* text, const char* with) { return std::strncmp(text, with, std::strlen(with)) == 0; }

}  // namespace

StartEnvironment::StartEnvironment(char* const* given, const family::Process* process) : given_(given) {
  if (!is_simulated() || given == nullptr) return;
  if (process == nullptr) {
    place_at_random();
    return;
  }
  const ErrorNumberKept kept;
  std::size_t count = 0;
  while (given[count] != nullptr) ++count;
  const char* others = "";
  for (std::size_t i = 0; i < count; ++i)
    if (begins_with(given[i], preload)) others = given[i] + std::strlen(preload);
  // A list of pointers, with two more and a null, and behind it the two words.
  const std::size_t list = (count + 3) * sizeof(char*), first = std::strlen(library()) + std::strlen(others) + 16;
  auto* const memory = static_cast<char*>(std::malloc(list + first + 64));
  if (memory == nullptr) return;
  made_ = reinterpret_cast<char**>(memory);
  const int preload_length =
      std::snprintf(memory + list, first, "%s%s%s%s", preload, library(), *others != '\0' ? ":" : "", others);
  // Of one length in every run: the addresses on the stack depend on it.
  const RunFile& file = family::family->file;
  const int record_length = std::snprintf(memory + list + first, 64, "%s=%09d:%05d:%04d", record_variable, file.watcher,
                                          file.descriptor, static_cast<int>(process - family::family->processes));
  WAITPOINT_CHECK(
      preload_length > 0 && static_cast<std::size_t>(preload_length) < first && record_length > 0 && record_length < 64,
      "a started program's variables do not fit into their memory");
  std::size_t at = 0;
  made_[at++] = memory + list;
  made_[at++] = memory + list + first;
  for (std::size_t i = 0; i < count; ++i)
    if (!begins_with(given[i], preload) && !begins_with(given[i], record_variable)) made_[at++] = given[i];
  WAITPOINT_CHECK(at <= count + 2, "a started program has more variables than there is room for");
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
