// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search/results_file.hpp"

#include <fmt/format.h>

#include <string>

namespace waitpoint::tools {
namespace {

std::string outcome_of(const Finding& finding) {
  if (!finding.passed()) return "failed: " + finding.headline();
  return finding.was_cut ? "cut short: equivalent to earlier ones" : "passed";
}

}  // namespace

void ResultsFile::begin(const ProcessTarget& target) {
  const ExploreOptions& options = target.options();
  file_.write(fmt::format("# waitpoint results 1: scenario {:016x}, strategy {}, seed {}\n", target.fingerprint(),
                          options.strategy, options.seed));
  file_.show();
}

void ResultsFile::take(std::uint64_t number, const Finding& finding) {
  file_.write(fmt::format("{:020} {} {}\n", number, digest_text(finding.digest), outcome_of(finding)));
  file_.flush();
}

}  // namespace waitpoint::tools
