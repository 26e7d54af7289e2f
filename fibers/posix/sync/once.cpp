// SPDX-License-Identifier: BSD-3-Clause
//
// pthread_once_t, as glibc's: 0 not done, 2 done, and between them 1. In an exploration C++'s guards of static
// variables are the same, in the upper half of their eight bytes: their first byte, at which compiled code looks
// without a call, stays 0, so that each use of the variable is a call.
#include <pthread.h>
#include <threads.h>

#include <cstdint>

#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/state_calls.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/program/word.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::posix {
namespace {

constexpr int fresh = 0, under_way = 1, done = 2;
static_assert(PTHREAD_ONCE_INIT == fresh);
static_assert(sizeof(pthread_once_t) == sizeof(int) && sizeof(once_flag) == sizeof(int) &&
              alignof(once_flag) == alignof(int));

void end(int* flag, int state) {
  if (!is_simulated()) {
    *flag = state;
    return;
  }
  Word& word = word_at(flag);
  if (kernel::sanitizer::present) kernel::sanitizer::release(&word.object);
  *flag = state;
  pass(kernel::Operation::release, &word.object);
  kernel::wake_all(*kernel::running->scheduler, word.object);
}

// True if the caller is to do what is done once, and then calls end(). What is done stays done: then it is read only.
bool begin(int* flag) {
  while (*flag != done || are_calls_events()) {
    if (is_simulated()) {
      Word& word = word_at(flag);
      pass(*flag == done ? kernel::Operation::load : kernel::Operation::call_once, &word.object);
      if (*flag == done) break;
      if (*flag == under_way) {
        block(word.object, Time::max());
        continue;
      }
    }
    *flag = under_way;
    return true;
  }
  // A thread that finds it done has passed no waitpoint, so the happens-before edge is reported here.
  if (kernel::sanitizer::present && is_simulated()) kernel::sanitizer::acquire(&word_at(flag).object);
  return false;
}

// A function that is left by an exception or a cancellation does not count as called: another thread calls it again.
struct Attempt {
  ~Attempt() { end(flag, completed ? done : fresh); }
  int* flag;
  bool completed = false;
};

int call(int* flag, void (*function)()) {
  if (!begin(flag)) return 0;
  Attempt attempt{flag};
  function();
  attempt.completed = true;
  return 0;
}

int* flag_of(std::uint64_t* guard) { return reinterpret_cast<int*>(guard) + 1; }
char& first_byte(std::uint64_t* guard) { return *reinterpret_cast<char*>(guard); }

bool is_explored() { return is_simulated() && record != nullptr && record->settings.order == kernel::Order::explored; }

/// The functions of C++'s library; null in a program without it, where only the layer's own code has guards.
struct Guards {
  int (*acquire)(std::uint64_t*);
  void (*release)(std::uint64_t*);
  void (*abort)(std::uint64_t*);
};
const Guards& of_library() {
  static constinit Guards known{};
  if (known.acquire == nullptr)
    known = {reinterpret_cast<decltype(known.acquire)>(dlsym(RTLD_NEXT, "__cxa_guard_acquire")),
             reinterpret_cast<decltype(known.release)>(dlsym(RTLD_NEXT, "__cxa_guard_release")),
             reinterpret_cast<decltype(known.abort)>(dlsym(RTLD_NEXT, "__cxa_guard_abort"))};
  return known;
}

bool begin_guard(std::uint64_t* guard) {
  if (first_byte(guard) != 0) return false;
  if (is_explored()) return begin(flag_of(guard));
  return of_library().acquire == nullptr || of_library().acquire(guard) != 0;
}

void end_guard(std::uint64_t* guard, int state, void (*of_library)(std::uint64_t*)) {
  const bool is_ours = *flag_of(guard) == under_way;
  if (!is_ours && of_library != nullptr) return of_library(guard);
  if (is_ours) end(flag_of(guard), state);
  if (state == done && !(is_ours && are_calls_events())) first_byte(guard) = 1;
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int pthread_once(pthread_once_t* once, void (*function)()) { return call(once, function); }
WAITPOINT_INTERPOSED int __pthread_once(pthread_once_t* once, void (*function)()) { return call(once, function); }
WAITPOINT_INTERPOSED void call_once(once_flag* flag, void (*function)()) {
  call(reinterpret_cast<int*>(flag), function);
}

// The runtime for -fsanitize=thread has others, which note the accesses to the guard, and call these where the program
// is not instrumented.
extern "C" {
[[gnu::visibility("hidden")]] bool waitpoint_begin_guard(std::uint64_t* guard) { return begin_guard(guard); }
[[gnu::visibility("hidden")]] void waitpoint_end_guard(std::uint64_t* guard, bool is_made) {
  end_guard(guard, is_made ? done : fresh, is_made ? of_library().release : of_library().abort);
}
}
WAITPOINT_INTERPOSED [[gnu::weak]] int __cxa_guard_acquire(std::uint64_t* guard) { return begin_guard(guard) ? 1 : 0; }
WAITPOINT_INTERPOSED [[gnu::weak]] void __cxa_guard_release(std::uint64_t* guard) { waitpoint_end_guard(guard, true); }
WAITPOINT_INTERPOSED [[gnu::weak]] void __cxa_guard_abort(std::uint64_t* guard) { waitpoint_end_guard(guard, false); }
