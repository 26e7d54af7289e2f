// SPDX-License-Identifier: BSD-3-Clause
//
// Calls on files that wait for nothing simulated, but are cancellation points.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/uio.h>
#include <termios.h>
#include <unistd.h>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/input_output/input_output.hpp"
#include "fibers/posix/program/file_places.hpp"
#include "fibers/posix/signals/cancellation.hpp"

using namespace waitpoint::posix;

// Under the C library's names: its headers redirect those without a size to the others.
static_assert(sizeof(off_t) == sizeof(off64_t), "both names of a call take the same offsets");
#define WAITPOINT_SAME_AS(name) extern "C" [[gnu::visibility("default"), gnu::alias(#name)]]

WAITPOINT_INTERPOSED ssize_t pread64(int descriptor, void* bytes, std::size_t size, off64_t at) {
  before_call<"pread">([&] { return reading_at(descriptor); });
  return at_cancellation_point([&] { return WAITPOINT_NEXT(pread64)(descriptor, bytes, size, at); });
}
WAITPOINT_SAME_AS(pread64) ssize_t waitpoint_pread(int, void*, std::size_t, off64_t) __asm__("pread");

WAITPOINT_INTERPOSED ssize_t pwrite64(int descriptor, const void* bytes, std::size_t size, off64_t at) {
  before_call<"pwrite">([&] { return changing_at(descriptor); });
  return at_cancellation_point([&] { return WAITPOINT_NEXT(pwrite64)(descriptor, bytes, size, at); });
}
WAITPOINT_SAME_AS(pwrite64) ssize_t waitpoint_pwrite(int, const void*, std::size_t, off64_t) __asm__("pwrite");

WAITPOINT_INTERPOSED ssize_t preadv64(int descriptor, const iovec* pieces, int count, off64_t at) {
  before_call<"preadv">([&] { return reading_at(descriptor); });
  return at_cancellation_point([&] { return WAITPOINT_NEXT(preadv64)(descriptor, pieces, count, at); });
}
WAITPOINT_SAME_AS(preadv64) ssize_t waitpoint_preadv(int, const iovec*, int, off64_t) __asm__("preadv");

WAITPOINT_INTERPOSED ssize_t pwritev64(int descriptor, const iovec* pieces, int count, off64_t at) {
  before_call<"pwritev">([&] { return changing_at(descriptor); });
  return at_cancellation_point([&] { return WAITPOINT_NEXT(pwritev64)(descriptor, pieces, count, at); });
}
WAITPOINT_SAME_AS(pwritev64) ssize_t waitpoint_pwritev(int, const iovec*, int, off64_t) __asm__("pwritev");

// An offset of -1 is the file's position: then pipes and sockets are possible, too.
WAITPOINT_INTERPOSED ssize_t preadv64v2(int descriptor, const iovec* pieces, int count, off64_t at, int flags) {
  const bool may_block = at == -1 && (flags & RWF_NOWAIT) == 0;
  end_counting(descriptor);
  return receive(descriptor, may_block,
                 [&] { return WAITPOINT_NEXT(preadv64v2)(descriptor, pieces, count, at, flags); });
}
WAITPOINT_SAME_AS(preadv64v2) ssize_t waitpoint_preadv2(int, const iovec*, int, off64_t, int) __asm__("preadv2");

WAITPOINT_INTERPOSED ssize_t pwritev64v2(int descriptor, const iovec* pieces, int count, off64_t at, int flags) {
  if (at == -1 && flags == 0) return writev(descriptor, pieces, count);
  end_counting(descriptor);
  return send_all_at_once(descriptor, at == -1 && (flags & RWF_NOWAIT) == 0,
                          [&] { return WAITPOINT_NEXT(pwritev64v2)(descriptor, pieces, count, at, flags); });
}
WAITPOINT_SAME_AS(pwritev64v2) ssize_t waitpoint_pwritev2(int, const iovec*, int, off64_t, int) __asm__("pwritev2");

WAITPOINT_INTERPOSED int fsync(int descriptor) {
  return at_cancellation_point([&] { return WAITPOINT_NEXT(fsync)(descriptor); });
}
WAITPOINT_INTERPOSED int fdatasync(int descriptor) {
  return at_cancellation_point([&] { return WAITPOINT_NEXT(fdatasync)(descriptor); });
}
WAITPOINT_INTERPOSED int sync_file_range(int descriptor, off64_t at, off64_t size, unsigned flags) {
  return at_cancellation_point([&] { return WAITPOINT_NEXT(sync_file_range)(descriptor, at, size, flags); });
}
WAITPOINT_INTERPOSED int fallocate64(int descriptor, int mode, off64_t at, off64_t size) {
  before_call<"fallocate">([&] { return changing_at(descriptor); });
  return at_cancellation_point([&] { return WAITPOINT_NEXT(fallocate64)(descriptor, mode, at, size); });
}
WAITPOINT_SAME_AS(fallocate64) int waitpoint_fallocate(int, int, off64_t, off64_t) __asm__("fallocate");
WAITPOINT_INTERPOSED int msync(void* memory, std::size_t size, int flags) {
  return at_cancellation_point([&] { return WAITPOINT_NEXT(msync)(memory, size, flags); });
}
WAITPOINT_INTERPOSED int tcdrain(int descriptor) {
  return at_cancellation_point([&] { return WAITPOINT_NEXT(tcdrain)(descriptor); });
}

WAITPOINT_INTERPOSED int creat64(const char* path, mode_t mode) {
  return open(path, O_WRONLY | O_CREAT | O_TRUNC, mode);
}
WAITPOINT_SAME_AS(creat64) [[gnu::nonnull(1)]] int waitpoint_creat(const char*, mode_t) __asm__("creat");
