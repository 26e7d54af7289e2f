// SPDX-License-Identifier: BSD-3-Clause
// The workloads on waitpoint, by its installed headers alone. The digest is always on.
#include <waitpoint/fibers/sync/simulation.hpp>
#include <waitpoint/fibers/sync/threads.hpp>

#include "tests/bench/kernel/workloads.hpp"

namespace waitpoint::bench {
namespace {

struct Kit {
  static constexpr Clock clock = Clock::processor;

  template <class Body>
  static void spawn(int, int, Body body) {
    thread({"task", kernel::StackSize::small, false}, std::move(body)).detach();
  }
  [[gnu::always_inline]] static void sleep(std::int64_t ns) { this_thread::sleep_for(std::chrono::nanoseconds(ns)); }

  struct Semaphore : counting_semaphore<> {
    using counting_semaphore<>::counting_semaphore;
    [[gnu::always_inline]] bool acquire_for(std::int64_t ns) { return try_acquire_for(std::chrono::nanoseconds(ns)); }
  };
  using Signal = Semaphore;
  using Mutex = mutex;
  struct Condition {
    void wait(Mutex& held) {
      std::unique_lock lock(held, std::adopt_lock);
      variable.wait(lock);
      lock.release();
    }
    void notify() { variable.notify_one(); }
    condition_variable variable;
  };
  struct AnyCondition {
    template <class Held>
    void wait(Held& held) {
      variable.wait(held);
    }
    void notify() { variable.notify_one(); }
    condition_variable_any variable;
  };
};

/// A minimal watch: measures the kernel's call.
struct CountingWatch : kernel::Watch {
  CountingWatch() : Watch{&CountingWatch::take} {}
  static void take(kernel::Watch& watch, const kernel::EventRecord&) { ++static_cast<CountingWatch&>(watch).seen; }
  std::uint64_t seen = 0;
};

void answer_guards(const kernel::Scheduler& scheduler) {
  int pages = 0, tasks = 0;
  for (const kernel::Task* task = kernel::first_task(scheduler); task != nullptr; task = task->next) {
    ++tasks;
    if (task->fiber.stack.guard == kernel::Guard::page) ++pages;
  }
  answer("guard", pages == tasks ? "guard pages" : pages == 0 ? "canaries" : "guard pages, then canaries");
}

void run(const Request& request) {
  Simulation simulation;
  CountingWatch watch;
  if (request.hooks) kernel::set_watch(simulation.scheduler(), &watch);
  simulation.spawn(simulation.environment(), {}, [&] {
    if (request.workload == "buffer without mutex")
      buffer<WithoutMutex<Kit>>(request);
    else
      carry_out<Kit>(request);
    answer_guards(simulation.scheduler());
    answer("resident_gb", 1e-9 * static_cast<double>(resident_bytes() + page_table_bytes()));
    leave();
  });
  simulation.run_before();
}

}  // namespace
}  // namespace waitpoint::bench

int main(int argc, char** argv) { waitpoint::bench::run(waitpoint::bench::parse_request(argc, argv)); }
