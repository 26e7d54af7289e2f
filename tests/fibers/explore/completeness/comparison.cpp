// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/explore/completeness/comparison.hpp"

#include <algorithm>

namespace waitpoint::completeness {
namespace {

// A line for each element of `some` that is not in `others`.
std::string beyond(const Outcomes& some, const Outcomes& others, const char* what) {
  std::string text;
  for (const std::string& outcome : some)
    if (!others.contains(outcome)) text += std::string("  ") + what + ": " + outcome + "\n";
  return text;
}

}  // namespace

RunVerdict compare(const Enumerated& all, const Covered& covered, std::string& difference) {
  if (!all.is_complete) return RunVerdict::unfinished;
  Outcomes found = covered.outcomes;
  if (found.erase("cycle ?") != 0)
    for (const std::string& outcome : all.outcomes)
      if (outcome.starts_with("cycle")) found.insert(outcome);
  difference = beyond(found, all.outcomes, "found, but impossible");
  const bool is_whole = covered.is_finished && !covered.leaves_turns;
  if (is_whole) difference += beyond(all.outcomes, found, "possible, but not found");
  if (!difference.empty()) return RunVerdict::different;
  return is_whole ? RunVerdict::equal : covered.is_finished ? RunVerdict::left_out : RunVerdict::unfinished;
}

Program shrink(const Program& program, const Coverage& coverage) {
  for (const Program& less : smaller(program)) {
    std::string difference;
    if (compare(enumerate(less, states_max), coverage(less), difference) == RunVerdict::different)
      return shrink(less, coverage);
  }
  return program;
}

}  // namespace waitpoint::completeness
