// SPDX-License-Identifier: BSD-3-Clause
//
// This library's own `new`, which only exploration uses. The names are not exported: the program has its own.
#include <new>

#include "core/error.hpp"
#include "fibers/posix/program/program.hpp"

void* operator new(std::size_t size) {
  void* const memory = waitpoint::posix::record->arena.take(size);
  if (memory == nullptr) waitpoint::posix::refuse("the schedule of this run is too long to be written down");
  return memory;
}

void operator delete(void* memory) noexcept {
  using namespace waitpoint::posix;
  WAITPOINT_CHECK(memory == nullptr || (memory > record && memory < record->arena.top()),
                  "memory is deleted that is not of the record's arena");
  record->arena.give(memory);
}
void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }
