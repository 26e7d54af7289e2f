// SPDX-License-Identifier: BSD-3-Clause
// Catches failing GoogleTest expectations within an explored body: they make its schedule fail, and are shown once,
// with the report. A body that skips the test (GTEST_SKIP) in the default order, which runs first, skips it; in another
// schedule it merely returns. Included by explore.hpp if GoogleTest was included before.
#pragma once

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>

#include "fibers/explore/body.hpp"

namespace waitpoint::exploration {

class GoogleTestChecks final : public ExternalChecks {
 public:
  void begin() override {
    ++runs_;
    reporter_.reset();
    results_.emplace();
    reporter_.emplace(testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &*results_);
  }
  std::string end() override {
    reporter_.reset();
    std::string text;
    for (int i = 0; results_ && i < results_->size(); ++i) {
      const testing::TestPartResult& result = results_->GetTestPartResult(i);
      if (result.failed())
        text.append(text.empty() ? "" : "\n")
            .append("expectation at ")
            .append(result.file_name() != nullptr ? result.file_name() : "?")
            .append(":")
            .append(std::to_string(result.line_number()))
            .append(": ")
            .append(result.message());
      else if (result.skipped() && runs_ == 1)
        skip(result);
    }
    return text;
  }
  std::string name() const override {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    return test == nullptr ? "" : std::string(test->test_suite_name()) + "." + test->name();
  }
  std::string option_for(const std::string& name) const override { return "--gtest_filter=" + name; }

 private:
  // Runs before the printer of results, whose last line would otherwise claim that all tests passed.
  class Ends final : public testing::EmptyTestEventListener {
    void OnTestEnd(const testing::TestInfo&) override {
      if (testing::UnitTest::GetInstance()->test_to_run_count() == 1) on_tests_finished();
    }
    void OnTestIterationEnd(const testing::UnitTest&, int) override { on_tests_finished(); }
  };

  // Forwards the skip to the test itself.
  static void skip(const testing::TestPartResult& result) {
    GTEST_SKIP() << (result.file_name() != nullptr ? result.file_name() : "?") << ":" << result.line_number() << ": "
                 << result.message();
  }

  // Installed at program start, since a filter may leave no exploring test.
  inline static const bool listens_ = (testing::UnitTest::GetInstance()->listeners().Append(new Ends), true);

  std::uint64_t runs_ = 0;
  std::optional<testing::TestPartResultArray> results_;
  std::optional<testing::ScopedFakeTestPartResultReporter> reporter_;
};

}  // namespace waitpoint::exploration
