// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/replay_record.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "fibers/explore/strategy.hpp"
#include "fibers/explore/token.hpp"

namespace waitpoint::tools {
namespace {

using exploration::Switch;
using exploration::Token;

/// The record's seed becomes the options'.
void take_seed(ExploreOptions& options, std::uint64_t seed) {
  if (options.seed_is_asked && options.seed != seed)
    throw BadInput(
        "--seed", fmt::format("expected {}, that of '{}', or no --seed, found {}", seed, options.replay, options.seed));
  options.seed = seed;
}

ReplayRecord of_token(ExploreOptions& options) {
  const Token token = exploration::read_token(options.replay);
  if (token.call != 0)
    throw BadInput("--replay", "the token '" + options.replay +
                                   "' is of a test that explores; expected one of waitpoint explore, wx1.0...");
  ReplayRecord record;
  record.digest = std::uint64_t{token.digest} << 32;
  record.digest_bits = token.digest == 0 ? 0 : 32;
  if (token.strategy.empty()) {
    record.plan = {.drawn = false, .deviations = token.deviations};
  } else {
    if (exploration::make_strategy(token.strategy)->is_exhaustive())
      throw BadInput("--replay", "expected a strategy that draws its schedules in the token '" + options.replay + "'");
    options.strategy = token.strategy;
    take_seed(options, token.seed);
    record.plan = {.number = token.number};
  }
  return record;
}

ReplayRecord of_file(ExploreOptions& options, std::uint64_t fingerprint) {
  ReplayRecord record;
  record.stored = read_schedule(options.replay);
  if (record.stored.fingerprint != fingerprint)
    throw BadInput(options.replay, 2,
                   fmt::format("expected a schedule of this {}, {:016x}, found one of {:016x}",
                               options.program.empty() ? "scenario with these --set and --property" : "program",
                               fingerprint, record.stored.fingerprint));
  if (record.stored.from != Time() + options.from.value_or(Duration()))
    throw BadInput(options.replay, 4, "expected the same time as --from");
  take_seed(options, record.stored.seed);
  record.digest = record.stored.digest;
  record.digest_bits = record.digest == 0 ? 0 : 64;
  record.plan = {.number = record.stored.number, .drawn = false, .switches = record.stored.switches};
  return record;
}

/// Where the run left the record, in words; empty if it did not.
std::string parting(const ReplayRecord& record, const Replayed& run) {
  const Finding& finding = run.finding;
  const std::string where = fmt::format("behind event {} at {} s", finding.events, to_string(finding.end));
  std::vector<Switch> met = run.schedule.switches;
  std::sort(met.begin(), met.end());
  for (std::size_t i = 0; i < record.plan.switches.size(); ++i) {
    const Switch& change = record.plan.switches[i];
    if (std::binary_search(met.begin(), met.end(), change)) continue;
    const std::vector<exploration::Told>& told = run.told;
    const std::string known = i == 0 || told.size() < i
                                  ? "no switch of the record was come to before"
                                  : fmt::format("the run was the record's up to event {}", told[i - 1].event);
    return fmt::format("line {}: event {} of task {:016x} did not come to a choice that has this switch; {}",
                       line_of_switch(i), change.usual.sequence, change.usual.task, known);
  }
  for (const auto& deviation : record.plan.deviations)
    if (deviation.decision >= run.schedule.decisions.size())
      return fmt::format("choice {} was never come to: the run was over {}", deviation.decision, where);
  if (finding.parted) return "a choice had fewer alternatives than the one taken; the run was over " + where;
  return "";
}

}  // namespace

ReplayRecord read_replay_record(ExploreOptions& options, std::uint64_t fingerprint) {
  return exploration::is_token(options.replay) ? of_token(options) : of_file(options, fingerprint);
}

void check_is_run_of(const ReplayRecord& record, const Replayed& run, const std::string& name) {
  const int shift = 64 - record.digest_bits;
  const std::string where = parting(record, run);
  const bool is_same = record.digest_bits == 0 ? where.empty() : run.finding.digest >> shift == record.digest >> shift;
  if (is_same) return;
  const std::string digests =
      fmt::format("it had {} events and a digest that begins with {}, the record says {}", run.finding.events,
                  exploration::digest_text(exploration::token_digest(run.finding.digest)),
                  exploration::digest_text(exploration::token_digest(record.digest)));
  throw BadInput(exploration::is_token(name) ? "--replay" : name,
                 "this is not the run of the record: " + (where.empty() ? digests : where));
}

}  // namespace waitpoint::tools
