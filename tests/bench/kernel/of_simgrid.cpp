// SPDX-License-Identifier: BSD-3-Clause
// The workloads on SimGrid: actors of one host, its semaphores, mutexes and condition variables.
#include <mutex>
#include <simgrid/s4u.hpp>

#include "tests/bench/kernel/workloads.hpp"

namespace waitpoint::bench {
namespace {

namespace s4u = simgrid::s4u;

double seconds(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

struct Kit {
  static constexpr Clock clock = Clock::processor;
  static s4u::Host* host;

  template <class Body>
  static void spawn(int, int, Body body) {
    s4u::Actor::create("task", host, std::move(body));
  }
  static void sleep(std::int64_t ns) { s4u::this_actor::sleep_for(seconds(ns)); }

  struct Semaphore {
    explicit Semaphore(unsigned units) : of(s4u::Semaphore::create(units)) {}
    void acquire() { of->acquire(); }
    bool acquire_for(std::int64_t ns) { return !of->acquire_timeout(seconds(ns)); }
    void release() { of->release(); }
    s4u::SemaphorePtr of;
  };
  using Signal = Semaphore;
  struct Mutex {
    void lock() { of->lock(); }
    void unlock() { of->unlock(); }
    s4u::MutexPtr of = s4u::Mutex::create();
  };
  struct Condition {
    void wait(Mutex& held) {
      std::unique_lock<s4u::Mutex> lock(*held.of, std::adopt_lock);
      of->wait(lock);
      lock.release();
    }
    void notify() { of->notify_one(); }
    s4u::ConditionVariablePtr of = s4u::ConditionVariable::create();
  };
};
s4u::Host* Kit::host = nullptr;

void run(int argc, char** argv) {
  s4u::Engine engine(&argc, argv);
  const Request request = parse_request(argc, argv);
  s4u::Engine::set_config("contexts/stack-size:16");
  s4u::Engine::set_config("contexts/guard-size:" + std::string(request.tasks > 30'000 ? "0" : "1"));
  s4u::Engine::set_config("surf/precision:1e-9");
  auto* zone = s4u::create_full_zone("zone");
  Kit::host = zone->create_host("host", 1e9);
  zone->seal();
  s4u::Actor::create("main", Kit::host, [&request] {
    carry_out<Kit>(request);
    leave();
  });
  engine.run();
}

}  // namespace
}  // namespace waitpoint::bench

int main(int argc, char** argv) { waitpoint::bench::run(argc, argv); }
