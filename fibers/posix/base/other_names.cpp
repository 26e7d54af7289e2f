// SPDX-License-Identifier: BSD-3-Clause
//
// Aliases of simulated calls: those emitted by the compiler for _FORTIFY_SOURCE, where it knows the size of a buffer,
// and those used within the C library and by older programs.
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <sched.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "fibers/posix/base/interposed.hpp"

extern "C" [[noreturn]] void __chk_fail();  // of the C library: reports the overflow and aborts

namespace {

void check_room(std::size_t needed, std::size_t room) {
  if (needed > room) __chk_fail();
}

}  // namespace

WAITPOINT_INTERPOSED ssize_t __read_chk(int descriptor, void* bytes, std::size_t size, std::size_t room) {
  check_room(size, room);
  return read(descriptor, bytes, size);
}
WAITPOINT_INTERPOSED ssize_t __pread64_chk(int descriptor, void* bytes, std::size_t size, off64_t at,
                                           std::size_t room) {
  check_room(size, room);
  return pread64(descriptor, bytes, size, at);
}
WAITPOINT_INTERPOSED ssize_t __pread_chk(int descriptor, void* bytes, std::size_t size, off64_t at, std::size_t room) {
  return __pread64_chk(descriptor, bytes, size, at, room);
}
WAITPOINT_INTERPOSED ssize_t __recv_chk(int descriptor, void* bytes, std::size_t size, std::size_t room, int flags) {
  check_room(size, room);
  return recv(descriptor, bytes, size, flags);
}
WAITPOINT_INTERPOSED ssize_t __recvfrom_chk(int descriptor, void* bytes, std::size_t size, std::size_t room, int flags,
                                            sockaddr* from, socklen_t* from_size) {
  check_room(size, room);
  return recvfrom(descriptor, bytes, size, flags, from, from_size);
}
WAITPOINT_INTERPOSED int __poll_chk(pollfd* descriptors, nfds_t count, int timeout_ms, std::size_t room) {
  check_room(count, room / sizeof *descriptors);
  return poll(descriptors, count, timeout_ms);
}
WAITPOINT_INTERPOSED int __ppoll_chk(pollfd* descriptors, nfds_t count, const timespec* timeout, const sigset_t* mask,
                                     std::size_t room) {
  check_room(count, room / sizeof *descriptors);
  return ppoll(descriptors, count, timeout, mask);
}
WAITPOINT_INTERPOSED int __open_2(const char* path, int flags) { return open(path, flags); }
WAITPOINT_INTERPOSED int __open64_2(const char* path, int flags) { return open(path, flags); }
WAITPOINT_INTERPOSED int __openat_2(int folder, const char* path, int flags) { return openat(folder, path, flags); }
WAITPOINT_INTERPOSED int __openat64_2(int folder, const char* path, int flags) { return openat(folder, path, flags); }

WAITPOINT_INTERPOSED ssize_t __read(int descriptor, void* bytes, std::size_t size) {
  return read(descriptor, bytes, size);
}
WAITPOINT_INTERPOSED ssize_t __write(int descriptor, const void* bytes, std::size_t size) {
  return write(descriptor, bytes, size);
}
WAITPOINT_INTERPOSED int __close(int descriptor) { return close(descriptor); }
WAITPOINT_INTERPOSED int __pipe(int* ends) { return pipe(ends); }
WAITPOINT_INTERPOSED int __dup2(int from, int to) { return dup2(from, to); }
WAITPOINT_INTERPOSED int __poll(pollfd* descriptors, nfds_t count, int timeout_ms) {
  return poll(descriptors, count, timeout_ms);
}
WAITPOINT_INTERPOSED int __select(int count, fd_set* readable, fd_set* writable, fd_set* urgent, timeval* timeout) {
  return select(count, readable, writable, urgent, timeout);
}
WAITPOINT_INTERPOSED int __connect(int descriptor, const sockaddr* to, socklen_t size) {
  return connect(descriptor, to, size);
}
WAITPOINT_INTERPOSED ssize_t __send(int descriptor, const void* bytes, std::size_t size, int flags) {
  return send(descriptor, bytes, size, flags);
}
WAITPOINT_INTERPOSED int __nanosleep(const timespec* time, timespec* remaining) { return nanosleep(time, remaining); }
WAITPOINT_INTERPOSED int __sched_yield() { return sched_yield(); }
// The header redirects pthread_yield() to sched_yield(), so this name must be given to the assembler.
extern "C" [[gnu::visibility("default"), gnu::alias("__sched_yield")]] int waitpoint_pthread_yield() __asm__(
    "pthread_yield");
WAITPOINT_INTERPOSED int __sigsuspend(const sigset_t* set) { return sigsuspend(set); }
WAITPOINT_INTERPOSED pid_t __fork() { return fork(); }
WAITPOINT_INTERPOSED pid_t __wait(int* status) { return wait(status); }
WAITPOINT_INTERPOSED pid_t __waitpid(pid_t pid, int* status, int options) { return waitpid(pid, status, options); }

WAITPOINT_INTERPOSED int __pthread_mutex_init(pthread_mutex_t* mutex, const pthread_mutexattr_t* attributes) {
  return pthread_mutex_init(mutex, attributes);
}
WAITPOINT_INTERPOSED int __pthread_mutex_destroy(pthread_mutex_t* mutex) { return pthread_mutex_destroy(mutex); }
WAITPOINT_INTERPOSED int __pthread_mutex_lock(pthread_mutex_t* mutex) { return pthread_mutex_lock(mutex); }
WAITPOINT_INTERPOSED int __pthread_mutex_trylock(pthread_mutex_t* mutex) { return pthread_mutex_trylock(mutex); }
WAITPOINT_INTERPOSED int __pthread_mutex_unlock(pthread_mutex_t* mutex) { return pthread_mutex_unlock(mutex); }
WAITPOINT_INTERPOSED int __pthread_rwlock_init(pthread_rwlock_t* lock, const pthread_rwlockattr_t* attributes) {
  return pthread_rwlock_init(lock, attributes);
}
WAITPOINT_INTERPOSED int __pthread_rwlock_destroy(pthread_rwlock_t* lock) { return pthread_rwlock_destroy(lock); }
WAITPOINT_INTERPOSED int __pthread_rwlock_rdlock(pthread_rwlock_t* lock) { return pthread_rwlock_rdlock(lock); }
WAITPOINT_INTERPOSED int __pthread_rwlock_wrlock(pthread_rwlock_t* lock) { return pthread_rwlock_wrlock(lock); }
WAITPOINT_INTERPOSED int __pthread_rwlock_tryrdlock(pthread_rwlock_t* lock) { return pthread_rwlock_tryrdlock(lock); }
WAITPOINT_INTERPOSED int __pthread_rwlock_trywrlock(pthread_rwlock_t* lock) { return pthread_rwlock_trywrlock(lock); }
WAITPOINT_INTERPOSED int __pthread_rwlock_unlock(pthread_rwlock_t* lock) { return pthread_rwlock_unlock(lock); }
