// SPDX-License-Identifier: BSD-3-Clause
// The workloads on Cimba, where the option `cimba` has the prefix of its installation: processes, timers, its resource
// as mutex, its buffer as bounded buffer. Virtual time is a double; its unit is a nanosecond here.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>

#include "tests/bench/kernel/workloads.hpp"

// The part of its interface that is used (version 3): its headers are C's alone.
extern "C" {
struct cmb_process;
struct cmb_resource;
struct cmb_buffer;
using cmb_process_func = void*(cmb_process*, void*);
void cmb_logger_flags_off(std::uint32_t flags);
void cmb_event_queue_initialize(double start);
void cmb_event_queue_execute();
cmb_process* cmb_process_create();
void cmb_process_initialize_wssz(cmb_process*, const char* name, cmb_process_func*, void* context,
                                 std::int64_t priority, std::size_t stack);
void cmb_process_start(cmb_process*);
std::int64_t cmb_process_hold(double span);
void cmb_process_resume(cmb_process*, std::int64_t signal);
std::uint64_t cmb_process_timer_add(cmb_process*, double span, std::int64_t signal);
bool cmb_process_timer_cancel(cmb_process*, std::uint64_t timer);
cmb_process* cmi_coroutine_current();  // a process begins with its coroutine
void* cmi_coroutine_yield(void*);
cmb_resource* cmb_resource_create();
void cmb_resource_initialize(cmb_resource*, const char* name);
std::int64_t cmb_resource_acquire(cmb_resource*);
void cmb_resource_release(cmb_resource*);
cmb_buffer* cmb_buffer_create();
void cmb_buffer_initialize(cmb_buffer*, const char* name, std::uint64_t capacity);
std::int64_t cmb_buffer_put(cmb_buffer*, std::uint64_t* amount);
std::int64_t cmb_buffer_get(cmb_buffer*, std::uint64_t* amount);
}

namespace waitpoint::bench {
namespace {

constexpr std::size_t stack_size = 0x4000;
constexpr std::int64_t succeeded = 0, timed_out = -5;
constexpr std::uint32_t infos = 0x10000000;

void* run_body(cmb_process*, void* body) {
  (*static_cast<std::function<void()>*>(body))();
  return nullptr;
}

struct Kit {
  static constexpr Clock clock = Clock::processor;

  template <class Body>
  static void spawn(int, int, Body body) {
    cmb_process* const process = cmb_process_create();
    cmb_process_initialize_wssz(process, "task", run_body, new std::function<void()>(std::move(body)), 0, stack_size);
    cmb_process_start(process);
  }
  static void sleep(std::int64_t span_ns) { cmb_process_hold(static_cast<double>(span_ns)); }

  // A unit is handed to the first waiter.
  struct Signal {
    explicit Signal(int units) : count(units) {}
    void release() {
      if (waiters.empty()) {
        ++count;
        return;
      }
      cmb_process_resume(waiters.front(), succeeded);
      waiters.pop_front();
    }
    bool take() {
      if (count == 0) return false;
      --count;
      return true;
    }
    void acquire() {
      if (take()) return;
      waiters.push_back(cmi_coroutine_current());
      cmi_coroutine_yield(nullptr);
    }
    bool acquire_for(std::int64_t span_ns) {
      if (take()) return true;
      cmb_process* const own = cmi_coroutine_current();
      waiters.push_back(own);
      const std::uint64_t timer = cmb_process_timer_add(own, static_cast<double>(span_ns), timed_out);
      if (reinterpret_cast<std::int64_t>(cmi_coroutine_yield(nullptr)) == timed_out) {
        waiters.erase(std::find(waiters.begin(), waiters.end(), own));
        return false;
      }
      cmb_process_timer_cancel(own, timer);
      return true;
    }
    int count;
    std::deque<cmb_process*> waiters;
  };
  using Semaphore = Signal;

  struct Mutex {
    Mutex() : of(cmb_resource_create()) { cmb_resource_initialize(of, "mutex"); }
    void lock() { cmb_resource_acquire(of); }
    void unlock() { cmb_resource_release(of); }
    cmb_resource* of;
  };
  struct Condition {
    template <class Held>
    void wait(Held& held) {
      held.unlock();
      waiting.acquire();
      held.lock();
    }
    void notify() {
      if (!waiting.waiters.empty()) waiting.release();
    }
    Signal waiting{0};
  };
  using AnyCondition = Condition;
};

// The library's own buffer, in which items are amounts.
void own_buffer(const Request& request) {
  static cmb_buffer* const places = cmb_buffer_create();
  cmb_buffer_initialize(places, "places", 16);
  Kit::spawn(0, 2, [] {
    for (std::uint32_t item = 1;; ++item) {
      std::uint64_t amount = 1;
      cmb_buffer_put(places, &amount);
      if (item % at_one_instant == 0) Kit::sleep(step_ns);
    }
  });
  Kit::spawn(1, 2, [] {
    for (;;) {
      std::uint64_t amount = 1;
      cmb_buffer_get(places, &amount);
      count();
    }
  });
  measure(request, Kit::clock, [] { Kit::sleep(many_steps_ns); });
}

void run(const Request& request) {
  cmb_logger_flags_off(infos);
  cmb_event_queue_initialize(0);
  Kit::spawn(0, 1, [&request] {
    if (request.workload == "buffer without mutex")
      own_buffer(request);
    else
      carry_out<Kit>(request);
    leave();
  });
  cmb_event_queue_execute();
}

}  // namespace
}  // namespace waitpoint::bench

int main(int argc, char** argv) { waitpoint::bench::run(waitpoint::bench::parse_request(argc, argv)); }
