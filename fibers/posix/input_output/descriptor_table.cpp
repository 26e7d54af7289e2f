// SPDX-License-Identifier: BSD-3-Clause
//
// Calls that make, duplicate and close descriptors: they note which of them only this program has.
#include "fibers/posix/input_output/descriptor_table.hpp"
#include "fibers/posix/family/processes.hpp"

#include <fcntl.h>
#include <linux/close_range.h>
#include <spawn.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <stdio_ext.h>
#include <cstdarg>
#include <cstdio>

#include "core/error.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/connections.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/descriptors/epoll_watches.hpp"
#include "fibers/posix/descriptors/owners.hpp"
#include "fibers/posix/descriptors/partners.hpp"
#include "fibers/posix/descriptors/signal_descriptors.hpp"
#include "fibers/posix/files/file_records.hpp"
#include "fibers/posix/input_output/file_locks.hpp"
#include "fibers/posix/links/loopback.hpp"
#include "fibers/posix/links/stream_links.hpp"
#include "fibers/posix/program/file_places.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/posix/timers/timer_descriptors.hpp"

using namespace waitpoint;
using namespace waitpoint::posix;

namespace {

int one(int descriptor) {
  if (descriptor >= 0) note_inside(descriptor, true);
  return descriptor;
}

int copy(int from, int made) {
  if (made >= 0)
    note_duplicate(from, made), copy_asked(from, made), note_copy(from, made), note_shared_epoll(from, made);
  return made;
}

void forget(int closed) {
  forget_timer_descriptor(closed);
  forget_signal_descriptor(closed);
  close_stream_over_link(closed);
  forget_watched(closed);
  forget_connection(closed);
  forget_watches_of(closed);
  note_inside(closed, false);
}

// The descriptor `to` was closed.
int replaced(int from, int to, int made) {
  WAITPOINT_CHECK(made < 0 || made == to, "the system has duplicated a descriptor to another number");
  if (made < 0 || from == to || !is_simulated()) return copy(from, made);
  forget(to);
  copy(from, made);
  look_at_descriptors();
  return made;
}

static_assert(sizeof(struct flock) == sizeof(struct flock64), "fcntl() and fcntl64() take the same record");

// A process, or a group as a negative number.
long owner_in_system(const void* argument) {
  const auto owner = static_cast<int>(reinterpret_cast<std::intptr_t>(argument));
  return owner < 0 ? -family::in_system(-owner) : family::in_system(owner);
}
int owner_in_family(int owner) {
  const family::Process* const process = family::find_in_system(owner < 0 ? -owner : owner);
  return process == nullptr ? owner : owner < 0 ? -process->group : process->id;
}

EventFootprint footprint_of(int descriptor, int command) {
  switch (command) {
    case F_DUPFD:
    case F_DUPFD_CLOEXEC:
    case F_SETFD: return changing(place::descriptors);
    case F_GETFD: return reading(place::descriptors);
    case F_GETFL: return reading_at(descriptor);
    case F_GETLK:
    case F_OFD_GETLK: return reading(place::descriptors | place::file_locks);
    case F_SETLK:
    case F_OFD_SETLK: return reading(place::descriptors) | changing(place::file_locks);
    default: return changing_at(descriptor);
  }
}

// The end of a pipe or a connection, and the locks of the process on a file, are gone.
EventFootprint closing(int descriptor) {
  return changing(place::descriptors | place::file_locks | file_at(descriptor));
}

int control(int descriptor, int command, void* argument) {
  if (is_simulated() && (command == F_SETLKW || command == F_OFD_SETLKW) && can_be_read(argument))
    return lock_waiting(descriptor, command, *static_cast<struct flock*>(argument));
  before_call<"fcntl">([&] { return footprint_of(descriptor, command); });
  if (command == F_SETOWN) return WAITPOINT_NEXT(fcntl)(descriptor, command, owner_in_system(argument));
  if (command == F_SETFL || command == F_SETPIPE_SZ) end_counting(descriptor);
  const int result = WAITPOINT_NEXT(fcntl)(descriptor, command, argument);
  if (command == F_GETOWN) return owner_in_family(result);
  return command == F_DUPFD || command == F_DUPFD_CLOEXEC ? copy(descriptor, result) : result;
}

}  // namespace

namespace waitpoint::posix {

void close_descriptors_of(const Program& program) {
  const Program* owner = nullptr;
  for (int descriptor = next_owned(0, owner); descriptor >= 0; descriptor = next_owned(descriptor + 1, owner)) {
    if (owner != &program) continue;
    WAITPOINT_CHECK(owner->is_loaded, "a program that is alone in its process owns a descriptor");
    clear_owner(descriptor);
    forget_timer_descriptor(descriptor);
    forget_signal_descriptor(descriptor);
    close_stream_over_link(descriptor);
    close(descriptor);
  }
}

}  // namespace waitpoint::posix

WAITPOINT_INTERPOSED int pipe2(int* ends, int flags) noexcept {
  before_call<"pipe2">(changing(place::descriptors));
  const int result = WAITPOINT_NEXT(pipe2)(ends, flags);
  if (result == 0) note_pipe(*reinterpret_cast<int(*)[2]>(ends), flags);
  return result;
}
WAITPOINT_INTERPOSED int pipe(int* ends) noexcept { return pipe2(ends, 0); }
WAITPOINT_INTERPOSED int socketpair(int domain, int type, int protocol, int* ends) noexcept {
  before_call<"socketpair">(changing(place::descriptors));
  const int result = WAITPOINT_NEXT(socketpair)(domain, type, protocol, ends);
  if (result == 0)
    for (int i = 0; i < 2; ++i) note_inside(ends[i], true);
  return result;
}
WAITPOINT_INTERPOSED int socket(int domain, int type, int protocol) noexcept {
  before_call<"socket">(changing(place::descriptors));
  const int made = WAITPOINT_NEXT(socket)(domain, type, protocol);
  note_owner(made);
  begin_as_asked(made);
  return made;
}
WAITPOINT_INTERPOSED int eventfd(unsigned count, int flags) noexcept {
  before_call<"eventfd">(changing(place::descriptors));
  return one(WAITPOINT_NEXT(eventfd)(count, flags));
}
// It becomes an outside one if it watches an outside one.
WAITPOINT_INTERPOSED int epoll_create1(int flags) noexcept {
  before_call<"epoll_create1">(changing(place::descriptors));
  return one(WAITPOINT_NEXT(epoll_create1)(flags));
}
WAITPOINT_INTERPOSED int epoll_create(int size) noexcept { return one(WAITPOINT_NEXT(epoll_create)(size)); }
WAITPOINT_INTERPOSED int epoll_ctl(int descriptor, int operation, int watched, epoll_event* event) noexcept {
  before_call<"epoll_ctl">(reading(place::descriptors) | changing(place::channels));
  const int result = WAITPOINT_NEXT(epoll_ctl)(descriptor, operation, watched, event);
  if (result != 0 || !is_simulated()) return result;
  if (operation == EPOLL_CTL_DEL) {
    end_watch(descriptor, watched);
  } else {
    note_watch(descriptor, watched, *event);
    if (!is_inside(watched)) {
      note_inside(descriptor, false);
      note_watched(descriptor, watched);
    }
  }
  note_changed_watches();
  look_at_descriptors();
  return result;
}

WAITPOINT_INTERPOSED int dup(int descriptor) noexcept {
  before_call<"dup">(changing(place::descriptors));
  return copy(descriptor, WAITPOINT_NEXT(dup)(descriptor));
}
WAITPOINT_INTERPOSED int dup2(int from, int to) noexcept {
  before_call<"dup2">(changing(place::descriptors | place::channels | place::file_locks));
  note_closing(from != to ? to : -1);
  return replaced(from, to, WAITPOINT_NEXT(dup2)(from, to));
}
WAITPOINT_INTERPOSED int dup3(int from, int to, int flags) noexcept {
  before_call<"dup3">(changing(place::descriptors | place::channels | place::file_locks));
  note_closing(to);
  return replaced(from, to, WAITPOINT_NEXT(dup3)(from, to, flags));
}
// Duplicates in a program that posix_spawn() starts: the record of its actions is the C library's own.
WAITPOINT_INTERPOSED int posix_spawn_file_actions_adddup2(posix_spawn_file_actions_t* actions, int from,
                                                          int to) noexcept {
  if (is_simulated()) note_passed_on(from);
  return WAITPOINT_NEXT(posix_spawn_file_actions_adddup2)(actions, from, to);
}

extern "C" {
[[gnu::visibility("default")]] int waitpoint_fcntl(int descriptor, int command, ...) __asm__("fcntl");
[[gnu::visibility("default")]] int waitpoint_fcntl64(int descriptor, int command, ...) __asm__("fcntl64");
}
int waitpoint_fcntl(int descriptor, int command, ...) {
  va_list more;
  va_start(more, command);
  void* const argument = va_arg(more, void*);
  va_end(more);
  return control(descriptor, command, argument);
}
int waitpoint_fcntl64(int descriptor, int command, ...) {
  va_list more;
  va_start(more, command);
  void* const argument = va_arg(more, void*);
  va_end(more);
  return control(descriptor, command, argument);
}

extern "C" [[gnu::visibility("default")]] int waitpoint_ioctl(int descriptor, unsigned long request,
                                                              ...) __asm__("ioctl");
int waitpoint_ioctl(int descriptor, unsigned long request, ...) {
  va_list more;
  va_start(more, request);
  void* const argument = va_arg(more, void*);
  va_end(more);
  before_call<"ioctl">([&] { return request == FIONREAD ? reading_at(descriptor) : changing_at(descriptor); });
  if (request == FIONBIO) end_counting(descriptor);
  return WAITPOINT_NEXT(ioctl)(descriptor, request, argument);
}

WAITPOINT_INTERPOSED int close(int descriptor) {
  if (!is_simulated()) return WAITPOINT_NEXT(close)(descriptor);
  pass_cancellation_point();
  before_call<"close">([&] { return closing(descriptor); });
  note_closing(descriptor);
  forget(descriptor);
  const int result = WAITPOINT_NEXT(close)(descriptor);
  look_at_descriptors();
  return result;
}

WAITPOINT_INTERPOSED int close_range(unsigned first, unsigned last, int flags) noexcept {
  before_call<"close_range">(changing(place::descriptors | place::channels | place::file_locks));
  const int result = WAITPOINT_NEXT(close_range)(first, last, flags);
  if (result != 0 || !is_simulated() || (static_cast<unsigned>(flags) & CLOSE_RANGE_CLOEXEC) != 0) return result;
  const auto end = static_cast<unsigned>(known_descriptors_max);
  for (unsigned closed = first; closed <= last && closed < end; ++closed) forget(static_cast<int>(closed));
  look_at_descriptors();
  return result;
}
WAITPOINT_INTERPOSED void closefrom(int first) noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(closefrom)(first);
  close_range(first > 0 ? static_cast<unsigned>(first) : 0, ~0U, 0);
}

WAITPOINT_INTERPOSED int fclose(FILE* stream) {
  if (!is_simulated()) return WAITPOINT_NEXT(fclose)(stream);
  pass_cancellation_point();
  before_call<"fclose">([&] { return closing(fileno_unlocked(stream)) | changing_stream(stream); });
  const int descriptor = fileno(stream);
  if (descriptor >= 0 && __fwriting(stream) != 0) {
    WAITPOINT_NEXT(fflush)(stream);
    note_written(descriptor);
  }
  note_closing(descriptor);
  const int result = WAITPOINT_NEXT(fclose)(stream);
  if (descriptor >= 0) forget(descriptor);
  look_at_descriptors();
  return result;
}
