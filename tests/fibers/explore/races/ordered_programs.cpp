// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <mutex>
#include <shared_mutex>

#include "fibers/explore/linearizable.hpp"
#include "fibers/io/mailbox.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/barrier.hpp"
#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/condition_variable_any.hpp"
#include "fibers/sync/future.hpp"
#include "fibers/sync/jthread.hpp"
#include "fibers/sync/latch.hpp"
#include "fibers/sync/once.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/shared_mutex.hpp"
#include "fibers/sync/signals.hpp"
#include "fibers/sync/thread.hpp"
#include "fibers/sync/timer.hpp"
#include "tests/fibers/explore/linearizability/models.hpp"
#include "tests/fibers/explore/races/programs.hpp"

namespace waitpoint::races {
namespace {

using namespace std::chrono_literals;

template <class Lock>
void under_one_lock() {
  Lock m;
  int shared = 0;
  const auto count = [&] {
    const std::lock_guard guard(m);
    ++shared;
  };
  thread one(count), two(count);
  one.join();
  two.join();
}
void under_different_locks() {
  mutex m, n;
  int shared = 0;
  const auto count = [&](mutex& lock) {
    const std::lock_guard guard(lock);
    ++shared;
  };
  thread one([&] { count(m); }), two([&] { count(n); });
  one.join();
  two.join();
}
void after_the_unlock() {
  mutex m;
  int shared = 0;
  const auto count = [&] {
    { const std::lock_guard guard(m); }
    ++shared;
  };
  thread one(count), two(count);
  one.join();
  two.join();
}
void readers_and_a_writer() {
  shared_mutex m;
  int shared = 0, seen[2] = {};
  thread first([&] {
    const std::shared_lock guard(m);
    seen[0] = shared;
  });
  thread second([&] {
    const std::shared_lock guard(m);
    seen[1] = shared;
  });
  {
    const std::lock_guard guard(m);
    ++shared;
  }
  first.join();
  second.join();
}
void before_the_making() {
  int shared = 1;
  thread other([&] { ++shared; });
  other.join();
}
void after_the_making() {
  int shared = 1;
  thread other([&] { ++shared; });
  ++shared;
  other.join();
}
void after_the_join() {
  int shared = 1;
  thread other([&] { ++shared; });
  other.join();
  ++shared;
}
void after_a_joined_sibling() {  // the next thread takes over its index
  int shared = 1;
  thread bystander([&] {
    this_thread::sleep_for(1ms);
    ++shared;
  });
  for (int i = 0; i < 4; ++i) thread([] {}).join();
  thread other([&] { ++shared; });
  other.join();
  bystander.join();
}

template <class Condition, bool Locked>
void a_condition() {
  mutex m;
  Condition changed;
  int shared = 0;
  bool ready = false;
  thread other([&] {
    std::unique_lock lock(m);
    while (!ready) changed.wait_for(lock, 2ms);
    ++shared;
  });
  ++shared;
  std::unique_lock lock(m, std::defer_lock);
  if (Locked) lock.lock();
  ready = true;
  if (Locked) lock.unlock();
  changed.notify_one();
  other.join();
}

template <bool Before>
void a_semaphore() {
  counting_semaphore<> given(0);
  int shared = 0;
  thread other([&] {
    given.acquire();
    ++shared;
  });
  if (Before) ++shared;
  given.release();
  if (!Before) ++shared;
  other.join();
}

template <bool Ordered>
void a_timer() {
  counting_semaphore<> fired(0);
  int shared = 0;
  timer beat([&] {
    ++shared;
    fired.release();
  });
  ++shared;
  beat.start_every(Period::every(1ms));
  for (int i = 0; i < 3; ++i) Ordered ? fired.acquire() : this_thread::sleep_for(3ms);
  if (Ordered) beat.stop();
  volatile int seen = shared;
  (void)seen;
}

template <bool Before>
void a_signal() {
  int shared = 0;
  bool handled = false;
  handle_robot_signal(1, [&](int) {
    ++shared;
    handled = true;
  });
  thread other([&] {
    while (!handled) this_thread::sleep_for(1ms);
  });
  if (Before) ++shared;
  send_signal(other, 1);
  if (!Before) ++shared;
  other.join();
}

void an_atomic() {
  atomic<int> flag(0);
  int shared = 0;
  thread other([&] {
    flag.wait(0);
    ++shared;
  });
  ++shared;
  flag.fetch_add(1);
  flag.notify_one();
  other.join();
}
void a_future() {
  promise<int> given;
  int shared = 0;
  thread other([&, result = given.get_future()]() mutable { shared += result.get(); });
  ++shared;
  given.set_value(3);
  other.join();
}
void a_late_future() {
  promise<int*> given;
  thread other([&, result = given.get_future()]() mutable {
    this_thread::sleep_for(1ms);
    ++*result.get();
  });
  int* shared = new int(1);
  given.set_value(shared);
  other.join();
  delete shared;
}
void a_barrier() {
  int shared = 0, seen[2] = {};
  barrier meeting(2, [&]() noexcept { ++shared; });
  const auto meet = [&](int& own) {
    for (int i = 0; i < 3; ++i) {
      meeting.arrive_and_wait();
      own = shared;
      meeting.arrive_and_wait();
    }
  };
  thread one([&] { meet(seen[0]); }), two([&] { meet(seen[1]); });
  one.join();
  two.join();
}
void a_latch() {
  latch begun(1);
  int shared = 0;
  thread other([&] {
    begun.wait();
    ++shared;
  });
  ++shared;
  begun.count_down();
  other.join();
}
void once() {
  once_flag flag;
  int shared = 0, seen[2] = {};
  const auto use = [&](int& own) {
    call_once(flag, [&] { ++shared; });
    own = shared;
  };
  thread one([&] { use(seen[0]); }), two([&] { use(seen[1]); });
  one.join();
  two.join();
}
void asked_to_stop() {
  int shared = 0;
  jthread other([&](stop_token token) {
    while (!token.stop_requested()) this_thread::sleep_for(1ms);
    ++shared;
  });
  ++shared;
  other.request_stop();
  other.join();
}
void a_mailbox() {
  io::mailbox<int> letters(2);
  int shared = 0;
  thread other([&] {
    for (int i = 0; i < 4; ++i) (void)letters.receive();
    ++shared;
  });
  thread sender([&] {
    for (int i = 0; i < 3; ++i) (void)letters.send(i);
  });
  sender.join();
  ++shared;
  (void)letters.send(4);
  other.join();
}

constexpr Program programs[] = {
    {"under_one_mutex", under_one_lock<mutex>, false},
    {"under_one_shared_mutex", under_one_lock<shared_mutex>, false},
    {"under_different_locks", under_different_locks, true},
    {"after_the_unlock", after_the_unlock, true},
    {"readers_and_a_writer", readers_and_a_writer, false},
    {"before_the_making", before_the_making, false},
    {"after_the_making", after_the_making, true},
    {"after_the_join", after_the_join, false},
    {"after_a_joined_sibling", after_a_joined_sibling, true},
    {"a_condition", a_condition<condition_variable, true>, false},
    {"a_condition_without_lock", a_condition<condition_variable, false>, true},
    {"a_condition_any", a_condition<condition_variable_any, true>, false},
    {"before_a_release", a_semaphore<true>, false},
    {"after_a_release", a_semaphore<false>, true},
    {"a_timer", a_timer<true>, false},
    {"a_timer_slept_for", a_timer<false>, true},
    {"before_a_signal", a_signal<true>, false},
    {"after_a_signal", a_signal<false>, true},
    {"an_atomic", an_atomic, false},
    {"a_future", a_future, false},
    {"a_late_future", a_late_future, false},
    {"a_barrier", a_barrier, false},
    {"a_latch", a_latch, false},
    {"once", once, false},
    {"asked_to_stop", asked_to_stop, false},
    {"a_mailbox", a_mailbox, false},
};

}  // namespace

void write_and_read(bool records) {
  atomic<int> value{0};
  History<models::Register> history;
  const auto write = [&](int written) {
    if (records)
      history.record({"write", written}, [&] { value.store(written); });
    else
      value.store(written);
  };
  const auto read = [&] {
    if (records)
      history.record({"read"}, [&] { return value.load(); });
    else
      (void)value.load();
  };
  thread one([&] { write(1), read(); }), two([&] { write(2), read(); });
  one.join();
  two.join();
  check(linearizable(history, models::Register()));
}

std::span<const Program> ordered_programs() { return programs; }

}  // namespace waitpoint::races
