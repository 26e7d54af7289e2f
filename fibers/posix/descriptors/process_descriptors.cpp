// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/descriptors/process_descriptors.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
#include <sys/pidfd.h>  // lacks extern "C"
}

#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/program/state_calls.hpp"
#include "fibers/posix/program/thread.hpp"

namespace waitpoint::posix {

// A line of /proc/self/fdinfo has the system's.
pid_t process_of(int descriptor) {
  const ErrorNumberKept kept;
  char path[40], text[512];
  std::snprintf(path, sizeof path, "/proc/self/fdinfo/%d", descriptor);
  const int file = WAITPOINT_NEXT(open)(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return -1;
  const ssize_t size = WAITPOINT_NEXT(read)(file, text, sizeof text - 1);
  WAITPOINT_NEXT(close)(file);
  if (size < 0) return -1;
  text[size] = '\0';
  const char* const line = std::strstr(text, "\nPid:\t");
  if (line == nullptr) return -1;
  const pid_t in_system = std::atoi(line + std::strlen("\nPid:\t"));
  const family::Process* const process = family::find_in_system(in_system);
  return process != nullptr ? process->id : in_system;
}

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

// All processes that it can be of end by events of the family.
WAITPOINT_INTERPOSED int pidfd_open(pid_t id, unsigned flags) noexcept {
  before_call<"pidfd_open">(changing(place::descriptors));
  const family::Process* const process = family::find(id);
  const int made = WAITPOINT_NEXT(pidfd_open)(family::in_system(id), flags);
  if (made >= 0 && process != nullptr) note_inside(made, !process->is_native);
  return made;
}

WAITPOINT_INTERPOSED int pidfd_getfd(int process, int descriptor, unsigned flags) noexcept {
  before_call<"pidfd_getfd">(changing(place::descriptors));
  const int made = WAITPOINT_NEXT(pidfd_getfd)(process, descriptor, flags);
  end_counting_of_all();
  if (made >= 0 && is_simulated()) note_inside(made, process_of(process) == getpid() && is_inside(descriptor));
  return made;
}
