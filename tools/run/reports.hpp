// SPDX-License-Identifier: BSD-3-Clause
// The reports of a run besides its files: the text on standard output, unmet expectations, its failure.
#pragma once

#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "modules/bridge/run_result.hpp"
#include "modules/scenario/scenario.hpp"
#include "tools/output/output_file.hpp"
#include "tools/run/outputs.hpp"

namespace waitpoint::tools {

/// Standard output, whose failure must not cost the files theirs: it is reported after them. Standard error in its
/// place if an output file has standard output.
class Printed {
 public:
  explicit Printed(const RunOptions& options) : to_standard_error_(options.writes_standard_output()) {}

  void print(const std::string& text) {
    if (to_standard_error_) {
      std::fputs(text.c_str(), stderr);
      return;
    }
    try {
      if (!failure_) write_standard_output(text);
    } catch (const BadInput& failure) {
      failure_ = failure;
    }
  }
  /// Throws BadInput if a text could not be written.
  void check() const {
    if (failure_) throw BadInput(*failure_);
    flush_standard_output();
  }

 private:
  bool to_standard_error_;
  std::optional<BadInput> failure_;
};

/// The exit status, and the expectations that are not met, a sentence each.
struct Verdict {
  int status = 0;
  std::vector<std::string> unmet;
};
/// Unmet expectations are reported on standard error, too.
Verdict verdict(const scenario::Scenario& scenario, const bridge::RunResult& result);

/// Tells of the failure, with the line that repeats the run, and completes the outputs (null: none). Returns the exit
/// status.
int report_failure(const std::exception& failure, const std::string& replay, Outputs* outputs);

}  // namespace waitpoint::tools
