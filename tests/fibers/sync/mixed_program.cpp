// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/sync/mixed_program.hpp"

#include <memory>
#include <mutex>
#include <string>

#include "core/random.hpp"
#include "fibers/sync/threads.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;

struct Output {
  int value;
  static void fields(auto field) { field("value", &Output::value); }
};

// The objects that the tasks of one robot share.
struct Shared {
  timed_mutex slow;
  mutex quick;
  condition_variable changed;
  counting_semaphore<> units{2};
  periodic_timer tick{Period::hertz(3000)};
  int value = 0;
};

void round(Shared& shared, const RandomStream& random, std::uint64_t number, bool with_timers) {
  // Few different durations, all multiples of 50 us: instants tie often, and coincide with the ends of windows.
  const std::chrono::microseconds span(50 * random.below(4, number, 1));
  switch (random.below(8, number, 2)) {
    case 0: this_thread::sleep_for(span); break;
    case 1: compute(span); break;
    case 2:
      if (shared.slow.try_lock_for(span)) {
        this_thread::sleep_for(100us);
        shared.slow.unlock();
      }
      break;
    case 3: {
      const std::lock_guard guard(shared.quick);
      ++shared.value;
      shared.changed.notify_one();
      break;
    }
    case 4: {
      std::unique_lock lock(shared.quick);
      shared.changed.wait_for(lock, span, [&] { return shared.value % 3 == 0; });
      break;
    }
    case 5:
      if (shared.units.try_acquire_for(span)) {
        this_thread::yield();
        compute(span);
        shared.units.release();
      }
      break;
    case 6:
      if (with_timers) shared.tick.wait();
      break;
    default: {
      thread child([&] { threads::record(1, Output{shared.value}); });
      child.join();
    }
  }
}

}  // namespace

void spawn_mixed_program(Simulation& simulation, const MixedProgram& program) {
  for (int r = 0; r < program.robots; ++r) {
    kernel::Robot& robot = simulation.add_robot(std::string("r").append(std::to_string(r)));
    const auto shared = std::make_shared<Shared>();
    for (int t = 0; t < 5; ++t) {
      const RandomStream random(program.seed, robot.name, "task " + std::to_string(t));
      const int rounds = program.rounds;
      const bool with_timers = program.with_timers;
      simulation.spawn(robot, {.name = "worker"}, [=] {
        for (int i = 0; i < rounds; ++i) round(*shared, random, static_cast<std::uint64_t>(i), with_timers);
      });
    }
  }
}

}  // namespace waitpoint
