// SPDX-License-Identifier: BSD-3-Clause
// What is no assertion (sections, generators, benchmarks, messages) as Catch2 2.x and 3.4 to 3.7 tell it: it is passed
// on to the test. Defines WAITPOINT_CATCH2 for these versions, and nothing for others.
#pragma once

// Nothing without the framework's header, which this one cannot include first: how is the user's choice.
#if defined(CATCH_TEST_MACROS_HPP_INCLUDED)
#include <catch2/catch_assertion_info.hpp>
#include <catch2/catch_message.hpp>
#include <catch2/catch_section_info.hpp>
#include <catch2/catch_totals.hpp>
#include <catch2/catch_version_macros.hpp>
#include <catch2/interfaces/catch_interfaces_capture.hpp>
#include <catch2/internal/catch_assertion_handler.hpp>
#include <catch2/internal/catch_context.hpp>
#endif
#if defined(CATCH_VERSION_MAJOR) && \
    (CATCH_VERSION_MAJOR == 2 || (CATCH_VERSION_MAJOR == 3 && CATCH_VERSION_MINOR >= 4 && CATCH_VERSION_MINOR <= 7))
#define WAITPOINT_CATCH2

#if CATCH_VERSION_MAJOR == 3
#include <catch2/internal/catch_test_failure_exception.hpp>
#endif

#include <string>
#include <utility>

namespace waitpoint::exploration {

#if CATCH_VERSION_MAJOR == 2
using CatchMessage = const Catch::StringRef&;
using CatchException = const std::string&;
#else
#if CATCH_VERSION_MINOR < 7 || CATCH_VERSION_PATCH == 0
using CatchMessage = Catch::StringRef;
#else
using CatchMessage = std::string&&;
#endif
using CatchException = std::string&&;
#endif

class CatchPassedOn : public Catch::IResultCapture {
 public:
  explicit CatchPassedOn(Catch::IResultCapture& test) : test_(test) {}

#if CATCH_VERSION_MAJOR == 2
  bool sectionStarted(const Catch::SectionInfo& info, Catch::Counts& counts) override {
    return test_.sectionStarted(info, counts);
  }
  void sectionEnded(const Catch::SectionEndInfo& info) override { test_.sectionEnded(info); }
  void sectionEndedEarly(const Catch::SectionEndInfo& info) override { test_.sectionEndedEarly(info); }
  Catch::IGeneratorTracker& acquireGeneratorTracker(Catch::StringRef name, const Catch::SourceLineInfo& line) override {
    return test_.acquireGeneratorTracker(name, line);
  }
#ifdef CATCH_CONFIG_ENABLE_BENCHMARKING
  void benchmarkPreparing(const std::string& name) override { test_.benchmarkPreparing(name); }
  void benchmarkFailed(const std::string& error) override { test_.benchmarkFailed(error); }
#endif
  void emplaceUnscopedMessage(const Catch::MessageBuilder& builder) override { test_.emplaceUnscopedMessage(builder); }
#else
  // Of assertions the test would tell its reporters.
  void notifyAssertionStarted(const Catch::AssertionInfo&) override {}
  bool sectionStarted(Catch::StringRef name, const Catch::SourceLineInfo& line, Catch::Counts& counts) override {
    return test_.sectionStarted(name, line, counts);
  }
  void sectionEnded(Catch::SectionEndInfo&& info) override { test_.sectionEnded(std::move(info)); }
  void sectionEndedEarly(Catch::SectionEndInfo&& info) override { test_.sectionEndedEarly(std::move(info)); }
  Catch::IGeneratorTracker* acquireGeneratorTracker(Catch::StringRef name, const Catch::SourceLineInfo& line) override {
    return test_.acquireGeneratorTracker(name, line);
  }
  Catch::IGeneratorTracker* createGeneratorTracker(Catch::StringRef name, Catch::SourceLineInfo line,
                                                   Catch::Generators::GeneratorBasePtr&& generator) override {
    return test_.createGeneratorTracker(name, line, std::move(generator));
  }
  void benchmarkPreparing(Catch::StringRef name) override { test_.benchmarkPreparing(name); }
  void benchmarkFailed(Catch::StringRef error) override { test_.benchmarkFailed(error); }
  void emplaceUnscopedMessage(Catch::MessageBuilder&& builder) override {
    test_.emplaceUnscopedMessage(std::move(builder));
  }
#endif
#if CATCH_VERSION_MAJOR == 3 || defined(CATCH_CONFIG_ENABLE_BENCHMARKING)
  void benchmarkStarting(const Catch::BenchmarkInfo& info) override { test_.benchmarkStarting(info); }
  void benchmarkEnded(const Catch::BenchmarkStats<>& stats) override { test_.benchmarkEnded(stats); }
#endif
  void pushScopedMessage(const Catch::MessageInfo& message) override { test_.pushScopedMessage(message); }
  void popScopedMessage(const Catch::MessageInfo& message) override { test_.popScopedMessage(message); }
  void handleFatalErrorCondition(Catch::StringRef message) override { test_.handleFatalErrorCondition(message); }
  std::string getCurrentTestName() const override { return test_.getCurrentTestName(); }
  const Catch::AssertionResult* getLastResult() const override { return test_.getLastResult(); }
  void exceptionEarlyReported() override { test_.exceptionEarlyReported(); }

 protected:
  /// SKIP() of 3.x, which would end the test and not the schedule alone, is no success.
  static bool is_passed(Catch::ResultWas::OfType type) {
#if CATCH_VERSION_MAJOR == 3
    if (type == Catch::ResultWas::ExplicitSkip) return false;
#endif
    return Catch::isOk(type) || type == Catch::ResultWas::Info || type == Catch::ResultWas::Warning;
  }

 private:
  Catch::IResultCapture& test_;
};

}  // namespace waitpoint::exploration

#endif
