// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/input_output/fifos.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>

#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/files/file_records.hpp"
#include "fibers/posix/files/process_paths.hpp"
#include "fibers/posix/files/system_files.hpp"
#include "fibers/posix/program/file_places.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {
namespace {

/// A thread that waits for the other side of a pipe: a reader, which has opened it, or a writer, which cannot yet.
struct Opening {
  dev_t device;
  ino_t inode;
  const char* path;
  int folder, flags;
  int descriptor;  // -1: not open yet
  bool is_met;     // of a reader: the pipe was opened for writing
  Opening* next;
};
Opening* first_opening = nullptr;

void remove(const Opening& opening) {
  for (Opening** link = &first_opening; *link != nullptr; link = &(*link)->next)
    if (*link == &opening) {
      *link = opening.next;
      return;
    }
}

int open_at_once(const Opening& opening) {
  return WAITPOINT_NEXT(openat)(opening.folder, opening.path, opening.flags | O_NONBLOCK);
}

// A writer of this process releases the waiting readers; one of another process is noticed by its data.
void meet_readers(const Opening& writer) {
  for (Opening* each = first_opening; each != nullptr; each = each->next)
    if (each != &writer && each->inode == writer.inode && each->device == writer.device) each->is_met = true;
}

bool is_open(const void* what) {
  auto& opening = *static_cast<Opening*>(const_cast<void*>(what));
  const ErrorNumberKept kept;
  if ((opening.flags & O_ACCMODE) == O_RDONLY) {
    pollfd one{opening.descriptor, POLLIN, 0};
    return opening.is_met || WAITPOINT_NEXT(poll)(&one, 1, 0) > 0;
  }
  if (opening.descriptor < 0) opening.descriptor = open_at_once(opening);
  return opening.descriptor >= 0 || errno != ENXIO;
}

}  // namespace

bool is_fifo_to_wait_for(int folder, const char* path, int flags) {
  if (!is_simulated() || (flags & (O_NONBLOCK | O_PATH)) != 0 || (flags & O_ACCMODE) == O_RDWR) return false;
  struct stat of {};
  const ErrorNumberKept kept;
  return WAITPOINT_NEXT(fstatat)(folder, path, &of, 0) == 0 && S_ISFIFO(of.st_mode);
}

int open_fifo(int folder, const char* path, int flags) {
  const CancellationPoint point;
  const AlsoUsing descriptors(changing(place::descriptors));
  pass(kernel::Operation::open, nullptr);
  struct stat of {};
  if (WAITPOINT_NEXT(fstatat)(folder, path, &of, 0) != 0) return -1;
  end_counting_of_inode(of.st_ino);
  Opening opening{of.st_dev, of.st_ino, path, folder, flags, -1, false, first_opening};
  const bool reads = (flags & O_ACCMODE) == O_RDONLY;
  opening.descriptor = open_at_once(opening);
  if (opening.descriptor < 0 && (reads || errno != ENXIO)) return -1;
  // A writer may be waiting for this reader.
  for (const Opening* each = first_opening; each != nullptr && reads; each = each->next)
    if (each->inode == of.st_ino && each->device == of.st_dev && (each->flags & O_ACCMODE) != O_RDONLY)
      opening.is_met = true;
  int result = 1;
  if (reads || opening.descriptor < 0) {
    first_opening = &opening;
    result = wait_outside(is_open, &opening, Restart::if_asked);
    remove(opening);
  }
  if (!reads && opening.descriptor >= 0) meet_readers(opening);
  if (result > 0 && opening.descriptor >= 0) {
    const int mode = WAITPOINT_NEXT(fcntl)(opening.descriptor, F_GETFL);
    WAITPOINT_NEXT(fcntl)(opening.descriptor, F_SETFL, mode & ~O_NONBLOCK);
    return opening.descriptor;
  }
  const ErrorNumberKept kept;
  if (opening.descriptor >= 0) WAITPOINT_NEXT(close)(opening.descriptor);
  if (result == 0) leave_if_cancelled();
  return -1;
}

}  // namespace waitpoint::posix

using namespace waitpoint::posix;

namespace {

// Passed only if the call may create a file.
mode_t mode_of(int flags, va_list more) {
  return (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE ? va_arg(more, mode_t) : 0;
}

int open_at(int folder, const char* path, int flags, va_list more) {
  const mode_t mode = mode_of(flags, more);
  pass_cancellation_point();
  before_call<"open">([&] { return opening(folder, path, flags); });
  note_use_of(path);
  if (is_simulated() && is_in_proc(path)) {
    const int generated = open_generated(path, flags);
    return generated != not_generated ? generated
                                      : WAITPOINT_NEXT(openat)(folder, PathInSystem(path).get(), flags, mode);
  }
  if (is_fifo_to_wait_for(folder, path, flags)) return open_fifo(folder, path, flags);
  const int opened = WAITPOINT_NEXT(openat)(folder, path, flags, mode);
  if (opened >= 0 && (flags & O_ACCMODE) != O_RDONLY) note_opened(opened);
  return opened;
}

}  // namespace

// Under the C library's names: its headers redirect some of them.
extern "C" {
[[gnu::visibility("default")]] int waitpoint_open(const char* path, int flags, ...) __asm__("open");
[[gnu::visibility("default")]] int waitpoint_open64(const char* path, int flags, ...) __asm__("open64");
[[gnu::visibility("default")]] int waitpoint_openat(int folder, const char* path, int flags, ...) __asm__("openat");
[[gnu::visibility("default")]] int waitpoint_openat64(int folder, const char* path, int flags, ...) __asm__("openat64");
}
int waitpoint_open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const int opened = open_at(AT_FDCWD, path, flags, more);
  va_end(more);
  return opened;
}
int waitpoint_open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const int opened = open_at(AT_FDCWD, path, flags, more);
  va_end(more);
  return opened;
}
int waitpoint_openat(int folder, const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const int opened = open_at(folder, path, flags, more);
  va_end(more);
  return opened;
}
int waitpoint_openat64(int folder, const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const int opened = open_at(folder, path, flags, more);
  va_end(more);
  return opened;
}
