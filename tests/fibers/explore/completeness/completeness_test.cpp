// SPDX-License-Identifier: BSD-3-Clause
// A strategy that says that it has tried all schedules has found all outcomes that a program can have, and no other.
#include <gtest/gtest.h>

#include <map>

#include "tests/fibers/explore/completeness/calibration.hpp"
#include "tests/fibers/explore/completeness/comparison.hpp"
#include "tests/fibers/explore/completeness/random_programs.hpp"

namespace waitpoint::completeness {
namespace {

constexpr std::uint64_t programs = 300;

struct Case {
  const char* strategy;
  std::uint64_t schedules_max;
  std::size_t least_equal;  // programs that are small enough for all schedules
};

std::ostream& operator<<(std::ostream& out, const Case& of) { return out << of.strategy; }

class Completeness : public testing::TestWithParam<Case> {};

TEST_P(Completeness, FindsExactlyTheOutcomesOfRandomPrograms) {
  const auto [strategy, schedules_max, least_equal] = GetParam();
  const Coverage coverage = [&, strategy = strategy, most = schedules_max](const Program& program) {
    return cover(program, strategy, most);
  };
  std::size_t equal = 0, left_out = 0;
  for (std::uint64_t number = 1; number <= programs; ++number) {
    const Program program = make_program(number);
    std::string difference;
    const RunVerdict verdict = compare(enumerate(program, states_max), coverage(program), difference);
    equal += verdict == RunVerdict::equal;
    left_out += verdict == RunVerdict::left_out;
    if (verdict == RunVerdict::different)
      ADD_FAILURE() << number << ", shrunk: " << to_text(shrink(program, coverage)) << "\n" << difference;
  }
  EXPECT_GE(equal, least_equal);
  RecordProperty("left_out", std::to_string(left_out));
}

INSTANTIATE_TEST_SUITE_P(Strategies, Completeness,
                         testing::Values(Case{"dfs", 1000, 150}, Case{"bounded:1000", 300, 130},
                                         Case{"dpor", 4000, 285}),
                         [](const auto& of) { return std::string(of.param.strategy).substr(0, 4); });

// Programs whose outcomes a search without equivalent schedules can miss.
class Dpor : public testing::TestWithParam<const char*> {};

TEST_P(Dpor, FindsEveryOutcome) {
  const Program program = read_program(GetParam());
  std::string difference;
  const Covered covered = cover(program, "dpor", 10'000);
  EXPECT_EQ(compare(enumerate(program, states_max), covered, difference), RunVerdict::equal) << difference;
}

INSTANTIATE_TEST_SUITE_P(
    Programs, Dpor,
    testing::Values(
        // Thread 2 starts after later events of the thread that has created it, which do not happen before it.
        "00|c20 c10 x11 g13|g13 f02|f02 p13",
        // A load and its opposite order are equivalent to none, if a third event comes between.
        "00|c10 t00 c20 u00 r00|q00|q00 t00", "00|c20 b10 c10 n10|l00 w00 u00|b00 l10 w10 u10",
        // The end of the run by one thread prevents the other's event.
        "00|c10 k00|k00", "00|c10 l00|u00"));

// Of a sample of 25 schedules; ./dev test --completeness --estimate has more.
TEST(ChanceOfNews, IsWithinItsInterval) {
  constexpr std::uint64_t measured = 2'000;
  std::size_t holding = 0, positive = 0, positive_holding = 0;
  for (std::uint64_t number = 1; number <= programs; ++number) {
    const Calibration one = calibrate(make_program(number), 25, measured);
    holding += one.holds();
    positive += one.share > 0;
    positive_holding += one.share > 0 && one.holds();
  }
  EXPECT_GE(holding, programs * 9 / 10);
  EXPECT_GE(positive, programs / 4);
  EXPECT_GE(positive_holding, positive * 85 / 100);
}

TEST(RandomPrograms, HaveOutcomesOfEveryKind) {
  std::size_t with_several = 0;
  std::map<std::string, std::size_t> ends;
  for (std::uint64_t number = 1; number <= programs; ++number) {
    const Outcomes outcomes = enumerate(make_program(number), states_max).outcomes;
    with_several += outcomes.size() > 1;
    std::set<std::string> kinds;
    for (const std::string& outcome : outcomes) kinds.insert(outcome.substr(0, outcome.find_first_of(" :")));
    for (const std::string& kind : kinds) ++ends[kind];
  }
  EXPECT_GE(with_several, 100u);
  for (const char* kind : {"ended", "stuck", "cycle", "exit", "misuse"}) EXPECT_GE(ends[kind], 5u) << kind;
}

TEST(Programs, AreReadAsTheyAreWritten) {
  for (std::uint64_t number = 1; number <= programs; ++number) {
    const std::string text = to_text(make_program(number));
    EXPECT_EQ(to_text(read_program(text)), text);
  }
  for (const char* text : {"", "0", "00|c20", "00|c00", "00|g2", "00|y00", "00g00", "00|l20", "00|c10|c10"})
    EXPECT_ANY_THROW(read_program(text)) << text;
}

}  // namespace
}  // namespace waitpoint::completeness
