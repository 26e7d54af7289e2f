// SPDX-License-Identifier: BSD-3-Clause
// Child processes for one job each: their results, and the termination of those that do not end.
#include "tools/processes/children.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <map>
#include <set>
#include <string>

namespace waitpoint::tools {
namespace {

// The end of each child, by number.
std::map<std::uint64_t, Children::Ended> all_of(Children& children) {
  constexpr int look_around_ms = 100;
  std::map<std::uint64_t, Children::Ended> ended;
  while (children.count() > 0)
    if (auto one = children.wait(look_around_ms)) ended.emplace(one->number, *one);
  return ended;
}

std::string carry_out(std::string_view job) {
  if (job == "die") {
    std::fputs("last words\n", stderr);
    std::raise(SIGKILL);
  }
  while (job == "compute") asm volatile("");
  while (job == "wait") pause();
  if (job == "sleep") sleep(11);
  return job == "process" ? std::to_string(getpid()) : std::string(job);
}

TEST(Children, ReturnTheirResultOrTheirDeath) {
  Children children(carry_out, {});
  children.start(1, "bytes");
  children.start(2, "die");
  const auto ended = all_of(children);
  EXPECT_EQ(ended.at(1).bytes, "bytes");
  EXPECT_EQ(death_of(ended.at(1)), "");
  EXPECT_EQ(death_of(ended.at(2)), "the process was killed by signal 9 (Killed), with standard error:\nlast words");
}

TEST(Children, ServeOneJobOrManyUntilTheyDie) {
  for (const bool is_reused : {false, true}) {
    Children children(carry_out, {.is_reused = is_reused});
    std::set<std::string> processes;
    for (const std::uint64_t number : {1, 2, 3}) {
      children.start(number, "process");
      processes.insert(all_of(children).at(number).bytes);
    }
    EXPECT_EQ(processes.size(), is_reused ? 1 : 3);
    children.start(4, "die");
    EXPECT_FALSE(death_of(all_of(children).at(4)).empty());
    children.start(5, "process");
    EXPECT_FALSE(processes.contains(all_of(children).at(5).bytes));
  }
}

TEST(Children, AreKilledAtTheirTimeLimits) {
  Children children(carry_out, {.wall_s = 12});
  children.start(1, "compute");
  children.start(2, "wait");
  const auto ended = all_of(children);
  EXPECT_EQ(death_of(ended.at(1)), "exceeded 12 s of wall clock time (--schedule-limit); process killed");
  EXPECT_EQ(death_of(ended.at(2)), "blocked for 10 s outside the simulation (a real lock or input); process killed");
}

TEST(Children, SleepPastTheIdleLimitIfTheyDoNotCompute) {
  Children children(carry_out, {.wall_s = 0, .computes = false});
  children.start(1, "sleep");
  EXPECT_EQ(all_of(children).at(1).bytes, "sleep");
}

}  // namespace
}  // namespace waitpoint::tools
