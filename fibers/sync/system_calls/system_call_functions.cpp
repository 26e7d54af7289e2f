// SPDX-License-Identifier: BSD-3-Clause
//
// In place of the C library's functions that leave virtual time: each is a note (noted_calls.hpp) and the next
// definition of its name.
#include <dlfcn.h>
#include <linux/futex.h>
#include <poll.h>
#include <pthread.h>
#include <semaphore.h>
#include <spawn.h>
#include <sys/epoll.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <threads.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>

#include "core/error.hpp"
#include "fibers/kernel/fault_reports.hpp"
#include "fibers/kernel/handler_stack.hpp"
#include "fibers/kernel/process_end.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/kernel/unfinished_run.hpp"
#include "fibers/sync/system_calls/noted_calls.hpp"
#include "fibers/sync/system_calls/system_calls.hpp"

using namespace waitpoint::sync;  // NOLINT: below are C functions only

namespace {

/// The next definition of a function: the C library's, or a sanitizer's. `known` caches it: a guarded static would call
/// some of these functions itself. Behind the C library, as in a program that loads this library later, there is no
/// next one.
template <class Function>
Function* next(Function*& known, const char* name) {
  if (known == nullptr) known = reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
  if (known == nullptr) known = reinterpret_cast<Function*>(dlsym(dlopen("libc.so.6", RTLD_LAZY | RTLD_NOLOAD), name));
  return known;
}

/// A thread of the operating system in a run: its death is reported, also where its stack is used up.
struct ReportedThread {
  ReportedThread(void* (*function)(void*), void* of) : start(function), argument(of) {}
  static void* run(void* started) {
    const std::unique_ptr<ReportedThread> self(static_cast<ReportedThread*>(started));
    const waitpoint::kernel::HandlerStack stack;
    return self->start(self->argument);
  }

  void* (*start)(void*);
  void* argument;
};

/// True for the thread that runs tasks: where programs of robots are simulated, the call may be theirs.
bool is_of_run(pthread_t thread) {
  return !has_program_layer() && (waitpoint::kernel::in_unfinished_run() || waitpoint::kernel::in_model_code()) &&
         waitpoint::kernel::TaskThread::is_one(thread);
}

/// System calls that send a signal, with their numbers of its argument; the first argument is a process, or a thread of
/// this one.
void note_signal(long number, const long (&values)[6]) {
  const auto process = static_cast<pid_t>(values[0]);
  if (number == SYS_kill || number == SYS_rt_sigqueueinfo)
    waitpoint::kernel::note_signal_to(process, static_cast<int>(values[1]));
  if (number == SYS_tgkill || number == SYS_rt_tgsigqueueinfo)
    waitpoint::kernel::note_signal_to(process, static_cast<int>(values[2]));
  if (number == SYS_tkill) waitpoint::kernel::note_signal_to(getpid(), static_cast<int>(values[1]));
}

}  // namespace

#define CALLER __builtin_return_address(0)
// Types and names of functions.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define WAIT(RESULT, NAME, PARAMETERS, ARGUMENTS) \
  RESULT NAME PARAMETERS {                        \
    static decltype(NAME)* known;                 \
    note_wait(#NAME, CALLER);                     \
    return next(known, #NAME) ARGUMENTS;          \
  }
#define START(RESULT, NAME, PARAMETERS, ARGUMENTS) \
  RESULT NAME PARAMETERS {                         \
    static decltype(NAME)* known;                  \
    note_start(#NAME, CALLER);                     \
    return next(known, #NAME) ARGUMENTS;           \
  }
/// A wait only if TRY, which returns BUSY then, does not succeed at once.
#define LOCK(NAME, TYPE, TRY)             \
  int NAME(TYPE* lock) {                  \
    static decltype(NAME)* known;         \
    if (is_in_task()) {                   \
      const int result = TRY(lock);       \
      if (result != EBUSY) return result; \
      note_wait(#NAME, CALLER);           \
    }                                     \
    return next(known, #NAME)(lock);      \
  }
// NOLINTEND(bugprone-macro-parentheses)

extern "C" {

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*), void* argument) {
  static decltype(pthread_create)* known;
  note_thread(CALLER);
  const auto real = next(known, "pthread_create");
  if (!waitpoint::kernel::in_unfinished_run() || has_program_layer()) return real(thread, attributes, start, argument);
  auto reported = std::make_unique<ReportedThread>(start, argument);
  const int result = real(thread, attributes, ReportedThread::run, reported.get());
  if (result == 0) static_cast<void>(reported.release());
  return result;
}
START(int, thrd_create, (thrd_t * thread, thrd_start_t start, void* argument), (thread, start, argument))
START(int, system, (const char* command), (command))
START(FILE*, popen, (const char* command, const char* mode), (command, mode))
START(int, posix_spawn,
      (pid_t * process, const char* path, const posix_spawn_file_actions_t* actions,
       const posix_spawnattr_t* attributes, char* const* words, char* const* environment),
      (process, path, actions, attributes, words, environment))
START(int, posix_spawnp,
      (pid_t * process, const char* file, const posix_spawn_file_actions_t* actions,
       const posix_spawnattr_t* attributes, char* const* words, char* const* environment),
      (process, file, actions, attributes, words, environment))

// fork() by another name, since gdb calls it, and takes its result from the type in the debugging information: line
// tables have none, and for a bare symbol gdb assumes one. The functions that it calls return to an address on
// the stack. gdb continues a checkpoint as if the function had not been called, so the C library's own is left out
// there: since glibc 2.41 it holds a lock, and blocks all signals, until it returns in the new process.
asm(".globl fork\n.type fork, @function\n.set fork, waitpoint_fork");
pid_t waitpoint_fork() {
  static decltype(fork)* known;
  const auto real = next(known, "fork");
  const auto is_checkpoint = [caller = static_cast<const char*>(CALLER)] {
    const auto& stack = waitpoint::kernel::running->fiber.stack;
    return caller >= stack.low && caller < stack.high;
  };
  if (is_in_task() && is_checkpoint()) return static_cast<pid_t>(syscall(SYS_clone, long{SIGCHLD}, 0L, 0L, 0L, 0L));
  note_start("fork", CALLER);
  return real();
}

/// As fork(), which POSIX allows: a function cannot return twice into its caller.
pid_t vfork() {
  static decltype(fork)* known;
  note_start("vfork", CALLER);
  return next(known, "fork")();
}

WAIT(int, nanosleep, (const timespec* span, timespec* left), (span, left))
WAIT(int, clock_nanosleep, (clockid_t clock, int flags, const timespec* time, timespec* left),
     (clock, flags, time, left))
WAIT(int, usleep, (useconds_t span), (span))
WAIT(unsigned, sleep, (unsigned seconds), (seconds))
WAIT(int, pthread_cond_wait, (pthread_cond_t * condition, pthread_mutex_t* mutex), (condition, mutex))
WAIT(int, pthread_cond_timedwait, (pthread_cond_t * condition, pthread_mutex_t* mutex, const timespec* deadline),
     (condition, mutex, deadline))
WAIT(int, pthread_cond_clockwait,
     (pthread_cond_t * condition, pthread_mutex_t* mutex, clockid_t clock, const timespec* deadline),
     (condition, mutex, clock, deadline))
WAIT(int, pthread_join, (pthread_t thread, void** result), (thread, result))
WAIT(int, pthread_barrier_wait, (pthread_barrier_t * barrier), (barrier))
WAIT(pid_t, wait, (int* status), (status))
WAIT(int, accept, (int socket, sockaddr* address, socklen_t* length), (socket, address, length))

pid_t waitpid(pid_t process, int* status, int options) {
  static decltype(waitpid)* known;
  if ((options & WNOHANG) == 0) note_wait("waitpid", CALLER);
  return next(known, "waitpid")(process, status, options);
}

int poll(pollfd* descriptors, nfds_t count, int timeout) {
  static decltype(poll)* known;
  if (timeout != 0) note_wait("poll", CALLER);
  return next(known, "poll")(descriptors, count, timeout);
}
int ppoll(pollfd* descriptors, nfds_t count, const timespec* timeout, const sigset_t* mask) {
  static decltype(ppoll)* known;
  if (timeout == nullptr || timeout->tv_sec != 0 || timeout->tv_nsec != 0) note_wait("ppoll", CALLER);
  return next(known, "ppoll")(descriptors, count, timeout, mask);
}
int select(int count, fd_set* reading, fd_set* writing, fd_set* failing, timeval* timeout) {
  static decltype(select)* known;
  if (timeout == nullptr || timeout->tv_sec != 0 || timeout->tv_usec != 0) note_wait("select", CALLER);
  return next(known, "select")(count, reading, writing, failing, timeout);
}
int pselect(int count, fd_set* reading, fd_set* writing, fd_set* failing, const timespec* timeout,
            const sigset_t* mask) {
  static decltype(pselect)* known;
  if (timeout == nullptr || timeout->tv_sec != 0 || timeout->tv_nsec != 0) note_wait("pselect", CALLER);
  return next(known, "pselect")(count, reading, writing, failing, timeout, mask);
}
int epoll_wait(int set, epoll_event* events, int most, int timeout) {
  static decltype(epoll_wait)* known;
  if (timeout != 0) note_wait("epoll_wait", CALLER);
  return next(known, "epoll_wait")(set, events, most, timeout);
}

int sem_wait(sem_t* semaphore) {
  static decltype(sem_wait)* known;
  if (is_in_task()) {
    if (sem_trywait(semaphore) == 0) return 0;
    note_wait("sem_wait", CALLER);
  }
  return next(known, "sem_wait")(semaphore);
}
int sem_timedwait(sem_t* semaphore, const timespec* deadline) {
  static decltype(sem_timedwait)* known;
  if (is_in_task()) {
    if (sem_trywait(semaphore) == 0) return 0;
    note_wait("sem_timedwait", CALLER);
  }
  return next(known, "sem_timedwait")(semaphore, deadline);
}
int sem_clockwait(sem_t* semaphore, clockid_t clock, const timespec* deadline) {
  static decltype(sem_clockwait)* known;
  if (is_in_task()) {
    if (sem_trywait(semaphore) == 0) return 0;
    note_wait("sem_clockwait", CALLER);
  }
  return next(known, "sem_clockwait")(semaphore, clock, deadline);
}

int pthread_mutex_timedlock(pthread_mutex_t* mutex, const timespec* deadline) {
  static decltype(pthread_mutex_timedlock)* known;
  if (is_in_task()) {
    if (const int result = pthread_mutex_trylock(mutex); result != EBUSY) return result;
    note_wait("pthread_mutex_timedlock", CALLER);
  }
  return next(known, "pthread_mutex_timedlock")(mutex, deadline);
}
int pthread_mutex_clocklock(pthread_mutex_t* mutex, clockid_t clock, const timespec* deadline) {
  static decltype(pthread_mutex_clocklock)* known;
  if (is_in_task()) {
    if (const int result = pthread_mutex_trylock(mutex); result != EBUSY) return result;
    note_wait("pthread_mutex_clocklock", CALLER);
  }
  return next(known, "pthread_mutex_clocklock")(mutex, clock, deadline);
}

int pthread_mutex_lock(pthread_mutex_t* mutex) {
  static decltype(pthread_mutex_lock)* known;
  const auto real = next(known, "pthread_mutex_lock");
  constexpr int kind_bits = 3;
  // A mutex that checks its owner reports the error itself.
  if (!is_in_task() || (mutex->__data.__kind & kind_bits) == PTHREAD_MUTEX_ERRORCHECK_NP) return real(mutex);
  if (const int result = pthread_mutex_trylock(mutex); result != EBUSY) return result;
  // All tasks run in this thread.
  WAITPOINT_REQUIRE(
      mutex->__data.__owner != gettid(),
      "a task locks a mutex of the system, such as std::mutex, that a task holds already: no task can run");
  note_wait("pthread_mutex_lock", CALLER);
  return real(mutex);
}

/// It would unwind the task's stack to the thread that runs all tasks.
__attribute__((noreturn)) void pthread_exit(void* result) {
  static decltype(pthread_exit)* known;
  WAITPOINT_REQUIRE(!is_in_task(), "a task calls pthread_exit(), which ends the thread that runs all tasks");
  WAITPOINT_REQUIRE(!is_of_run(pthread_self()), "the thread that runs all tasks calls pthread_exit()");
  next(known, "pthread_exit")(result);
  __builtin_unreachable();
}
__attribute__((noreturn)) void thrd_exit(int result) {
  static decltype(thrd_exit)* known;
  WAITPOINT_REQUIRE(!is_in_task(), "a task calls thrd_exit(), which ends the thread that runs all tasks");
  WAITPOINT_REQUIRE(!is_of_run(pthread_self()), "the thread that runs all tasks calls thrd_exit()");
  next(known, "thrd_exit")(result);
  __builtin_unreachable();
}
/// At its next cancellation point, wherever that is.
int pthread_cancel(pthread_t thread) {
  static decltype(pthread_cancel)* known;
  WAITPOINT_REQUIRE(!is_of_run(thread), "pthread_cancel() of the thread that runs all tasks");
  return next(known, "pthread_cancel")(thread);
}

LOCK(pthread_rwlock_rdlock, pthread_rwlock_t, pthread_rwlock_tryrdlock)
LOCK(pthread_rwlock_wrlock, pthread_rwlock_t, pthread_rwlock_trywrlock)

/// std::atomic::wait(), std::counting_semaphore and std::barrier wait by it.
long syscall(long number, ...) {
  static decltype(syscall)* known;
  const auto real = next(known, "syscall");
  long values[6];
  va_list list;
  va_start(list, number);
  for (long& value : values) value = va_arg(list, long);
  va_end(list);
  if (number == SYS_exit_group || (number == SYS_exit && is_of_run(pthread_self())))
    waitpoint::kernel::refuse_exit("the system call exit()");
  if (number == SYS_exit_group) values[0] = waitpoint::kernel::settle_exit_status(static_cast<int>(values[0]));
  note_signal(number, values);
  const long operation = values[1] & FUTEX_CMD_MASK;
  if (number == SYS_futex && (operation == FUTEX_WAIT || operation == FUTEX_WAIT_BITSET)) note_wait("futex", CALLER);
  return real(number, values[0], values[1], values[2], values[3], values[4], values[5]);
}

}  // extern "C"
