// SPDX-License-Identifier: BSD-3-Clause
// The kernel's fast paths execute the same events as the plain path: random programs with and without them.
#include <gtest/gtest.h>

#include <string>

#include "fibers/kernel/run.hpp"
#include "fibers/sync/threads.hpp"
#include "tests/fibers/sync/mixed_program.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;

struct Result {
  std::string digest;
  std::uint64_t events = 0;
  Time end_time;
  friend bool operator==(const Result&, const Result&) = default;
};

// In windows of `width`; 0: in one window.
Result run(SimulationOptions options, const MixedProgram& program, bool fast_paths, Duration width = {}) {
  options.fast_paths = fast_paths;
  Simulation simulation(options);
  spawn_mixed_program(simulation, program);
  Time until = width == Duration() ? Time::max() : Time() + width;
  while (simulation.run_before(until) == RunEnd::time_reached) until += width;
  EXPECT_EQ(simulation.trouble(), "");
  return {to_string(simulation.digest()), kernel::events(simulation.scheduler()), simulation.global_time()};
}

TEST(FastPaths, RandomProgramsRunAsOnThePlainPath) {
  for (std::uint64_t number = 0; number <= 8; ++number)
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      const MixedProgram program{.seed = seed, .robots = 1 + static_cast<int>(seed % 4), .with_timers = seed % 3 != 0};
      const Result plain = run(order_number(number), program, false);
      EXPECT_GT(plain.events, 100u);
      EXPECT_EQ(run(order_number(number), program, true), plain) << "order " << number << ", program " << seed;
    }
}

TEST(FastPaths, WindowsMakeNoDifferenceBetweenThem) {
  for (std::uint64_t number = 0; number <= 2; ++number)
    for (const auto width : {10us, 77us, 3333us}) {
      const Result plain = run(order_number(number), {}, false, width);
      EXPECT_EQ(run(order_number(number), {}, true, width), plain) << "order " << number << ", " << width.count();
    }
}

// A task that spins at an instant, with others at the same instant: the bound on turns is the same.
Result run_spinning(bool fast_paths) {
  SimulationOptions options;
  options.fast_paths = fast_paths;
  const Report report = simulate(
      [] {
        mutex common;
        thread other([&] {
          for (int i = 0; i < 3000; ++i) {
            const std::lock_guard lock(common);
            if (i % 7 == 0) compute(1us);
          }
        });
        for (int i = 0; i < 5000; ++i) {
          const std::lock_guard lock(common);
          if (i % 1500 == 0) this_thread::yield();
          if (i % 40 == 0) (void)now();
        }
        other.join();
      },
      options);
  EXPECT_TRUE(report.passed) << report.text;
  return {to_string(report.digest), report.events, report.end_time};
}

TEST(FastPaths, TheBoundOnTurnsIsTheSame) { EXPECT_EQ(run_spinning(true), run_spinning(false)); }

}  // namespace
}  // namespace waitpoint
