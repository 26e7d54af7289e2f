// SPDX-License-Identifier: BSD-3-Clause
// explore(): what it finds, what it says of it, and that its line repeats it.
#include <gtest/gtest.h>
#include <malloc.h>

#include <array>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/condition_variable_any.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// Sanitizers and valgrind have heaps of their own.
bool the_heap_is_counted() {
  const std::size_t before = mallinfo2().uordblks;
  const auto block = std::make_unique<std::array<char, 4096>>();
  block->back() = 1;
  return mallinfo2().uordblks > before;
}

// Three tasks count by load and store: an increment may be lost.
void count_to_three(int least) {
  atomic<int> count{0};
  std::vector<thread> threads;
  for (int i = 0; i < 3; ++i)
    threads.emplace_back([&] {
      const int seen = count.load();
      count.store(seen + 1);
    });
  for (thread& t : threads) t.join();
  check(count.load() >= least, "an increment was lost");
}

// The consumer looks for the letter and waits for it in two steps; between them it is not heard.
void lose_a_wake_up() {
  mutex m;
  condition_variable arrived;
  bool there = false;
  thread consumer({.name = "consumer"}, [&] {
    {
      const std::lock_guard guard(m);
      if (there) return;
    }
    std::unique_lock lock(m);
    arrived.wait(lock);
  });
  thread producer({.name = "producer"}, [&] {
    const std::lock_guard guard(m);
    there = true;
    arrived.notify_one();
  });
  consumer.join();
  producer.join();
}

TEST(Explore, WhatHoldsInAllSchedulesPasses) {
  const ExploreReport report = explore([] { count_to_three(1); });
  EXPECT_TRUE(report.passed) << report;
  EXPECT_GT(report.schedules, 9'000U);
  EXPECT_GT(report.distinct, 500U);
  EXPECT_FALSE(report.complete);
  EXPECT_TRUE(simulate(lose_a_wake_up).passed);  // which a single run does not show
}

TEST(Explore, ALostWakeUpIsFoundMinimizedAndExplained) {
  const ExploreReport report = explore(lose_a_wake_up);
  EXPECT_FALSE(report.passed);
  EXPECT_TRUE(contains(report.text, "deadlock at ")) << report;
  EXPECT_TRUE(contains(report.text, "task consumer of environment waits (wait) for condition variable")) << report;
  EXPECT_EQ(report.schedule.switches.size(), 1U) << report;
  EXPECT_TRUE(contains(report.text, "one switch away from the default order fails")) << report;
  EXPECT_TRUE(contains(report.text, "the last choice from which it could still have passed")) << report;
  EXPECT_TRUE(contains(report.text, "producer#2, about to ")) << report;
  EXPECT_TRUE(contains(report.text, "consumer#1  wait condition variable")) << report;
  EXPECT_TRUE(contains(report.text, "replay: WAITPOINT_REPLAY=wx1.")) << report;
  EXPECT_TRUE(contains(report.text, "--gtest_filter=Explore.ALostWakeUpIsFoundMinimizedAndExplained")) << report;
  EXPECT_LE(report.replay.size(), 80U);
}

// That others are let go on while a task polls is the default order, not a switch away from it.
TEST(Explore, WhoPollsAddsNoSwitchesToAFailure) {
  const ExploreReport report = explore([] {
    atomic<int> written{0}, done{0};
    thread polling([&] {
      while (done.load() < 2) this_thread::yield();
    });
    const auto increment = [&] {
      const int read = written.load();
      written.store(read + 1);
      done.fetch_add(1);
    };
    thread first(increment), second(increment);
    for (thread* each : {&polling, &first, &second}) each->join();
    check(written.load() == 2, "a lost update");
  });
  EXPECT_FALSE(report.passed);
  EXPECT_EQ(report.schedule.switches.size(), 1U) << report;
}

TEST(Explore, EveryWayToFailIsReportedInItsWords) {
  const auto words = [](std::function<void()> body) { return explore(std::move(body)).text; };
  EXPECT_TRUE(contains(words([] { count_to_three(3); }), ": an increment was lost"));
  const auto throws = [] {
    atomic<int> turn{0};
    thread([&] { turn.store(1); }).detach();
    if (turn.load() == 1) throw std::runtime_error("too early");
    this_thread::sleep_for(1ms);
  };
  EXPECT_TRUE(
      contains(words(throws), "an exception escaped from task main of environment at 0.000000000 s: too early"));
  const auto locks_in_opposite_orders = [] {
    mutex left, right;
    const auto take = [](mutex& first, mutex& second) {
      const std::lock_guard a(first);
      const std::lock_guard b(second);
    };
    thread one([&] { take(left, right); });
    thread two([&] { take(right, left); });
    one.join();
    two.join();
  };
  EXPECT_TRUE(contains(words(locks_in_opposite_orders), "wait for each other"));
  const auto spins = [] {
    atomic<bool> never{false};
    while (!never.load()) {
    }
  };
  EXPECT_TRUE(contains(words(spins), "no progress"));
}

TEST(Explore, TheTokenRepeatsTheFailure) {
  const auto body = [] { count_to_three(2); };
  const ExploreReport found = explore(body, {.minimize = false});
  ASSERT_FALSE(found.passed);
  for (int repeat = 0; repeat < 2; ++repeat) {
    std::string token = found.replay;
    token[4] = static_cast<char>('2' + repeat);  // it counts the calls in this test
    const ExploreReport again = explore(body, {.replay = token});
    EXPECT_FALSE(again.passed);
    EXPECT_EQ(again.schedules, 1U);
    EXPECT_TRUE(contains(again.text, "the replayed schedule failed: a check failed in task main")) << again;
    EXPECT_EQ(again.schedule.deviations(), found.schedule.deviations());
  }
}

TEST(Explore, ATokenOfAnotherProgramIsKnownAsSuch) {
  const ExploreReport found = explore([] { count_to_three(2); });
  std::string token = found.replay;
  token[4] = '2';
  const ExploreReport other = explore(lose_a_wake_up, {.replay = token});
  EXPECT_TRUE(contains(other.text, "this is not the run of the token")) << other;
  // Choices that the run does not have, and a number that no loop may count up to.
  for (const char* unfit : {"wx1.3.00000000.=9999-1", "wx1.4.00000000.=0-99"})
    EXPECT_TRUE(contains(explore(lose_a_wake_up, {.replay = unfit}).text, "this is not the run of the token")) << unfit;
  EXPECT_TRUE(explore([] {}, {.replay = "wx1.5.00000000.random.1.18446744073709551615"}).passed);
}

TEST(Explore, ABodyThatCallsExitEndsTheTestProgramWithAFailure) {
  const auto explore_and_leave = [] {
    explore([] {
      atomic<bool> first{false};
      thread other([&] { first.store(true); });
      if (first.load()) std::exit(0);
      other.join();
    });
    std::exit(0);
  };
  EXPECT_EXIT(explore_and_leave(), testing::ExitedWithCode(1), "the process ended within schedule [0-9]+\nreplay: ");
}

TEST(Explore, AScheduleThatGoesOnForLongIsTold) {
  const auto wait_for_real_time = [] {
    const auto begun = std::chrono::steady_clock::now();
    explore([&] {
      while (std::chrono::steady_clock::now() - begun < 13s) {
      }
    });
    std::exit(0);
  };
  EXPECT_EXIT(wait_for_real_time(), testing::ExitedWithCode(0), "the default schedule has gone on for 10 s");
}

TEST(Explore, ABodyThatFailsInTheDefaultOrderOnlyLaterIsSaidToLeak) {
  int runs = 0;
  const ExploreReport report = explore([&] { check(++runs < 200, "too many"); });
  EXPECT_TRUE(contains(report.text, "which passed at first, fails now: the body leaks state")) << report;
}

TEST(Explore, BadTokensAndStrategiesAreOneClearLine) {
  const auto message = [](const ExploreOptions& options) {
    try {
      explore([] {}, options);
    } catch (const BadInput& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(message({.strategy = "pso"}),
            "strategy: unknown strategy 'pso', did you mean 'pos'?; there are " + exploration::strategy_names());
  EXPECT_EQ(message({.strategy = "pct:0"}), "strategy: expected pct:D, a whole number from 1 to 1000, found 'pct:0'");
  EXPECT_EQ(message({.strategy = "bounded:0"}), "no error");  // without any preemption
  EXPECT_EQ(message({.strategy = "pos:3"}), "strategy: expected pos without a parameter, found 'pos:3'");
  EXPECT_EQ(message({.replay = "wx2.1.0"}), "replay: expected the version wx1, not 'wx2', in the token 'wx2.1.0'");
  EXPECT_EQ(message({.replay = "wx1.0.00000000.="}),
            "replay: expected a test's token, found a scenario's: 'wx1.0.00000000.='");
  EXPECT_EQ(message({.replay = "wx1.1.00000000.=5-0,2-1"}),
            "replay: expected numbers of choices that ascend in the token 'wx1.1.00000000.=5-0,2-1'");
  EXPECT_EQ(message({.replay = "wx1.1.12"}),
            "replay: expected eight hexadecimal digits of a digest, not '12', in the token 'wx1.1.12'");
  EXPECT_EQ(message({.replay = "wx1.1.00000000.random.7.x"}),
            "replay: expected the number of a schedule, a whole number, not 'x', in the token "
            "'wx1.1.00000000.random.7.x'");
}

TEST(Explore, ABodyThatLeaksStateIsNamedWithTheFirstDifference) {
  int runs = 0;
  const ExploreReport report = explore([&] {
    if (++runs % 2 == 0) this_thread::yield();
  });
  EXPECT_FALSE(report.passed);
  EXPECT_TRUE(contains(report.text, "the body leaks state from one schedule into the next")) << report;
  EXPECT_TRUE(contains(report.text, "'main#0 yield")) << report;
}

TEST(Explore, MemoryThatEachScheduleLeavesIsCounted) {
  std::vector<std::unique_ptr<int[]>> kept;
  kept.reserve(20'000);
  const ExploreReport leaking = explore([&] { kept.push_back(std::make_unique<int[]>(100)); });
  EXPECT_TRUE(leaking.passed) << leaking;
  if (the_heap_is_counted()) {
    EXPECT_GE(leaking.leaked_bytes, 400U);
    EXPECT_LT(leaking.leaked_bytes, 500U);
  }
  EXPECT_EQ(explore([] { thread([] {}).join(); }).leaked_bytes, 0U);
}

TEST(Explore, TheEnvironmentSaysWhatToDoInAnyProgram) {
  const auto with = [](const char* name, const char* value, std::function<void()> then) {
    setenv(name, value, 1);
    then();
    unsetenv(name);
  };
  with("WAITPOINT_ITERATIONS", "7", [] { EXPECT_EQ(explore([] {}).schedules, 8U); });
  with("WAITPOINT_STRATEGY", "dfs", [] { EXPECT_TRUE(explore([] {}).complete); });
  with("WAITPOINT_TIME_LIMIT", "0.000001", [] { EXPECT_LT(explore([] {}).schedules, 9U); });
}

// Whoever started the program is at fault, no test of it.
TEST(ExploreDeathTest, AnEnvironmentThatIsWrongEndsTheProgramWithALineAndStatusTwo) {
  int bodies = 0;
  const auto explore_with = [&](const char* name, const char* value) {
    setenv(name, value, 1);
    explore([&] { std::fprintf(stderr, "body %d", ++bodies); });
  };
  const auto status_two = ::testing::ExitedWithCode(2);
  EXPECT_EXIT(explore_with("WAITPOINT_SEED", "nine"), status_two,
              "^waitpoint: WAITPOINT_SEED: expected a whole number from 0 to 2\\^64 - 1, found 'nine'\n$");
  EXPECT_EXIT(explore_with("WAITPOINT_STRATEGY", "pcd"), status_two, "^waitpoint: strategy: unknown strategy 'pcd'");
  EXPECT_EXIT(explore_with("WAITPOINT_REPLAY", "wx1.nonsense"), status_two, "^waitpoint: ");
  EXPECT_EXIT(explore_with("WAITPOINT_ITERATIONS", "0"), status_two,
              "^waitpoint: WAITPOINT_ITERATIONS: expected a positive whole number, found '0'\n$");
  EXPECT_EXIT(explore_with("WAITPOINT_TIME_LIMIT", "0"), status_two,
              "^waitpoint: WAITPOINT_TIME_LIMIT: expected a pos");
  EXPECT_EXIT(
      explore_with("WAITPOINT_TRACE", "/no/such/folder/trace"), status_two,
      "^waitpoint: WAITPOINT_TRACE: expected a file that can be written, found '/no/such/folder/trace': No such");
  const auto replay_of_another_call = [] {
    setenv("WAITPOINT_REPLAY", "wx1.9.00000000.=", 1);
    explore([] {});
    exploration::tests_are_over();
  };
  EXPECT_EXIT(
      replay_of_another_call(), status_two,
      "^waitpoint: WAITPOINT_REPLAY: expected a token of this program, found 'wx1.9.00000000.=': the test has no "
      "such call\n$");
}

// A test that keeps a token in its code has failed where that is wrong or fits no more; the other tests go on.
TEST(Explore, OptionsInCodeThatAreWrongAreTheTestsOwnFailure) {
  EXPECT_THROW(explore([] {}, {.strategy = "pcd"}), BadInput);
  EXPECT_THROW(explore([] {}, {.replay = "wx1.nonsense"}), BadInput);
  const ExploreReport report = explore([] {}, {.replay = "wx1.3.00000001.="});
  EXPECT_FALSE(report.passed);
  EXPECT_TRUE(report.text.starts_with("this is not the run of the token: it had ")) << report;
  EXPECT_FALSE(contains(report.text, "\n")) << report;
}

TEST(ExploreDeathTest, ATokenThatDoesNotFitEndsTheProgramAndSaysWhereTheRunLeftIt) {
  const auto replay = [](const char* token) {
    setenv("WAITPOINT_REPLAY", token, 1);
    explore(lose_a_wake_up);
  };
  const auto status_two = ::testing::ExitedWithCode(2);
  EXPECT_EXIT(replay("wx1.1.00000000.=99-1"), status_two,
              "^waitpoint: wx1.*: this is not the run of the token: choice 99 was never come to: it left the record "
              "before its end, behind event [0-9]+, at 0.000000000 s; the program or the test is another one\n$");
  EXPECT_EXIT(replay("wx1.1.00000000.=1-7"), status_two,
              "choice 1 has only 2 alternatives, none of the number 7: it left the record at event [0-9]+, at 0.0");
  EXPECT_EXIT(replay("wx1.1.00000001.="), status_two,
              "it had [0-9]+ events, and its digest begins with [0-9a-f]{8}, the token's with 00000001; ");
}

TEST(Explore, WhatIsChosenBesideTasksIsToldInWords) {
  const ExploreReport slow = explore([] {
    thread worker({.name = "worker"}, [] {
      compute(1ms, 3ms);
      check(now() >= Time() + 2ms, "too early");
    });
    worker.join();
  });
  EXPECT_TRUE(
      contains(slow.text, "how long a computation takes, at 0.000000000 s: worker#1, about to start, computes "))
      << slow;
  EXPECT_TRUE(contains(slow.text, "; it passes if it computes 0.003000000 s")) << slow;
  const ExploreReport woken = explore([] {
    mutex m;
    condition_variable arrived;
    bool there = false;
    thread waiter({.name = "waiter"}, [&] {
      std::unique_lock lock(m);
      if (!there) arrived.wait(lock);
      check(there, "woken for nothing");
    });
    this_thread::sleep_for(1ms);
    {
      const std::lock_guard guard(m);
      there = true;
      arrived.notify_one();
    }
    waiter.join();
  });
  EXPECT_TRUE(contains(woken.text, "waiter#1, about to wait condition variable #2, goes on for nothing")) << woken;
}

TEST(Explore, WhatIsChosenBesideTasks) {
  // Who is woken; that a wait ends for nothing; a timeout against a wake-up at one instant; what a computation costs.
  const auto can_fail = [](std::function<void()> body) { return !explore(std::move(body)).passed; };
  EXPECT_TRUE(can_fail([] {
    mutex m;
    condition_variable c;
    int woken = 0;
    const auto wait = [&](int name) {
      std::unique_lock lock(m);
      c.wait(lock);
      if (woken == 0) woken = name;
    };
    thread a([&] { wait(1); });
    this_thread::sleep_for(1ms);
    thread b([&] { wait(2); });
    this_thread::sleep_for(1ms);
    c.notify_one();
    this_thread::sleep_for(1ms);
    c.notify_one();
    a.join();
    b.join();
    check(woken == 1, "the second waiter was served first");
  }));
  const auto trust_a_wake_up = [](auto& c) {
    mutex m;
    bool notified = false;
    thread notifier([&] {
      this_thread::sleep_for(1ms);
      const std::lock_guard guard(m);
      notified = true;
      c.notify_one();
    });
    {
      std::unique_lock lock(m);
      c.wait(lock);
    }
    check(notified, "woken for nothing");
    notifier.join();
  };
  EXPECT_TRUE(can_fail([&] {
    condition_variable c;
    trust_a_wake_up(c);
  }));
  EXPECT_TRUE(can_fail([&] {
    condition_variable_any c;
    trust_a_wake_up(c);
  }));
  for (const bool in_time : {true, false})
    EXPECT_TRUE(can_fail([&] {
      binary_semaphore done(0);
      thread worker([&] {
        this_thread::sleep_for(5ms);
        done.release();
      });
      const bool got = done.try_acquire_for(5ms);
      worker.join();
      check(got != in_time);
    }));
  for (const int cost_ms : {1, 2, 3})
    EXPECT_TRUE(can_fail([&] {
      compute(1ms, 3ms);
      check(now() != Time() + Duration(std::chrono::milliseconds(cost_ms)));
    }));
}

TEST(Explore, WithinDeclaredTimesOnlyFeasibleSchedulesAreTried) {
  const auto body = [](Duration slowest) {
    atomic<bool> written{false};
    thread writer([&] {
      compute(Duration(1ms), slowest);
      written.store(true);
    });
    thread reader([&] {
      compute(3ms, 4ms);
      check(written.load(), "read before it was written");
    });
    writer.join();
    reader.join();
  };
  EXPECT_TRUE(explore([&] { body(Duration(2ms)); }).passed);
  const ExploreReport wider = explore([&] { body(Duration(3500us)); }, {.iterations = 1000});
  EXPECT_TRUE(contains(wider.text, "read before it was written")) << wider;
}

}  // namespace
}  // namespace waitpoint
