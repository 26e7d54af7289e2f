// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/system_calls.hpp"

#include <dlfcn.h>
#include <linux/futex.h>
#include <poll.h>
#include <pthread.h>
#include <semaphore.h>
#include <sys/select.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "fibers/kernel/call_stack.hpp"
#include "fibers/kernel/fault_reports.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/sync/source_lines.hpp"

namespace waitpoint::sync {
namespace {

constexpr std::size_t calls_max = 16, frames_searched = 24, frames_shown = 4;

struct Call {
  const char* function = nullptr;
  const char* effect = nullptr;  // null: a thread started outside of tasks
  const void* place = nullptr;
  char task[2 * kernel::name_size] = {};
  Time time;
  void* frames[frames_searched] = {};
  std::size_t frame_count = 0;
  bool told = false;
};
// Noted without the heap: the caller may be an allocator, or on a task's small stack.
Call calls[calls_max];
std::size_t call_count = 0, told_count = 0;
bool has_started = false, are_collected = false;

/// The next definition of a function: the C library's, or a sanitizer's. `known` caches it: a guarded static would call
/// some of these functions itself.
template <class Function>
Function* next(Function*& known, const char* name) {
  if (known == nullptr) known = reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
  return known;
}

/// The thread that runs tasks; null: none. Others may use the C library while a task is running.
const void* simulating = nullptr;

bool is_in_task() {
  return kernel::running != nullptr && simulating == __builtin_thread_pointer() &&
         !kernel::running->scheduler->unwinding() && !has_program_layer();
}

void note(const char* function, const char* effect, const void* place) {
  for (std::size_t i = 0; i < call_count; ++i)
    if (calls[i].place == place) return;
  if (call_count == calls_max) return;
  Call& call = calls[call_count++];
  call.function = function;
  call.effect = effect;
  call.place = place;
  call.frame_count = kernel::capture_call_stack(call.frames, frames_searched);
  if (effect == nullptr) return;
  const kernel::Task& task = *kernel::running;
  call.time = task.local_time;
  std::string_view(task.name).copy(call.task, kernel::name_size - 1);
  std::string text = " of ";
  text += task.robot->name;
  text.copy(call.task + std::string_view(call.task).size(), kernel::name_size - 1);
}

constexpr char starts[] = "it runs in real time, and the run is not repeatable";
constexpr char waits[] = "it holds up all tasks of the run in real time";

void note_wait(const char* function, const void* place) {
  if (is_in_task()) note(function, waits, place);
}

/// The text of those calls that were in no text yet.
std::string text_of_new(bool outside) {
  std::vector<ReturnAddresses> stacks;
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < call_count; ++i) {
    Call& call = calls[i];
    if (call.told || (call.effect == nullptr) != outside) continue;
    call.told = true;
    stacks.emplace_back(call.frames, call.frames + call.frame_count);
    lines.push_back(outside ? "a thread of the operating system was started outside of tasks; it is not repeatable"
                            : std::string("task ") + call.task + " calls " + call.function + "() at " +
                                  to_string(call.time) + " s: " + call.effect);
  }
  if (lines.empty()) return "";
  const std::vector<std::vector<std::string>> places = user_source_lines(stacks, frames_shown);
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    text += "waitpoint: warning: ";
    text += lines[i] + "\n";
    for (const std::string& place : places[i]) text += "    at " + place + "\n";
  }
  return text;
}

}  // namespace

SystemCalls::SystemCalls() : outer_(std::exchange(simulating, __builtin_thread_pointer())) {}

SystemCalls::~SystemCalls() {
  simulating = outer_;
  if (call_count == told_count || are_collected) return;
  tell_system_calls();
  told_count = call_count;
}

void tell_system_calls() { std::fputs(text_of_new(false).c_str(), stderr); }
void tell_threads_outside() { std::fputs(text_of_new(true).c_str(), stderr); }
void collect_system_calls() { are_collected = true; }
std::string collected_system_calls() { return text_of_new(false); }
bool has_program_layer() {
  static const bool has = [] {
    Dl_info info{};
    void* const function = dlsym(RTLD_NEXT, "pthread_create");
    return function != nullptr && dladdr(function, &info) != 0 && info.dli_fname != nullptr &&
           std::string_view(info.dli_fname).find("libwaitpoint-guests") != std::string_view::npos;
  }();
  return has;
}

bool has_started_outside_of_virtual_time() { return has_started; }
void forget_started() { has_started = false; }

}  // namespace waitpoint::sync

// The functions themselves. Each is a waitpoint::sync::note() and the next definition of its name.
using namespace waitpoint::sync;  // NOLINT: below are C functions only

#define CALLER __builtin_return_address(0)

extern "C" {

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*), void* argument) {
  static decltype(pthread_create)* known;
  const auto real = next(known, "pthread_create");
  if (is_in_task()) {
    has_started = true;
    note("pthread_create", starts, CALLER);
  } else if (waitpoint::kernel::running == nullptr && !has_program_layer()) {
    note("pthread_create", nullptr, CALLER);
  }
  return real(thread, attributes, start, argument);
}

// fork() by another name, since gdb calls it, and takes its result from the type in the debugging information: line
// tables have none, and for a bare symbol gdb assumes one. The functions that it calls return to an address on
// the stack.
asm(".globl fork\n.type fork, @function\n.set fork, waitpoint_fork");
pid_t waitpoint_fork() {
  static decltype(fork)* known;
  const auto real = next(known, "fork");
  const auto is_checkpoint = [caller = static_cast<const char*>(CALLER)] {
    const auto& stack = waitpoint::kernel::running->fiber.stack;
    return caller >= stack.low && caller < stack.high;
  };
  if (is_in_task() && !is_checkpoint()) {
    has_started = true;
    note("fork", starts, CALLER);
  }
  return real();
}

int nanosleep(const timespec* span, timespec* left) {
  static decltype(nanosleep)* known;
  const auto real = next(known, "nanosleep");
  note_wait("nanosleep", CALLER);
  return real(span, left);
}

int clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec* left) {
  static decltype(clock_nanosleep)* known;
  const auto real = next(known, "clock_nanosleep");
  note_wait("clock_nanosleep", CALLER);
  return real(clock, flags, time, left);
}

int usleep(useconds_t span) {
  static decltype(usleep)* known;
  const auto real = next(known, "usleep");
  note_wait("usleep", CALLER);
  return real(span);
}

unsigned sleep(unsigned seconds) {
  static decltype(sleep)* known;
  const auto real = next(known, "sleep");
  note_wait("sleep", CALLER);
  return real(seconds);
}

int poll(pollfd* descriptors, nfds_t count, int timeout) {
  static decltype(poll)* known;
  const auto real = next(known, "poll");
  if (timeout != 0) note_wait("poll", CALLER);
  return real(descriptors, count, timeout);
}

int select(int count, fd_set* reading, fd_set* writing, fd_set* failing, timeval* timeout) {
  static decltype(select)* known;
  const auto real = next(known, "select");
  if (timeout == nullptr || timeout->tv_sec != 0 || timeout->tv_usec != 0) note_wait("select", CALLER);
  return real(count, reading, writing, failing, timeout);
}

int pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex) {
  static decltype(pthread_cond_wait)* known;
  const auto real = next(known, "pthread_cond_wait");
  note_wait("pthread_cond_wait", CALLER);
  return real(condition, mutex);
}

int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex, const timespec* deadline) {
  static decltype(pthread_cond_timedwait)* known;
  const auto real = next(known, "pthread_cond_timedwait");
  note_wait("pthread_cond_timedwait", CALLER);
  return real(condition, mutex, deadline);
}

int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock,
                           const timespec* deadline) {
  static decltype(pthread_cond_clockwait)* known;
  const auto real = next(known, "pthread_cond_clockwait");
  note_wait("pthread_cond_clockwait", CALLER);
  return real(condition, mutex, clock, deadline);
}

int sem_wait(sem_t* semaphore) {
  static decltype(sem_wait)* known;
  const auto real = next(known, "sem_wait");
  if (is_in_task()) {
    if (sem_trywait(semaphore) == 0) return 0;
    note("sem_wait", waits, CALLER);
  }
  return real(semaphore);
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
  note("pthread_mutex_lock", waits, CALLER);
  return real(mutex);
}

int pthread_rwlock_rdlock(pthread_rwlock_t* lock) {
  static decltype(pthread_rwlock_rdlock)* known;
  const auto real = next(known, "pthread_rwlock_rdlock");
  if (is_in_task()) {
    if (const int result = pthread_rwlock_tryrdlock(lock); result != EBUSY) return result;
    note("pthread_rwlock_rdlock", waits, CALLER);
  }
  return real(lock);
}

int pthread_rwlock_wrlock(pthread_rwlock_t* lock) {
  static decltype(pthread_rwlock_wrlock)* known;
  const auto real = next(known, "pthread_rwlock_wrlock");
  if (is_in_task()) {
    if (const int result = pthread_rwlock_trywrlock(lock); result != EBUSY) return result;
    note("pthread_rwlock_wrlock", waits, CALLER);
  }
  return real(lock);
}

/// std::atomic::wait(), std::counting_semaphore and std::barrier wait by it.
long syscall(long number, ...) {
  static decltype(syscall)* known;
  const auto real = next(known, "syscall");
  long values[6];
  va_list list;
  va_start(list, number);
  for (long& value : values) value = va_arg(list, long);
  va_end(list);
  if (number == SYS_exit_group || number == SYS_exit) waitpoint::kernel::refuse_exit("the system call exit()");
  const long operation = values[1] & FUTEX_CMD_MASK;
  if (number == SYS_futex && (operation == FUTEX_WAIT || operation == FUTEX_WAIT_BITSET)) note_wait("futex", CALLER);
  return real(number, values[0], values[1], values[2], values[3], values[4], values[5]);
}

}  // extern "C"
