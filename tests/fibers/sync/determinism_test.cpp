// SPDX-License-Identifier: BSD-3-Clause
// One seed gives one run, with or without watches and windows; another seed gives another run.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "fibers/kernel/run.hpp"
#include "fibers/kernel/visit.hpp"
#include "fibers/kernel/watch.hpp"
#include "fibers/sync/threads.hpp"
#include "tests/fibers/sync/mixed_program.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;

struct Outcome {
  std::string digest;
  std::uint64_t events = 0;
  std::vector<std::int64_t> times;  // of all events
  friend bool operator==(const Outcome&, const Outcome&) = default;
};

struct Times : kernel::Watch {
  std::vector<std::int64_t> seen;
};

// Runs the program in windows that end at the times of `next_end`; null: in one window.
Outcome run(const SimulationOptions& options, const MixedProgram& program = {},
            const std::function<Time(Time)>& next_end = nullptr) {
  Simulation simulation(options);
  Times times;
  times.event = [](kernel::Watch& self, const kernel::EventRecord& record) {
    static_cast<Times&>(self).seen.push_back(record.time.ns());
  };
  kernel::set_watch(simulation.scheduler(), &times);
  spawn_mixed_program(simulation, program);
  RunEnd end = RunEnd::time_reached;
  for (Time until; end == RunEnd::time_reached;) {
    until = next_end != nullptr ? next_end(until) : Time::max();
    end = simulation.run_before(until);
    EXPECT_TRUE(times.seen.empty() || Time::from_ns(times.seen.back()) < until);
  }
  EXPECT_EQ(end, RunEnd::ended) << simulation.trouble();
  return {to_string(simulation.digest()), kernel::events(simulation.scheduler()), times.seen};
}

TEST(Determinism, TheSameSeedGivesTheSameRun) {
  for (std::uint64_t number = 0; number <= 5; ++number) {
    const Outcome first = run(order_number(number));
    EXPECT_GT(first.events, 800u);
    for (int repeat = 0; repeat < 10; ++repeat) EXPECT_EQ(run(order_number(number)), first);
  }
}

TEST(Determinism, TimeNeverGoesBack) {
  for (std::uint64_t number = 0; number <= 5; ++number) {
    const Outcome outcome = run(order_number(number));
    EXPECT_TRUE(std::is_sorted(outcome.times.begin(), outcome.times.end()));
  }
}

TEST(Determinism, EverySeedAndEveryProgramGivesAnotherDigest) {
  std::set<std::string> digests;
  for (std::uint64_t number = 0; number <= 40; ++number) digests.insert(run(order_number(number)).digest);
  for (std::uint64_t seed = 2; seed <= 20; ++seed) digests.insert(run({}, {.seed = seed}).digest);
  EXPECT_EQ(digests.size(), 60u);
}

TEST(Determinism, WindowsDoNotChangeARun) {
  for (std::uint64_t number = 0; number <= 6; ++number) {
    const SimulationOptions options = order_number(number);
    const Outcome whole = run(options);
    for (const auto width : {10us, 50us, 77us, 100us, 3333us}) {
      EXPECT_EQ(run(options, {}, [&](Time t) { return t + Duration(width); }), whole) << width.count();
    }
    // Ends exactly at the times of events, and just after each.
    std::size_t next = 0;
    for (const std::int64_t beyond : {0, 1}) {
      next = 0;
      const auto at_events = [&](Time) {
        return next < whole.times.size() ? Time::from_ns(whole.times[next++] + beyond) : Time::max();
      };
      EXPECT_EQ(run(options, {}, at_events), whole);
    }
  }
}

TEST(Determinism, DrawingStacksBetweenWindowsChangesNothing) {
  const Outcome whole = run(order_number(3));
  Simulation simulation(order_number(3));
  spawn_mixed_program(simulation, {});
  for (Time until; simulation.run_before(until) == RunEnd::time_reached; until += 170us)
    for (kernel::Task* t = kernel::first_task(simulation.scheduler()); t != nullptr; t = t->next) {
      void* frames[8];
      kernel::call_stack(*t, frames, 8);
    }
  EXPECT_EQ(to_string(simulation.digest()), whole.digest);
}

std::map<std::string, std::uint64_t> digest_of_each_robot(const SimulationOptions& options, int robots) {
  Simulation simulation(options);
  spawn_mixed_program(simulation, {.robots = robots});
  EXPECT_EQ(simulation.run_before(), RunEnd::ended);
  std::map<std::string, std::uint64_t> digests;
  for (kernel::Robot* r = kernel::roster(simulation.scheduler()).first_robot(); r != nullptr; r = r->next)
    if (r != &simulation.environment()) digests[r->name] = r->digest.value();
  return digests;
}

TEST(Determinism, ARobotsDigestDoesNotDependOnUnrelatedRobots) {
  for (std::uint64_t number = 0; number <= 6; ++number) {
    const auto few = digest_of_each_robot(order_number(number), 1),
               many = digest_of_each_robot(order_number(number), 6);
    EXPECT_EQ(many.at("r0"), few.at("r0"));
    std::set<std::uint64_t> different;
    for (const auto& [name, digest] : many) different.insert(digest);
    EXPECT_EQ(different.size(), 6u);
  }
}

struct Output {
  double value = 0;
  static void fields(auto field) { field("value", &Output::value); }
};

TEST(Digest, SeesTimesOperationsObjectsAndOutputs) {
  const auto digest = [](Duration sleep, int operation, int object, std::uint64_t name, double value) {
    const Report report = in_order([=] {
      mutex m[2];
      m[0].lock();
      m[0].unlock();
      this_thread::sleep_for(sleep);
      operation == 0 ? m[object].lock() : (void)m[object].try_lock();
      threads::record(name, Output{value});
      m[object].unlock();
    });
    return to_string(report.digest);
  };
  const std::string base = digest(1ms, 0, 0, 5, 0.5);
  EXPECT_EQ(digest(1ms, 0, 0, 5, 0.5), base);
  EXPECT_NE(digest(1ms + 1ns, 0, 0, 5, 0.5), base);
  EXPECT_NE(digest(1ms, 1, 0, 5, 0.5), base);
  EXPECT_NE(digest(1ms, 0, 1, 5, 0.5), base);
  EXPECT_NE(digest(1ms, 0, 0, 6, 0.5), base);
  EXPECT_NE(digest(1ms, 0, 0, 5, std::nextafter(0.5, 1)), base);
}

TEST(Simulate, TakesTheSeedFromTheEnvironmentAndSaysHowToRepeatAFailure) {
  const auto body = [] {
    for (int i = 0; i < 5; ++i) thread([] { this_thread::yield(); }).detach();
  };
  const Report seeded = simulate(body, order_number(12));
  ASSERT_EQ(setenv("WAITPOINT_SEED", "12", 1), 0);
  const Report from_environment = simulate(body);
  const Report failed = simulate([] { throw std::runtime_error("no"); });
  ASSERT_EQ(unsetenv("WAITPOINT_SEED"), 0);
  EXPECT_EQ(from_environment.digest, seeded.digest);
  EXPECT_NE(simulate(body).digest, seeded.digest);
  EXPECT_NE(failed.text.find("replay: WAITPOINT_SEED=12"), std::string::npos) << failed;
}

TEST(Simulate, ASeedInTheEnvironmentThatIsNoNumberIsBadInput) {
  for (const char* text : {"many", "12x", "-1", " 7", "1.5", "0x10", "18446744073709551616"}) {
    ASSERT_EQ(setenv("WAITPOINT_SEED", text, 1), 0);
    std::string message;
    bool ran = false;
    try {
      simulate([&] { ran = true; });
    } catch (const BadInput& error) {
      message = error.what();
    }
    ASSERT_EQ(unsetenv("WAITPOINT_SEED"), 0);
    EXPECT_EQ(message, "WAITPOINT_SEED: expected a whole number from 0 to 2^64 - 1, found '" + std::string(text) + "'");
    EXPECT_FALSE(ran);
  }
}

}  // namespace
}  // namespace waitpoint
