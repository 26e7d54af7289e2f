// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/input_output/user_streams.hpp"

#include <limits.h>
#include <linux/magic.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/base/real_waits.hpp"
#include "fibers/posix/descriptors/inside_files.hpp"
#include "fibers/posix/input_output/input_output.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {

// A named pipe may lead to a process of the family.
bool is_user_stream(int descriptor) {
  if ((descriptor != STDOUT_FILENO && descriptor != STDERR_FILENO) || !is_simulated() || has_host) return false;
  if (is_inside(descriptor) || !blocks(descriptor)) return false;
  const ErrorNumberKept kept;
  struct stat of {};
  struct statfs system {};
  if (WAITPOINT_NEXT(fstat)(descriptor, &of) != 0) return false;
  if (S_ISFIFO(of.st_mode)) return fstatfs(descriptor, &system) == 0 && system.f_type == PIPEFS_MAGIC;
  constexpr unsigned memory_devices = 1;  // /dev/null and the like
  return S_ISCHR(of.st_mode) && (major(of.st_rdev) == memory_devices || isatty(descriptor) != 0);
}

ssize_t write_to_user(int descriptor, const char* bytes, std::size_t size) {
  constexpr int patience_ms = 1000;
  std::size_t written = 0;
  do {
    pollfd one{descriptor, POLLOUT, 0};
    {
      const ErrorNumberKept kept;
      const RealWait real;
      if (WAITPOINT_NEXT(poll)(&one, 1, patience_ms) <= 0) break;
    }
    // A pipe that is ready has room for so much.
    const std::size_t piece = std::min<std::size_t>(size - written, PIPE_BUF);
    const ssize_t count = WAITPOINT_NEXT(write)(descriptor, bytes + written, piece);
    if (count < 0) return written > 0 ? static_cast<ssize_t>(written) : -1;
    written += static_cast<std::size_t>(count);
  } while (written < size);
  if (written == 0 && size > 0) errno = EAGAIN;
  return static_cast<ssize_t>(written);
}

}  // namespace waitpoint::posix
