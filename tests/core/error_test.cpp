// SPDX-License-Identifier: BSD-3-Clause
#include "core/error.hpp"

#include <gtest/gtest.h>

namespace waitpoint {
namespace {

TEST(BadInput, IsOneLineWhateverStoodInTheFile) {
  EXPECT_STREQ(BadInput("a\nb", 3, "found '\x1b[31m\r\n\x7f'").what(), "a?b:3: found '?[31m??\?'");
  EXPECT_STREQ(BadInput("a", 0, "pas trouv\xc3\xa9").what(), "a: pas trouv\xc3\xa9");
}

TEST(BadInput, CanBeNoted) {
  const BadInput noted = BadInput("b", 3, "expected 'c'").with_note(" (included at a\n:7)");
  EXPECT_STREQ(noted.what(), "b:3: expected 'c' (included at a?:7)");
  EXPECT_EQ(noted.file(), "b");
  EXPECT_EQ(noted.line(), 3);
}

TEST(BadInput, IsOneLineWithTheFileAndTheLine) {
  EXPECT_STREQ(BadInput("office.yaml", 12, "step_ms should be positive").what(),
               "office.yaml:12: step_ms should be positive");
  EXPECT_STREQ(BadInput("office.png", 0, "cannot be read").what(), "office.png: cannot be read");
  EXPECT_STREQ(BadInput("--seed", "should be an integer").what(), "--seed: should be an integer");
}

TEST(CheckDeathTest, ABrokenInvariantAbortsAndSaysWhere) {
  WAITPOINT_CHECK(1 + 1 == 2, "arithmetic fails");
  EXPECT_EXIT(WAITPOINT_CHECK(1 + 1 == 3, "arithmetic fails"), testing::KilledBySignal(SIGABRT),
              "waitpoint: bug: arithmetic fails \\(1 \\+ 1 == 3\\) at .*error_test.cpp:");
}

}  // namespace
}  // namespace waitpoint
