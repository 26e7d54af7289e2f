// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/processes/started_programs.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/personality.h>
#include <unistd.h>

#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/traps/library_calls.hpp"

namespace waitpoint::posix {
namespace {

constexpr int out_of_the_way = 512;
constexpr char preload[] = "LD_PRELOAD=";

// A record for another run with the settings of this one; -1 if it cannot be made.
int make_record() {
  const int made = memfd_create("waitpoint-exec", 0);
  if (made < 0) return -1;
  const int moved = WAITPOINT_NEXT(fcntl)(made, F_DUPFD, out_of_the_way);
  const int descriptor = moved >= 0 ? moved : made;
  if (moved >= 0) WAITPOINT_NEXT(close)(made);
  void* memory = MAP_FAILED;
  if (ftruncate(descriptor, record_bytes) == 0)
    memory = mmap(nullptr, sizeof(Record), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  if (memory == MAP_FAILED) {
    WAITPOINT_NEXT(close)(descriptor);
    return -1;
  }
  auto& fresh = *new (memory) Record();
  fresh.settings = record->settings;
  fresh.settings.traced = fresh.settings.instrumented = false;
  fresh.settings.is_started = true;
  munmap(memory, sizeof(Record));
  return descriptor;
}

// The library's own file.
const char* library() {
  Dl_info information{};
  dladdr(reinterpret_cast<const void*>(&library), &information);
  WAITPOINT_CHECK(information.dli_fname != nullptr, "the layer's library has no file");
  return information.dli_fname;
}

bool begins_with(const char* text, const char* with) { return std::strncmp(text, with, std::strlen(with)) == 0; }

}  // namespace

StartEnvironment::StartEnvironment(char* const* given) : given_(given) {
  if (!is_simulated() || given == nullptr) return;
  place_at_random();
  if (!record->settings.simulates_started) return;
  const ErrorNumberKept kept;
  if ((record_ = make_record()) < 0) return;
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
  const int record_length = std::snprintf(memory + list + first, 64, "%s=%d", record_variable, record_);
  WAITPOINT_CHECK(
      preload_length > 0 && static_cast<std::size_t>(preload_length) < first && record_length > 0 && record_length < 64,
      "a started program's variables do not fit into their memory");
  std::size_t at = 0;
  made_[at++] = memory + list;
  made_[at++] = memory + list + first;
  for (std::size_t i = 0; i < count; ++i)
    if (!begins_with(given[i], preload)) made_[at++] = given[i];
  WAITPOINT_CHECK(at <= count + 2, "a started program has more variables than there is room for");
  made_[at] = nullptr;
}

// Started programs inherit the traps of system calls, which depend on the C library's address, but have no handler for
// them, at least not before main(): their C library must be at another address.
void StartEnvironment::place_at_random() {
  if (!are_library_calls_trapped()) return;
  persona_ = personality(0xFFFFFFFF);
  if (persona_ >= 0) personality(static_cast<unsigned long>(persona_) & ~static_cast<unsigned long>(ADDR_NO_RANDOMIZE));
}

StartEnvironment::~StartEnvironment() {
  const ErrorNumberKept kept;
  if (persona_ >= 0) personality(static_cast<unsigned long>(persona_));
  if (record_ >= 0) WAITPOINT_NEXT(close)(record_);
  std::free(made_);
}

}  // namespace waitpoint::posix
