// SPDX-License-Identifier: BSD-3-Clause
// Catches failing assertions of Catch2 (2.x, 3.4 to 3.7) within an explored body: they make its schedule fail, and are
// shown once, with the report. Included by explore.hpp if Catch2 was included before.
#pragma once

#include <exception>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "fibers/explore/body.hpp"
#include "fibers/explore/catch2_passed_on.hpp"

#if defined(WAITPOINT_CATCH2)

namespace waitpoint::exploration {

/// Stands in for the framework's own capture of results; passes on all that is no assertion.
class CatchCapture final : public CatchPassedOn {
 public:
  using CatchPassedOn::CatchPassedOn;

  /// The failures since the last call.
  std::string take_failures() { return std::exchange(failures_, {}); }

  void handleExpr(const Catch::AssertionInfo& info, const Catch::ITransientExpression& expression,
                  Catch::AssertionReaction& reaction) override {
    const bool is_false_test = Catch::isFalseTest(info.resultDisposition);
    if (expression.getResult() != is_false_test) return assertionPassed();
    std::ostringstream text;
    if (is_false_test) text << "!(";
    expression.streamReconstructedExpression(text);
    if (is_false_test) text << ")";
    fail(info, text.str(), reaction);
  }
  void handleMessage(const Catch::AssertionInfo& info, Catch::ResultWas::OfType type, CatchMessage message,
                     Catch::AssertionReaction& reaction) override {
    if (is_passed(type)) return assertionPassed();
    fail(info, std::string(message), reaction);
  }
  void handleUnexpectedExceptionNotThrown(const Catch::AssertionInfo& info,
                                          Catch::AssertionReaction& reaction) override {
    fail(info, "no exception was thrown", reaction);
  }
  void handleUnexpectedInflightException(const Catch::AssertionInfo& info, CatchException message,
                                         Catch::AssertionReaction& reaction) override {
    fail(info, "exception: " + message, reaction);
  }
  void handleNonExpr(const Catch::AssertionInfo& info, Catch::ResultWas::OfType type,
                     Catch::AssertionReaction& reaction) override {
    if (Catch::isOk(type)) return assertionPassed();
    fail(info, std::string(info.capturedExpression), reaction);
  }
  void handleIncomplete(const Catch::AssertionInfo&) override {}
  bool lastAssertionPassed() override { return last_passed_; }
  void assertionPassed() override { last_passed_ = true; }

 private:
  void fail(const Catch::AssertionInfo& info, const std::string& found, Catch::AssertionReaction& reaction) {
    last_passed_ = Catch::shouldSuppressFailure(info.resultDisposition);
    if (last_passed_) return;
    std::ostringstream text;
    text << (failures_.empty() ? "" : "\n") << "expectation at " << info.lineInfo.file << ":" << info.lineInfo.line
         << ": " << info.macroName << "( " << info.capturedExpression << " ): " << found;
    failures_ += text.str();
    reaction.shouldThrow = (info.resultDisposition & Catch::ResultDisposition::ContinueOnFailure) == 0;
  }

  std::string failures_;
  bool last_passed_ = true;
};

class CatchChecks final : public ExternalChecks {
 public:
  void begin() override { Catch::getCurrentMutableContext().setResultCapture(&capture_); }
  std::string end() override {
    Catch::getCurrentMutableContext().setResultCapture(&test_);
    return capture_.take_failures();
  }
  bool is_own(const std::exception_ptr& exception) const override { return is<Catch::TestFailureException>(exception); }
  std::string name() const override { return test_.getCurrentTestName(); }
  // Catch2 takes tests by name. Some characters are its syntax, others only at the beginning without a quotation mark:
  // "-" begins an option, and "~" means all other tests.
  std::string option_for(const std::string& name) const override {
    std::string pattern;
    for (const char letter : name) {
      if (std::string_view(",[\"\\").find(letter) != std::string_view::npos) pattern += '\\';
      pattern += letter;
    }
    return name.starts_with('-') || name.starts_with('~') ? '"' + pattern + '"' : pattern;
  }

 private:
  Catch::IResultCapture& test_ = Catch::getResultCapture();
  CatchCapture capture_{test_};
};

}  // namespace waitpoint::exploration

#endif
