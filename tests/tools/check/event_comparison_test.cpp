// SPDX-License-Identifier: BSD-3-Clause
// Comparison of two runs of small programs of threads: the first event that differs is found and named.
#include "tools/check/event_comparison.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "fibers/sync/threads.hpp"

namespace waitpoint::tools {
namespace {

using namespace std::chrono_literals;

/// The body of a thread of the robot "walker", and the text for the end of the run.
struct Program {
  std::function<void()> body;
  std::string end = "no task remains";
  const char* task = "legs";
};

Digest run(const Program& program, const std::function<void(Simulation&)>& watch) {
  Simulation simulation;
  kernel::Robot& robot = simulation.add_robot("walker");
  simulation.spawn(robot, {.name = program.task}, program.body);
  watch(simulation);
  simulation.run_before();
  return simulation.digest();
}

std::optional<Difference> difference(const Program& one, const Program& other) {
  EventLog log;
  log.finish(run(one, [&](Simulation& simulation) { log.watch(simulation); }), one.end);
  EventComparison comparison(log.file());
  const Digest digest = run(other, [&](Simulation& simulation) { comparison.watch(simulation); });
  return comparison.finish(digest, other.end);
}

Program sleeps(std::vector<std::chrono::milliseconds> spans) {
  return {[spans] {
    for (const std::chrono::milliseconds span : spans) this_thread::sleep_for(span);
  }};
}

TEST(EventComparison, EqualRunsDoNotDiffer) {
  EXPECT_FALSE(difference(sleeps({1ms, 2ms}), sleeps({1ms, 2ms})));
  // More than one buffer of the log.
  const std::vector<std::chrono::milliseconds> many(10'000, 1ms);
  EXPECT_FALSE(difference(sleeps(many), sleeps(many)));
}

TEST(EventComparison, ADifferenceBehindManyEqualEventsIsFound) {
  std::vector<std::chrono::milliseconds> many(10'000, 1ms), other = many;
  other[9'000] = 2ms;
  const auto found = difference(sleeps(many), sleeps(other));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->expected->time, Time() + 9001ms);
  EXPECT_EQ(found->found->time, Time() + 9002ms);
  EXPECT_EQ(found->before->time, Time() + 9000ms);
}

TEST(EventComparison, NamesTheTimeThatDiffersAndTheEventBefore) {
  const auto found = difference(sleeps({1ms, 2ms}), sleeps({1ms, 3ms}));
  ASSERT_TRUE(found);
  EXPECT_EQ(to_string(*found->expected), "0.003000000 s, robot walker, task legs: sleep");
  EXPECT_EQ(to_string(*found->found), "0.004000000 s, robot walker, task legs: sleep");
  EXPECT_EQ(to_string(*found->before), "0.001000000 s, robot walker, task legs: sleep");
  EXPECT_EQ(found->number, 3u);
  EXPECT_NE(to_text(*found).find("differs in        time\n"), std::string::npos) << to_text(*found);
}

TEST(EventComparison, NamesTaskOperationAndObject) {
  const auto differs = [](const Program& one, const Program& other) {
    const auto found = difference(one, other);
    if (!found) return std::string("nothing");
    const std::string text = to_text(*found), name = "differs in        ";
    const std::size_t at = text.find(name) + name.size();
    return text.substr(at, text.find('\n', at) - at);
  };
  const auto takes = [](const char* label) {
    return Program{[label] {
      threads::mutex mutex(label);
      mutex.lock();
      mutex.unlock();
    }};
  };
  const Program tries{[] {
    threads::mutex mutex("door");
    if (mutex.try_lock()) mutex.unlock();
  }};
  EXPECT_EQ(differs(takes("door"), takes("door")), "nothing");
  EXPECT_EQ(differs(takes("door"), takes("gate")), "object");
  EXPECT_EQ(differs(takes("door"), tries), "operation");
  Program arms = sleeps({1ms});
  arms.task = "arms";
  EXPECT_EQ(differs(sleeps({1ms}), arms), "task");
}

TEST(EventComparison, SeesValuesAtTheNextEvent) {
  const auto gives = [](std::uint64_t value) {
    return Program{[value] {
      this_thread::sleep_for(1ms);
      threads::record(1, value);
      this_thread::sleep_for(1ms);
    }};
  };
  EXPECT_FALSE(difference(gives(7), gives(7)));
  const auto found = difference(gives(7), gives(8));
  ASSERT_TRUE(found);
  EXPECT_EQ(to_string(*found->expected), to_string(*found->found));
  EXPECT_NE(found->expected->digest, found->found->digest);
  EXPECT_EQ(found->found->time, Time() + 2ms);
  EXPECT_EQ(found->before->time, Time() + 1ms);
}

TEST(EventComparison, ARunThatEndsEarlierLaterOrOtherwiseDiffers) {
  const auto shorter = difference(sleeps({1ms, 2ms}), sleeps({1ms}));
  ASSERT_TRUE(shorter);
  EXPECT_EQ(shorter->expected->operation, "sleep");
  EXPECT_NE(shorter->found->operation, "sleep");
  Program deadlock = sleeps({1ms});
  deadlock.end = "deadlock";
  const auto otherwise = difference(sleeps({1ms}), deadlock);
  ASSERT_TRUE(otherwise);
  EXPECT_FALSE(otherwise->expected || otherwise->found);
  EXPECT_NE(to_text(*otherwise)
                .find("was               no event: no task remains\n  is                no event: deadlock\n"
                      "  differs in        the end of the run\n"),
            std::string::npos)
      << to_text(*otherwise);
}

TEST(EventComparison, ARunThatWasCutOffDidNotComeToTheNextEvent) {
  EventLog log;
  log.finish(run(sleeps({1ms, 2ms}), [&](Simulation& simulation) { log.watch(simulation); }), "no task remains");
  const Difference difference = cut_off(log.file(), 2, "the process was ended");
  EXPECT_EQ(difference.number, 3u);
  EXPECT_EQ(difference.before->time, Time() + 1ms);
  EXPECT_EQ(difference.expected->time, Time() + 3ms);
  EXPECT_FALSE(difference.found);
}

}  // namespace
}  // namespace waitpoint::tools
