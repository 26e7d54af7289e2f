// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/explore/weak_memory/outcomes.hpp"

#include "fibers/explore/explore.hpp"

namespace waitpoint::weak_memory {
namespace {

std::vector<Outcome> noted;  // by thread, of the present run

}  // namespace

Explored explored(const Litmus& litmus, const std::string& strategy, Memory memory, std::uint64_t iterations) {
  Explored result;
  const auto body = [&] {
    noted.assign(litmus.size() + 1, {});
    execute(litmus, [](std::size_t thread, int value) { noted[thread].push_back(value); });
    Outcome outcome;
    for (const Outcome& part : noted) outcome.insert(outcome.end(), part.begin(), part.end());
    result.outcomes.insert(outcome);
  };
  const ExploreReport report =
      explore_with(nullptr, body, {.strategy = strategy, .iterations = iterations, .memory = memory});
  result.schedules = report.schedules;
  result.scope = report.scope;
  result.text = report.text;
  return result;
}

}  // namespace waitpoint::weak_memory
