// SPDX-License-Identifier: BSD-3-Clause
// The workloads, written once for all subjects. A Kit provides the primitives of one of them:
//
//   Kit::clock                    the measured time
//   Kit::spawn(i, tasks, body)    task number i; from within a task
//   Kit::sleep(ns)                of virtual time
//   Kit::Semaphore(units)         acquire, release
//   Kit::Signal(units)            a semaphore with acquire_for(ns), false after a timeout
//   Kit::Mutex, Kit::Condition    lock, unlock; wait(mutex), notify
//
// Where tasks hand over to each other at one instant, virtual time advances at intervals, equally in all subjects.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <vector>

#include "tests/bench/kernel/increments.hpp"
#include "tests/bench/kernel/meter.hpp"

namespace waitpoint::bench {

/// Hand-overs, items or locks between two instants.
constexpr int at_one_instant = 256;
constexpr std::int64_t step_ns = 1000;
/// Virtual time with some ten thousand events of the hand-over workloads.
constexpr std::int64_t many_steps_ns = 50 * step_ns;

/// Tasks that sleep and wake up. One step of the measurement has some 20 000 wake-ups.
template <class Kit>
void sleepers(const Request& request) {
  const int n = request.tasks;
  static const Increments increments(request.workload);
  for (int i = 0; i < n; ++i)
    if (is_of_periods(request.workload))
      Kit::spawn(i, n, [period = period_ns(request.workload, i, n)] {
        for (;;) {
          Kit::sleep(period);
          count();
        }
      });
    else
      Kit::spawn(i, n, [i] {
        std::size_t at = 0;
        Kit::sleep(increments.first(i, at));
        for (;;) {
          Kit::sleep(increments.next(at));
          count();
        }
      });
  measure(request, Kit::clock, [stretch = 20'000 * mean_sleep_ns / n] { Kit::sleep(stretch); });
}

/// Pairs that hand over back and forth, each wait with a timeout. One wait of a thousand does time out.
template <class Kit>
void timeouts(const Request& request) {
  constexpr std::int64_t timeout_ns = 100 * step_ns;
  struct Pair {
    typename Kit::Signal there{0}, back{0};
  };
  static std::deque<Pair> pairs(static_cast<std::size_t>(request.tasks / 2));
  for (int i = 0; i + 1 < request.tasks; i += 2) {
    Pair& pair = pairs[static_cast<std::size_t>(i / 2)];
    Kit::spawn(i, request.tasks, [&pair, i] {
      for (std::int64_t round = i;; ++round) {
        for (int k = 0; k < 32; ++k) {
          pair.there.release();
          pair.back.acquire_for(timeout_ns);
          count();
        }
        Kit::sleep(round % 16 == 0 ? 3 * timeout_ns / 2 : step_ns + i);
      }
    });
    Kit::spawn(i + 1, request.tasks, [&pair] {
      for (;;) {
        if (pair.there.acquire_for(timeout_ns)) pair.back.release();
        count();
      }
    });
  }
  // Cancelled timeouts may burden a kernel until they expire: warm up until all have.
  constexpr std::uint64_t round_of_all = 1100;
  measure(
      request, Kit::clock, [stretch = 1 + 300 * many_steps_ns / request.tasks] { Kit::sleep(stretch); }, round_of_all);
}

/// Pairs that hand over to and fro twice at one instant and then sleep for some 30 us, each wait with a timeout between
/// 1 us and 1 ms: most are cancelled.
template <class Kit>
void short_timeouts(const Request& request) {
  struct Pair {
    typename Kit::Signal there{0}, back{0};
  };
  static std::deque<Pair> pairs(static_cast<std::size_t>(request.tasks / 2));
  static const ShortSpans spans;
  for (int i = 0; i + 1 < request.tasks; i += 2) {
    Pair& pair = pairs[static_cast<std::size_t>(i / 2)];
    Kit::spawn(i, request.tasks, [&pair, i] {
      for (auto at = static_cast<std::uint64_t>(i);;) {
        for (int k = 0; k < 2; ++k) {
          pair.there.release();
          pair.back.acquire_for(spans[at++]);
          count();
        }
        Kit::sleep(spans[at++] / 16);
      }
    });
    Kit::spawn(i + 1, request.tasks, [&pair, i] {
      for (auto at = static_cast<std::uint64_t>(i + 1);;) {
        if (!pair.there.acquire_for(spans[at++])) continue;
        pair.back.release();
        count();
      }
    });
  }
  constexpr std::uint64_t round_of_all = 100;  // as above
  measure(
      request, Kit::clock, [stretch = 1 + 30 * many_steps_ns / request.tasks] { Kit::sleep(stretch); }, round_of_all);
}

/// Two tasks that hand over back and forth by semaphores.
template <class Kit>
void handover(const Request& request) {
  static typename Kit::Semaphore there(0), back(0);
  Kit::spawn(0, 2, [] {
    for (;;) {
      for (int k = 0; k < at_one_instant; ++k) {
        there.release();
        back.acquire();
        count(2);
      }
      Kit::sleep(step_ns);
    }
  });
  Kit::spawn(1, 2, [] {
    for (;;) {
      there.acquire();
      back.release();
    }
  });
  measure(request, Kit::clock, [] { Kit::sleep(many_steps_ns); });
}

/// Tasks that contend for a mutex, and sleep while they hold it. Also answers how often the least served task had it,
/// relative to an equal share, and the difference between the most and the least served.
template <class Kit>
void mutex_with_sleep(const Request& request) {
  static typename Kit::Mutex mutex;
  static std::vector<std::uint64_t> served(static_cast<std::size_t>(request.tasks));
  for (int i = 0; i < request.tasks; ++i)
    Kit::spawn(i, request.tasks, [&mine = served[static_cast<std::size_t>(i)]] {
      for (;;) {
        mutex.lock();
        Kit::sleep(step_ns);
        ++mine;
        count();
        mutex.unlock();
      }
    });
  measure(request, Kit::clock, [] { Kit::sleep(10'000 * step_ns); });
  const auto [least, most] = std::minmax_element(served.begin(), served.end());
  answer("served_least", static_cast<double>(*least) * request.tasks / static_cast<double>(events()));
  answer("served_apart", static_cast<double>(*most - *least));
}

/// A producer and a consumer with 16 slots between them, guarded by the mutex and signalled by a condition variable, as
/// in textbooks.
template <class Kit>
void buffer(const Request& request) {
  constexpr int places = 16;
  static typename Kit::Mutex mutex;
  static typename Kit::Condition not_full, not_empty;
  static std::uint32_t items[places];
  static int first = 0, stored = 0;
  Kit::spawn(0, 2, [] {
    for (std::uint32_t item = 1;; ++item) {
      mutex.lock();
      // NOLINTNEXTLINE(bugprone-infinite-loop): the other task changes it, while this one waits
      while (stored == places) not_full.wait(mutex);
      items[(first + stored++) % places] = item;
      not_empty.notify();
      mutex.unlock();
      if (item % at_one_instant == 0) Kit::sleep(step_ns);
    }
  });
  Kit::spawn(1, 2, [] {
    for (std::uint32_t item = 1;; ++item) {
      mutex.lock();
      // NOLINTNEXTLINE(bugprone-infinite-loop): the other task changes it, while this one waits
      while (stored == 0) not_empty.wait(mutex);
      if (items[first] != item) std::abort();
      first = (first + 1) % places;
      --stored;
      count();
      not_full.notify();
      mutex.unlock();
    }
  });
  measure(request, Kit::clock, [] { Kit::sleep(many_steps_ns); });
}

/// A kit whose tasks are never preempted, so that shared data needs no mutex.
template <class Kit>
struct WithoutMutex : Kit {
  struct Mutex {
    void lock() {}
    void unlock() {}
  };
  using Condition = typename Kit::AnyCondition;
};

/// One task that locks and unlocks an uncontended mutex.
template <class Kit>
void free_mutex(const Request& request) {
  static typename Kit::Mutex mutex;
  Kit::spawn(0, 1, [] {
    for (;;) {
      for (int k = 0; k < at_one_instant; ++k) {
        mutex.lock();
        mutex.unlock();
      }
      count(at_one_instant);
      Kit::sleep(step_ns);
    }
  });
  measure(request, Kit::clock, [] { Kit::sleep(many_steps_ns); });
}

/// Resident memory per parked task: on its stack, in its records, in the page tables.
template <class Kit>
void parked(const Request& request) {
  static typename Kit::Semaphore never(0);
  const std::int64_t before = resident_bytes(), tables_before = page_table_bytes();
  for (int i = 0; i < request.tasks; ++i) Kit::spawn(i, request.tasks, [] { never.acquire(); });
  Kit::sleep(step_ns);
  answer("bytes", static_cast<double>(resident_bytes() - before) / request.tasks);
  answer("page_table_bytes", static_cast<double>(page_table_bytes() - tables_before) / request.tasks);
}

/// Runs the requested workload from the first task of a kit that has virtual time and mutexes.
template <class Kit>
void carry_out(const Request& request) {
  const std::string& workload = request.workload;
  if (workload == "timeouts") return timeouts<Kit>(request);
  if (workload == "short timeouts") return short_timeouts<Kit>(request);
  if (workload == "handover") return handover<Kit>(request);
  if (workload == "mutex") return mutex_with_sleep<Kit>(request);
  if (workload == "buffer") return buffer<Kit>(request);
  if (workload == "free mutex") return free_mutex<Kit>(request);
  if (workload == "parked") return parked<Kit>(request);
  if (is_of_sleepers(workload)) return sleepers<Kit>(request);
  decline();
}

}  // namespace waitpoint::bench
