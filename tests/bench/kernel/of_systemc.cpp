// SPDX-License-Identifier: BSD-3-Clause
// The workloads on SystemC: threads of its kernel, sc_semaphore, sc_mutex, and events instead of condition variables.
//
// Its semaphores have no timeouts: waits with one use an event and a count here.
#define SC_INCLUDE_DYNAMIC_PROCESSES
#include <sys/syscall.h>
#include <unistd.h>

#include <systemc>

#include "tests/bench/kernel/workloads.hpp"

namespace waitpoint::bench {
namespace {

// Above this its guard pages exceed the mappings that a process may have, and the first failure ends the process.
constexpr int guarded_tasks_max = 30'000;
bool guarded = true;

sc_core::sc_time ns(std::int64_t value) {
  return sc_core::sc_time::from_value(static_cast<sc_core::sc_time::value_type>(value));
}

struct Kit {
  static constexpr Clock clock = Clock::processor;

  template <class Body>
  static void spawn(int i, int, Body body) {
    sc_core::sc_spawn_options options;
    options.set_stack_size(0x4000);
    sc_core::sc_spawn(std::move(body), ("task_" + std::to_string(i)).c_str(), &options);
  }
  static void sleep(std::int64_t span_ns) { sc_core::wait(ns(span_ns)); }

  struct Semaphore {
    explicit Semaphore(int units) : of(units) {}
    void acquire() { of.wait(); }
    void release() { of.post(); }
    sc_core::sc_semaphore of;
  };
  struct Signal {
    explicit Signal(int units) : count(units) {}
    void release() {
      ++count;
      event.notify();
    }
    bool acquire_for(std::int64_t span_ns) {
      if (count == 0) sc_core::wait(ns(span_ns), event);
      if (count == 0) return false;
      --count;
      return true;
    }
    int count;
    sc_core::sc_event event;
  };
  using Mutex = sc_core::sc_mutex;
  struct Condition {
    template <class Held>
    void wait(Held& held) {
      held.unlock();
      sc_core::wait(event);
      held.lock();
    }
    void notify() { event.notify(); }
    sc_core::sc_event event;
  };
  using AnyCondition = Condition;
};

void run(const Request& request) {
  guarded = request.tasks <= guarded_tasks_max;
  sc_core::sc_set_time_resolution(1, sc_core::SC_NS);
  sc_core::sc_spawn([&request] {
    if (request.workload == "buffer without mutex")
      buffer<WithoutMutex<Kit>>(request);
    else
      carry_out<Kit>(request);
    answer("guard", guarded ? "guard pages" : "unguarded");
    leave();
  });
  sc_core::sc_start();
}

}  // namespace
}  // namespace waitpoint::bench

// Intercepts the library's guard pages.
extern "C" int mprotect(void* at, size_t size, int protection) noexcept {
  if (!waitpoint::bench::guarded) return 0;
  return static_cast<int>(syscall(SYS_mprotect, at, size, protection));
}

int sc_main(int argc, char** argv) {
  waitpoint::bench::run(waitpoint::bench::parse_request(argc, argv));
  return 0;
}
