// SPDX-License-Identifier: BSD-3-Clause
//
// Calls that make descriptors, copy them and close them: which of them only this program has.
#include <fcntl.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>

#include "fibers/posix/descriptors.hpp"
#include "fibers/posix/interposed.hpp"
#include "fibers/posix/signal_descriptors.hpp"
#include "fibers/posix/timer_descriptors.hpp"
#include "fibers/posix/waiting.hpp"

using namespace waitpoint;
using namespace waitpoint::posix;

namespace {

int both(int result, const int (&ends)[2]) {
  if (result == 0)
    for (const int end : ends) note_inside(end, true);
  return result;
}

int one(int descriptor) {
  if (descriptor >= 0) note_inside(descriptor, true);
  return descriptor;
}

int copy(int from, int made) {
  if (made >= 0) note_inside(made, is_inside(from));
  return made;
}

}  // namespace

WAITPOINT_INTERPOSED int pipe2(int* ends, int flags) noexcept {
  return both(WAITPOINT_NEXT(pipe2)(ends, flags), *reinterpret_cast<int(*)[2]>(ends));
}
WAITPOINT_INTERPOSED int pipe(int* ends) noexcept { return pipe2(ends, 0); }
WAITPOINT_INTERPOSED int socketpair(int domain, int type, int protocol, int* ends) noexcept {
  return both(WAITPOINT_NEXT(socketpair)(domain, type, protocol, ends), *reinterpret_cast<int(*)[2]>(ends));
}
WAITPOINT_INTERPOSED int socket(int domain, int type, int protocol) noexcept {
  const int made = WAITPOINT_NEXT(socket)(domain, type, protocol);
  note_owner(made);
  return made;
}
WAITPOINT_INTERPOSED int eventfd(unsigned count, int flags) noexcept {
  return one(WAITPOINT_NEXT(eventfd)(count, flags));
}
WAITPOINT_INTERPOSED int dup(int descriptor) noexcept { return copy(descriptor, WAITPOINT_NEXT(dup)(descriptor)); }
WAITPOINT_INTERPOSED int dup2(int from, int to) noexcept { return copy(from, WAITPOINT_NEXT(dup2)(from, to)); }
WAITPOINT_INTERPOSED int dup3(int from, int to, int flags) noexcept {
  return copy(from, WAITPOINT_NEXT(dup3)(from, to, flags));
}

WAITPOINT_INTERPOSED int close(int descriptor) {
  if (!is_simulated()) return WAITPOINT_NEXT(close)(descriptor);
  forget_timer_descriptor(descriptor);
  forget_signal_descriptor(descriptor);
  const int result = WAITPOINT_NEXT(close)(descriptor);
  note_inside(descriptor, false);
  look_at_descriptors();
  return result;
}
