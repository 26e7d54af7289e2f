// SPDX-License-Identifier: BSD-3-Clause
//
// The end of a process of the family: it leaves the turn to the others when all that its end does has happened.
#include "fibers/posix/processes/process_end.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {
namespace {

void note_status(int status, void*) {
  if (family::own != nullptr) family::own->exit_status = status;
}

// The destructors of this library are called last, since it was initialised first. The C library would only write out
// its streams after them.
[[gnu::destructor]] void end_after_destructors() {
  if (has_host || family::own == nullptr) return;
  std::fflush(nullptr);
  _exit(family::own->exit_status);
}

// The first that is registered is called last.
void end_after_quick_handlers() { _exit(family::own->exit_status); }

}  // namespace

void note_exit_status() {
  on_exit(note_status, nullptr);
  at_quick_exit(end_after_quick_handlers);
}

}  // namespace waitpoint::posix
