// SPDX-License-Identifier: BSD-3-Clause
//
// The working directory of a program.
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/high_descriptor.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/in_process/loaded_program.hpp"

namespace waitpoint::posix {
namespace {

// `opened` is this function's.
int change_to(int opened) {
  const int directory = move_up(opened);
  if (directory < 0) return -1;
  keep_directory_of_process();
  if (!enter_directory(directory)) {
    WAITPOINT_NEXT(close)(directory);
    return fail(EACCES);
  }
  LoadedProgram& program = this_loaded_program();
  if (program.directory != directory_of_process) WAITPOINT_NEXT(close)(program.directory);
  program.directory = directory;
  return 0;
}

int open_directory(int at, const char* path) {
  return static_cast<int>(WAITPOINT_NEXT(syscall)(SYS_openat, at, path, O_PATH | O_DIRECTORY | O_CLOEXEC, 0));
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int chdir(const char* path) noexcept {
  return runs_in_loaded_program() ? change_to(open_directory(AT_FDCWD, path)) : WAITPOINT_NEXT(chdir)(path);
}
WAITPOINT_INTERPOSED int fchdir(int descriptor) noexcept {
  return runs_in_loaded_program() ? change_to(open_directory(descriptor, ".")) : WAITPOINT_NEXT(fchdir)(descriptor);
}
