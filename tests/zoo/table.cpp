// SPDX-License-Identifier: BSD-3-Clause
// Writes the table of docs/zoo.md: for each specimen the share of uniformly random schedules that fail, and the
// schedules that each strategy needs, the median of 20 seeds.
//
//   zoo-table [--seed=N] [NAME ...]    only these specimens, with seeds from N (default: 1)
//
// Below it: the number of the portfolio's failures whose choices replay to the same digest.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <vector>

#include "core/number_text.hpp"
#include "fibers/explore/strategies/fifo.hpp"
#include "tests/zoo/search.hpp"
#include "tests/zoo/zoo.hpp"

namespace {

constexpr const char* strategies[] = {"portfolio", "random", "pct:2", "pct:3",     "pos",
                                      "urw",       "surw",   "rff",   "goexplore", "bounded:2"};
constexpr std::uint64_t seeds = 20, schedules_max = 10'000;

constexpr std::uint64_t schedules_of_share = 20'000;

struct Repeats {
  std::uint64_t failures = 0, same = 0;
};

bool is_repeated(waitpoint::zoo::Search& search, const waitpoint::exploration::Finding& failure) {
  waitpoint::exploration::Fifo rest;
  return search.body().run(rest, {.deviations = failure.deviations}).digest == failure.digest;
}

// Of the random walk's schedules.
std::string share(waitpoint::zoo::Search& search, std::uint64_t seed) {
  const std::uint64_t failed = search.failures("random", seed, schedules_of_share);
  if (failed == 0) return "< 1/20 000";
  char text[16];
  std::snprintf(text, sizeof text, "%.2g %%", 100.0 * static_cast<double>(failed) / schedules_of_share);
  return text;
}

// "median (number of successful seeds)"; exhaustive strategies have no seed.
std::string cell(waitpoint::zoo::Search& search, const std::string& strategy, std::uint64_t first, Repeats& repeats) {
  std::vector<std::uint64_t> needed;
  std::uint64_t found = 0;
  const bool one = strategy.starts_with("bounded");
  for (std::uint64_t seed = first; seed < first + (one ? 1 : seeds); ++seed) {
    const auto failure = search.find(strategy, seed, schedules_max);
    found += failure.has_value();
    if (failure && strategy == "portfolio") {
      ++repeats.failures;
      repeats.same += is_repeated(search, failure->failure);
    }
    needed.push_back(failure ? failure->schedules : schedules_max + 1);
  }
  std::sort(needed.begin(), needed.end());
  const std::uint64_t median = needed[needed.size() / 2];
  std::string text = median > schedules_max ? "-" : std::to_string(median);
  if (!one && found < seeds) text += " (" + std::to_string(found) + ")";
  return text;
}

}  // namespace

int main(int count, char** arguments) {
  constexpr std::string_view option = "--seed=";
  std::uint64_t first = 1;
  if (count > 1 && std::string_view(arguments[1]).starts_with(option)) {
    if (!waitpoint::parse_number(std::string_view(arguments[1]).substr(option.size()), first)) {
      std::fprintf(stderr, "zoo-table: expected a whole number, found '%s'\n", arguments[1]);
      return 2;
    }
    --count;
    ++arguments;
  }
  std::printf("| specimen | kind | switches | share |");
  for (const char* strategy : strategies) std::printf(" %s |", strategy);
  std::printf("\n|---|---|---|---|");
  for (std::size_t i = 0; i < std::size(strategies); ++i) std::printf("---|");
  std::printf("\n");
  Repeats repeats;
  for (const waitpoint::zoo::Specimen& specimen : waitpoint::zoo::specimens()) {
    const auto is_name = [&](const char* argument) { return std::strcmp(argument, specimen.name) == 0; };
    if (count > 1 && std::none_of(arguments + 1, arguments + count, is_name)) continue;
    waitpoint::zoo::Search search(specimen.buggy);
    std::printf("| %s | %s | %u | %s |", specimen.name, specimen.kind, specimen.switches, share(search, first).c_str());
    for (const char* strategy : strategies) {
      std::printf(" %s |", cell(search, strategy, first, repeats).c_str());
      std::fflush(stdout);
    }
    std::printf("\n");
  }
  std::printf("\nReplays: %llu of %llu failures came to the same digest.\n",
              static_cast<unsigned long long>(repeats.same), static_cast<unsigned long long>(repeats.failures));
  return repeats.same == repeats.failures ? 0 : 1;
}
