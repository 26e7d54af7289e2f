// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/exec/run_memory.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <new>

#include "core/error.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/family/turn.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {
namespace {

void map_file(int descriptor, std::uintptr_t from, std::size_t bytes) {
  void* const memory =
      mmap(reinterpret_cast<void*>(from), bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_NORESERVE | MAP_FIXED,
           descriptor, static_cast<off_t>(from - record_address));
  if (memory == MAP_FAILED) refuse("there is no address space for the record of the run");
}

// A record that nobody else sees.
void make_record() {
  void* const memory = mmap(reinterpret_cast<void*>(record_address), record_bytes, PROT_READ | PROT_WRITE,
                            MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_FIXED, -1, 0);
  if (memory == MAP_FAILED) refuse("there is no address space for the record of a started program");
  const auto& family = *reinterpret_cast<const family::Family*>(family_address);
  record = new (memory) Record();
  record->settings = family.settings;
  record->file = family.file;
}

}  // namespace

void map_record(int descriptor) {
  map_file(descriptor, record_address, run_bytes);
  WAITPOINT_NEXT(close)(descriptor);
  static_assert(record_address % alignof(Record) == 0 && sizeof(Record) <= record_bytes);
  record = reinterpret_cast<Record*>(record_address);
  if (record->mark != Record::mark_of_version)
    refuse("this library and the waitpoint that started it have different versions");
}

int map_run(const char* name) {
  int watcher = 0, descriptor = -1, index = -1;
  if (std::sscanf(name, "%d:%d:%d", &watcher, &descriptor, &index) != 3) {
    map_record(std::atoi(name));
    return -1;
  }
  char path[64];
  std::snprintf(path, sizeof path, "/proc/%d/fd/%d", watcher, descriptor);
  const int file = WAITPOINT_NEXT(open)(path, O_RDWR | O_CLOEXEC);
  if (file < 0) refuse("a started program cannot join the simulation: /proc is not there");
  if (index == 0) {
    map_record(file);
    return index;
  }
  map_file(file, family_address, family_bytes);
  WAITPOINT_NEXT(close)(file);
  make_record();
  return index;
}

void begin_anew() {
  const Settings settings = record->settings;
  const RunFile file = record->file;
  const Arena arena = record->arena;
  // Only the first process's are in its record.
  if (family::is_joined() && family::is_first()) family::keep_digest_of(*family::own, record->robot.digest);
  new (record) Record();
  record->settings = settings;
  record->file = file;
  record->arena = arena;
}

}  // namespace waitpoint::posix
