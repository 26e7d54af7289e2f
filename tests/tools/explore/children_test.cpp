// SPDX-License-Identifier: BSD-3-Clause
// Child processes for one job each: their results, and the termination of those that do not end.
#include "tools/explore/children.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <map>

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

TEST(Children, give_back_what_they_came_to_or_how_they_died) {
  Children children;
  children.start(1, [] { return std::string("bytes"); });
  children.start(2, []() -> std::string {
    std::fputs("last words\n", stderr);
    std::raise(SIGKILL);
    return "";
  });
  const auto ended = all_of(children);
  EXPECT_EQ(ended.at(1).bytes, "bytes");
  EXPECT_EQ(death_of(ended.at(1)), "");
  EXPECT_EQ(death_of(ended.at(2)), "the process was killed by signal 9 (Killed), with standard error:\nlast words");
}

TEST(Children, that_compute_or_wait_for_too_long_are_ended) {
  Children children({.wall_s = 12});
  children.start(1, []() -> std::string {
    for (;;) asm volatile("");
  });
  children.start(2, []() -> std::string {
    for (;;) pause();
  });
  const auto ended = all_of(children);
  EXPECT_EQ(death_of(ended.at(1)), "exceeded 12 s of wall clock time (--schedule-limit); process killed");
  EXPECT_EQ(death_of(ended.at(2)), "blocked for 10 s outside the simulation (a real lock or input); process killed");
}

TEST(Children, of_which_it_is_expected_may_wait) {
  Children children({.wall_s = 0, .computes = false});
  children.start(1, [] {
    sleep(11);
    return std::string("done");
  });
  EXPECT_EQ(all_of(children).at(1).bytes, "done");
}

}  // namespace
}  // namespace waitpoint::tools
