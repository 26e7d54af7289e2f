// SPDX-License-Identifier: BSD-3-Clause
// Simulations in several threads of the operating system at once: each is the run that it is alone.
#include <gtest/gtest.h>

#include <barrier>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "fibers/kernel/run.hpp"
#include "fibers/switch/sanitizer.hpp"
#include "fibers/sync/simulation.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/mixed_program.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;

// In windows of a millisecond: so the threads of the system alternate often. `between` is called after each.
std::string digest_of(
    std::uint64_t seed, const std::function<void()>& between = [] {}) {
  Simulation simulation(
      {.order = seed % 2 == 0 ? kernel::Order::fifo : kernel::Order::seeded, .seed = seed, .replay = ""});
  spawn_mixed_program(simulation, {.seed = seed, .robots = 3});
  RunEnd end = RunEnd::time_reached;
  for (Time until; end == RunEnd::time_reached; between()) {
    until = until + 1ms;
    end = simulation.run_before(until);
  }
  simulation.unwind();
  return to_string(simulation.digest()) + ", " + std::to_string(kernel::events(simulation.scheduler())) + " events";
}

// One body in each thread, all begun at once.
void at_once(std::size_t threads, const std::function<void(std::size_t)>& body) {
  std::barrier all_there(static_cast<std::ptrdiff_t>(threads));
  std::vector<std::jthread> running;
  for (std::size_t i = 0; i < threads; ++i)
    running.emplace_back([&, i] {
      all_there.arrive_and_wait();
      body(i);
    });
}

TEST(SimulationsInThreads, AreTheRunsThatTheyAreAlone) {
  std::vector<std::string> alone;
  for (std::uint64_t seed = 0; seed < 8; ++seed) alone.push_back(digest_of(seed));
  for (const std::size_t threads : {2, 8}) {
    std::vector<std::string> together(threads);
    at_once(threads, [&](std::size_t i) { together[i] = digest_of(i, [] { std::this_thread::yield(); }); });
    for (std::size_t i = 0; i < threads; ++i) EXPECT_EQ(together[i], alone[i]) << threads << " threads, seed " << i;
  }
}

TEST(SimulationsInThreads, KeepTheExceptionsOfTheirTasksApart) {
  std::vector<std::string> reports(4);
  at_once(reports.size(), [&](std::size_t i) {
    const auto fail = [i] {
      try {
        throw std::runtime_error("number " + std::to_string(i));
      } catch (...) {
        for (int ms = 0; ms < 100; ++ms) this_thread::sleep_for(1ms);
        throw;
      }
    };
    reports[i] = simulate(fail).text;
  });
  for (std::size_t i = 0; i < reports.size(); ++i)
    EXPECT_NE(reports[i].find("at 0.100000000 s: number " + std::to_string(i)), std::string::npos) << reports[i];
}

TEST(SimulationsInThreads, AreMadeInOneAndRunInAnother) {
  Simulation simulation({.seed = 3, .replay = ""});
  spawn_mixed_program(simulation, {.seed = 3});
  std::jthread([&] {
    simulation.run_before();
    simulation.unwind();
  }).join();
  Simulation here({.seed = 3, .replay = ""});
  spawn_mixed_program(here, {.seed = 3});
  here.run_before();
  EXPECT_EQ(to_string(simulation.digest()), to_string(here.digest()));
}

// The program anew, before there are threads in it. Where it runs under another program (run_tests.py names it), as
// under qemu, the system cannot start it: a copy, then.
void start_anew_for_a_death() {
  if (std::getenv("WAITPOINT_UNDER") == nullptr) GTEST_FLAG_SET(death_test_style, "threadsafe");
}

TEST(SimulationsInThreadsDeathTest, StayOnTheThreadThatBeganToRunThem) {
  start_anew_for_a_death();
  const auto change_thread = [] {
    Simulation simulation;
    simulation.spawn(simulation.environment(), {.name = "main"}, [] { this_thread::sleep_for(2s); });
    simulation.run_before(Time() + 1s);
    std::jthread([&] { simulation.run_before(); }).join();
  };
  EXPECT_DEATH(change_thread(),
               "misuse: a simulation is continued in another thread than the one that began to run it");
}

TEST(SimulationsInThreadsDeathTest, ADeathIsReportedWithTheTaskOfItsThread) {
  if (kernel::sanitizer::present) GTEST_SKIP() << "a sanitizer reports deaths itself";
  start_anew_for_a_death();
  const auto die_in_one = [] {
    at_once(4, [](std::size_t i) {
      (void)simulate([i] {
        constexpr const char* names[] = {"ada", "bob", "eve", "joe"};
        thread worker({.name = names[i]}, [i] {
          this_thread::sleep_for(5ms);
          if (i == 2) std::raise(SIGFPE);
          for (;;) this_thread::sleep_for(1ms);
        });
        worker.join();
      });
    });
  };
  EXPECT_DEATH(die_in_one(), "the process dies of SIGFPE.*\n.*at virtual time 0.005000000 s, in task eve");
}

}  // namespace
}  // namespace waitpoint
