// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/files/random_devices.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cstdint>

#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/randomness.hpp"

namespace waitpoint::posix {
namespace {

int descriptor_in(void* cookie) { return static_cast<int>(reinterpret_cast<std::intptr_t>(cookie)); }

ssize_t read_bytes(void*, char* bytes, std::size_t size) {
  fill_with_random(bytes, size);
  return static_cast<ssize_t>(size);
}
ssize_t write_bytes(void* cookie, const char* bytes, std::size_t size) {
  return WAITPOINT_NEXT(write)(descriptor_in(cookie), bytes, size);
}
int close_descriptor(void* cookie) { return WAITPOINT_NEXT(close)(descriptor_in(cookie)); }

}  // namespace

bool gives_random(int descriptor) {
  struct stat of {};
  const ErrorNumberKept kept;
  return WAITPOINT_NEXT(fstat)(descriptor, &of) == 0 && S_ISCHR(of.st_mode) &&
         (of.st_rdev == makedev(1, 8) || of.st_rdev == makedev(1, 9));
}

// The C++ library reads from the descriptor of its streams.
FILE* with_own_bytes(FILE* stream, const char* mode) {
  if (stream == nullptr || !gives_random(fileno(stream))) return stream;
  const int flags = WAITPOINT_NEXT(fcntl)(fileno(stream), F_GETFD);
  const int descriptor =
      WAITPOINT_NEXT(fcntl)(fileno(stream), (flags & FD_CLOEXEC) != 0 ? F_DUPFD_CLOEXEC : F_DUPFD, 0);
  const int original = fileno(stream);
  WAITPOINT_NEXT(fclose)(stream);
  if (descriptor < 0) return nullptr;
  const int moved = WAITPOINT_NEXT(dup3)(descriptor, original, (flags & FD_CLOEXEC) != 0 ? O_CLOEXEC : 0);
  WAITPOINT_NEXT(close)(descriptor);
  if (moved < 0) return nullptr;
  FILE* const own = fopencookie(reinterpret_cast<void*>(static_cast<std::intptr_t>(original)), mode,
                                {read_bytes, write_bytes, nullptr, close_descriptor});
  if (own == nullptr)
    WAITPOINT_NEXT(close)(original);
  else
    own->_fileno = original;
  return own;
}

}  // namespace waitpoint::posix
