// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/program/working_directory.hpp"

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/high_descriptor.hpp"
#include "fibers/posix/base/interposed.hpp"

namespace waitpoint::posix {
namespace {

int of_process = -1;

}  // namespace

void keep_directory_of_process() {
  if (of_process >= 0) return;
  const long opened = WAITPOINT_NEXT(syscall)(SYS_openat, AT_FDCWD, ".", O_PATH | O_DIRECTORY | O_CLOEXEC, 0);
  of_process = move_up(static_cast<int>(opened));
}

bool enter_directory(int directory) {
  const ErrorNumberKept kept;
  return WAITPOINT_NEXT(syscall)(SYS_fchdir, directory) == 0;
}

void return_to_directory_of_process() {
  const bool has_entered = enter_directory(of_process);
  WAITPOINT_CHECK(has_entered, "the process's working directory was not noted, or cannot be entered any more");
}

}  // namespace waitpoint::posix
