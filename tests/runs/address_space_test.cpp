// SPDX-License-Identifier: BSD-3-Clause
// Runs with little address space, as after `ulimit -v`: the usual run, or an error of one line.
#include <gtest/gtest.h>

#include <algorithm>

#include "fibers/switch/sanitizer.hpp"
#include "tests/runs/program.hpp"

namespace waitpoint::runs {
namespace {

Outcome run_with_kib(const std::string& kib) {
  Command command = run_command("office-10.yaml", "2");
  command.words.insert(command.words.begin(), {"sh", "-c", "ulimit -v " + kib + " && exec \"$@\"", "sh"});
  return outcome_of(command);
}

class AddressSpace : public testing::Test {
 protected:
  void SetUp() override {
    if (kernel::sanitizer::present) GTEST_SKIP() << "a sanitizer takes all address space";
  }
};

TEST_F(AddressSpace, FourGigabytesSuffice) {
  const Outcome usual = outcome_of(run_command("office-10.yaml", "2")), limited = run_with_kib("4000000");
  ASSERT_NE(usual.digest(), "") << usual.errors;
  EXPECT_EQ(limited.digest(), usual.digest()) << limited.errors;
  EXPECT_EQ(limited.status, usual.status);
}

TEST_F(AddressSpace, TooLittleIsReportedInOneLine) {
  const Outcome outcome = run_with_kib("250000");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.output, "");
  EXPECT_NE(outcome.errors.find("no address space for the run's tables (a limit such as ulimit -v)"), std::string::npos)
      << outcome.errors;
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
}

}  // namespace
}  // namespace waitpoint::runs
