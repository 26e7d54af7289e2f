// SPDX-License-Identifier: BSD-3-Clause
// Catches failing assertions of doctest within an explored body: they make its schedule fail, and are shown once, with
// the report. Included by explore.hpp if doctest was included before.
#pragma once

#include <exception>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>

#include "fibers/explore/body.hpp"

// Nothing without the framework's header, which this one cannot include: how is the user's choice.
#if defined(DOCTEST_LIBRARY_INCLUDED)

namespace waitpoint::exploration {

/// Hears of the running test and of its failing assertions before doctest's own reporters.
class DoctestListener final : public doctest::IReporter {
 public:
  explicit DoctestListener(const doctest::ContextOptions& options) : output_(options.cout) { current = this; }
  ~DoctestListener() override {
    if (current == this) current = nullptr;
  }
  DoctestListener(const DoctestListener&) = delete;
  DoctestListener& operator=(const DoctestListener&) = delete;

  /// From now on failing assertions are collected; what is printed after one is lost up to the end.
  void begin() { collects_ = true; }
  /// Returns the failures since begin(), as text.
  std::string end() {
    collects_ = false;
    if (output_ != nullptr && !failures_.empty()) output_->clear();
    return std::exchange(failures_, {});
  }
  std::string test() const { return test_ != nullptr ? test_->m_name : ""; }

  void log_assert(const doctest::AssertData& data) override {
    // An assertion that only warns is no failure in any test.
    if (!collects_ || !data.m_failed || (data.m_at & doctest::assertType::is_warn) != 0) return;
    std::ostringstream text;
    text << (failures_.empty() ? "" : "\n") << "expectation at " << data.m_file << ":" << data.m_line << ": "
         << doctest::assertString(data.m_at) << "( " << data.m_expr << " )";
    if (data.m_threw)
      text << ": exception: " << data.m_exception.c_str();
    else if (data.m_decomp.size() > 0)
      text << ": " << data.m_decomp.c_str();
    failures_ += text.str();
    if (output_ != nullptr) output_->setstate(std::ios::failbit);
  }
  void log_message(const doctest::MessageData& data) override {
    if (!collects_ || (data.m_severity & doctest::assertType::is_warn) != 0) return;
    std::ostringstream text;
    text << (failures_.empty() ? "" : "\n") << "expectation at " << data.m_file << ":" << data.m_line << ": "
         << data.m_string.c_str();
    failures_ += text.str();
    if (output_ != nullptr) output_->setstate(std::ios::failbit);
  }
  void test_case_start(const doctest::TestCaseData& test) override { test_ = &test; }
  void test_case_end(const doctest::CurrentTestCaseStats&) override { test_ = nullptr; }
  void test_run_end(const doctest::TestRunStats&) override { on_tests_finished(); }
  void report_query(const doctest::QueryData&) override {}
  void test_run_start() override {}
  void test_case_reenter(const doctest::TestCaseData&) override {}
  void test_case_exception(const doctest::TestCaseException&) override {}
  void subcase_start(const doctest::SubcaseSignature&) override {}
  void subcase_end() override {}
  void test_case_skipped(const doctest::TestCaseData&) override {}

  /// That of the present run of tests.
  inline static DoctestListener* current = nullptr;

 private:
  inline static const int registered_ = doctest::registerReporter<DoctestListener>("waitpoint", 1, false);

  std::ostream* output_;
  const doctest::TestCaseData* test_ = nullptr;
  bool collects_ = false;
  std::string failures_;
};

class DoctestChecks final : public ExternalChecks {
 public:
  void begin() override {
    if (DoctestListener::current != nullptr) DoctestListener::current->begin();
  }
  std::string end() override { return DoctestListener::current != nullptr ? DoctestListener::current->end() : ""; }
  bool is_own(const std::exception_ptr& exception) const override {
    return is<doctest::detail::TestFailureException>(exception);
  }
  std::string name() const override {
    return DoctestListener::current != nullptr ? DoctestListener::current->test() : "";
  }
  // Commas separate patterns.
  std::string option_for(const std::string& name) const override {
    std::string pattern;
    for (const char letter : name) pattern += letter == ',' ? '?' : letter;
    return "--test-case=" + pattern;
  }
};

}  // namespace waitpoint::exploration

#endif
