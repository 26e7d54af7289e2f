// SPDX-License-Identifier: BSD-3-Clause
//
// Only exploration and the log of races use it. The names are not exported: the program has its own.
#include "fibers/posix/reports/memory.hpp"

#include <new>

#include "core/error.hpp"
#include "fibers/posix/family/family.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {
namespace {

bool in_family = false;

bool is_of_family(const void* memory) {
  return family::family != nullptr && memory > family::family && memory < family::family->arena.top();
}

}  // namespace

NewInFamily::NewInFamily() {
  WAITPOINT_CHECK(!in_family && family::family != nullptr, "memory of the family is asked for within such a request");
  in_family = true;
}
NewInFamily::~NewInFamily() { in_family = false; }

}  // namespace waitpoint::posix

void* operator new(std::size_t size) {
  using namespace waitpoint::posix;
  void* const memory = in_family ? family::take(size) : record->arena.take(size);
  if (memory == nullptr) refuse("the schedule of this run is too long to be written down");
  return memory;
}

void operator delete(void* memory) noexcept {
  using namespace waitpoint::posix;
  if (memory != nullptr && is_of_family(memory)) return family::give(memory);
  WAITPOINT_CHECK(memory == nullptr || (memory > record && memory < record->arena.top()),
                  "memory is deleted that is not of the record's arena");
  record->arena.give(memory);
}
void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }
