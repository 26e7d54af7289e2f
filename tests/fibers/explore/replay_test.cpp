// SPDX-License-Identifier: BSD-3-Clause
// Settings of explore() from the environment or its options: replays by token, strategies, seeds, limits. Invalid
// settings are an error of one line.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "core/error.hpp"
#include "fibers/explore/explore.hpp"
#include "fibers/explore/schedules/token.hpp"
#include "fibers/explore/strategies/factory.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/explore/faulty_bodies.hpp"
#include "tests/fibers/text/contains.hpp"

namespace waitpoint {
namespace {

using faulty::count_to_three;
using faulty::lose_a_wake_up;

TEST(Explore, TheTokenRepeatsTheFailure) {
  const auto body = [] { count_to_three(2); };
  const ExploreReport found = explore(body, {.minimize = false});
  ASSERT_FALSE(found.passed);
  for (int repeat = 0; repeat < 2; ++repeat) {
    std::string token = found.replay;
    token[4] = static_cast<char>('2' + repeat);  // the number of the call in this test
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
  EXPECT_TRUE(contains(other.text, "the token belongs to another run")) << other;
  // Choices that do not exist in the run, and a number too large for any loop.
  for (const char* unfit : {"wx1.3.00000000.=9999-1", "wx1.4.00000000.=0-99"})
    EXPECT_TRUE(contains(explore(lose_a_wake_up, {.replay = unfit}).text, "the token belongs to another run")) << unfit;
  const ExploreReport greatest = explore([] {}, {.replay = "wx1.5.00000000.random.1.18446744073709551615"});
  EXPECT_TRUE(contains(greatest.text, "the recorded run ended its process, this one passed")) << greatest;
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
  EXPECT_EQ(message({.replay = "wx1.1.01234567-4abc!.="}),
            "replay: expected letters and digits of a trail, not '4abc!', in the token 'wx1.1.01234567-4abc!.='");
  EXPECT_EQ(message({.replay = "wx1.1.00000000.random.7.x"}),
            "replay: expected the number of a schedule, a whole number, not 'x', in the token "
            "'wx1.1.00000000.random.7.x'");
}

TEST(Explore, TheEnvironmentSaysWhatToDoInAnyProgram) {
  const auto with = [](const char* name, const char* value, const std::function<void()>& then) {
    setenv(name, value, 1);
    then();
    unsetenv(name);
  };
  with("WAITPOINT_ITERATIONS", "7", [] { EXPECT_EQ(explore([] {}).schedules, 8U); });
  with("WAITPOINT_STRATEGY", "dfs", [] { EXPECT_TRUE(explore([] {}).complete); });
  with("WAITPOINT_TIME_LIMIT", "0.000001", [] { EXPECT_LT(explore([] {}).schedules, 9U); });
}

// A wrong environment is an error of the user, not of a test.
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
    exploration::on_tests_finished();
  };
  EXPECT_EXIT(
      replay_of_another_call(), status_two,
      "^waitpoint: WAITPOINT_REPLAY: expected a token of this program, found 'wx1.9.00000000.=': no test that ran "
      "makes such a call\n$");
}

// A wrong or outdated token in a test's code fails that test; other tests continue.
TEST(Explore, OptionsInCodeThatAreWrongAreTheTestsOwnFailure) {
  EXPECT_THROW(explore([] {}, {.strategy = "pcd"}), BadInput);
  EXPECT_THROW(explore([] {}, {.replay = "wx1.nonsense"}), BadInput);
  EXPECT_THROW(explore([] {}, {.replay = "wx1.1.9f3a2c1b-6.=20-2"}), BadInput) << "a trail without marks";
  const ExploreReport report = explore([] {}, {.replay = "wx1.4.00000001.="});
  EXPECT_FALSE(report.passed);
  EXPECT_TRUE(report.text.starts_with("the token belongs to another run: it had ")) << report;
  EXPECT_FALSE(contains(report.text, "\n")) << report;
  EXPECT_THROW(explore([] {}, {.iterations = 0}), BadInput);
  EXPECT_THROW(explore([] {}, {.time_limit_s = -1}), BadInput);
}

TEST(ExploreDeathTest, ATokenThatDoesNotFitEndsTheProgramAndSaysWhereTheRunLeftIt) {
  const auto replay = [](const char* token) {
    setenv("WAITPOINT_REPLAY", token, 1);
    explore(lose_a_wake_up);
  };
  const auto status_two = ::testing::ExitedWithCode(2);
  EXPECT_EXIT(
      replay("wx1.1.00000000.=99-1"), status_two,
      "^waitpoint: wx1.*: the token belongs to another run: choice 99 was not reached: the run diverged and ended "
      "after event [0-9]+, at 0.000000000 s; the program or the test has changed\n$");
  EXPECT_EXIT(replay("wx1.1.00000000.=1-7"), status_two,
              "choice 1 has only 2 alternatives, not number 7: the run diverged at event [0-9]+, at 0.0");
  EXPECT_EXIT(
      replay("wx1.1.00000000.="), status_two,
      "the token belongs to another run: the recorded run ended its process, this one passed; the program or the "
      "test has changed");
  EXPECT_EXIT(replay("wx1.1.00000001.="), status_two,
              "it had [0-9]+ events, and its digest begins with [0-9a-f]{8}, the token's with 00000001; ");
}

// Two tasks; the second does the same forty times, except in one round, and fails.
void fail_having_differed_at(int round) {
  mutex first, second;
  thread other([&] {
    for (int i = 0; i < 40; ++i) {
      mutex& used = i == round ? second : first;
      used.lock();
      used.unlock();
    }
    check(false);
  });
  other.join();
}

TEST(Explore, ATokenOfAnotherRunSaysAtWhichEventsThisOneLeavesIt) {
  constexpr int never = -1;
  exploration::Token token = exploration::read_token(explore([] { fail_having_differed_at(never); }).replay);
  EXPECT_LE(to_text(token).size(), 80u);
  const auto replay_with = [&](int round) {
    ++token.call;  // the number of the call in this test
    return explore([round] { fail_having_differed_at(round); }, {.replay = to_text(token)}).text;
  };
  EXPECT_FALSE(contains(replay_with(never), "belongs to another run")) << to_text(token);
  // Some eighty events, with a mark after each sixteenth; round 3 begins with event 10, round 20 with event 44.
  const std::string early = replay_with(3), late = replay_with(20);
  EXPECT_TRUE(contains(early, ": the run diverged at one of its events 1 to 16;")) << early;
  EXPECT_TRUE(contains(late, ": the run diverged at one of its events 33 to 48;")) << late;
}

}  // namespace
}  // namespace waitpoint
