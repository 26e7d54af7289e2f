// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/reports.hpp"

#include <utility>

#include "core/exception_text.hpp"
#include "core/printable_line.hpp"
#include "fibers/kernel/process_end.hpp"
#include "modules/run/expectation.hpp"

namespace waitpoint::tools {

Verdict verdict(const scenario::Scenario& scenario, const bridge::RunResult& result) {
  if (result.outcome == bridge::Outcome::interrupted) return {130, {}};
  std::vector<std::string> unmet = run::unmet(scenario.expect, result);
  std::fflush(stdout);
  if (!result.outside_fault.empty())
    std::fprintf(stderr, "waitpoint: ended at a fault outside: %s\n", result.outside_fault.c_str());
  for (const std::string& line : unmet) std::fprintf(stderr, "waitpoint: not as expected: %s\n", line.c_str());
  const bool is_good = unmet.empty() && result.outside_fault.empty();
  return {is_good ? 0 : 1, std::move(unmet)};
}

int report_failure(const std::exception& failure, const std::string& replay, Outputs* outputs) {
  const kernel::Commit commit;
  const std::string reason = printable_message(exception_text(failure));
  std::fflush(stdout);
  std::fprintf(stderr, "waitpoint: the run failed: %s\n  replay: %s\n", reason.c_str(), replay.c_str());
  if (outputs != nullptr) outputs->cut_off(reason, 1);
  return 1;
}

}  // namespace waitpoint::tools
