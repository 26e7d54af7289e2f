// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/replay/replay_record.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "fibers/explore/schedules/token.hpp"
#include "fibers/explore/strategies/factory.hpp"

namespace waitpoint::tools {
namespace {

using exploration::Switch;
using exploration::Token;

/// Adopts the record's seed as the options'.
void take_seed(ExploreOptions& options, std::uint64_t seed) {
  if (options.seed_is_asked && options.seed != seed)
    throw BadInput(
        "--seed", fmt::format("expected {}, that of '{}', or no --seed, found {}", seed, options.replay, options.seed));
  options.seed = seed;
}

ReplayRecord of_token(ExploreOptions& options) {
  const Token token = exploration::read_token(options.replay);
  if (token.call != 0)
    throw BadInput("--replay",
                   "the token '" + options.replay +
                       "' belongs to a test that calls explore(); expected one of waitpoint explore, wx1.0...");
  ReplayRecord record;
  record.digest = std::uint64_t{token.digest} << 32;
  record.digest_bits = token.digest == 0 ? 0 : 32;
  record.trail = token.trail;
  options.memory = token.memory;
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
                               options.program.empty() || options.has_nodes ? "scenario with these --set and --property"
                                                                            : "program",
                               fingerprint, record.stored.fingerprint));
  if (record.stored.from != Time() + options.from.value_or(Duration()))
    throw BadInput(options.replay, 4, "expected the same time as --from");
  take_seed(options, record.stored.seed);
  record.digest = record.stored.digest;
  record.digest_bits = record.digest == 0 ? 0 : 64;
  record.trail = record.stored.trail;
  record.plan = {.number = record.stored.number, .drawn = false, .switches = record.stored.switches};
  // A killed process left nothing but the draw of its schedule.
  if (record.digest == 0 && record.stored.switches.empty()) {
    options.strategy = record.stored.strategy;
    record.plan = {.number = record.stored.number};
    if (exploration::make_strategy(options.strategy)->is_exhaustive())
      throw BadInput(options.replay, 3, "expected a strategy that draws its schedules, where no digest is known");
  }
  return record;
}

/// How far the run followed the record, which it left at the record's switch number `i`.
std::string known_before(const Replayed& run, std::size_t i) {
  if (i == 0 || run.told.size() < i) return "no switch of the record was reached before";
  return fmt::format("the run was the record's up to event {}", run.told[i - 1].event);
}

/// Where the run left the record, in words; empty if nowhere.
std::string parting(const ReplayRecord& record, const Replayed& run) {
  const Finding& finding = run.finding;
  const std::string where = fmt::format("after event {} at {} s", finding.events, to_string(finding.end));
  std::vector<Switch> met = run.schedule.switches;
  std::sort(met.begin(), met.end());
  for (std::size_t i = 0; i < record.plan.switches.size(); ++i) {
    const Switch& change = record.plan.switches[i];
    if (std::binary_search(met.begin(), met.end(), change)) continue;
    return fmt::format("line {}: event {} of task {:016x} did not reach a choice with this switch; {}",
                       line_of_switch(i), change.usual.sequence, change.usual.task, known_before(run, i));
  }
  for (std::size_t i = 0; i < record.plan.deviations.size(); ++i) {
    const auto& [number, chosen] = record.plan.deviations[i];
    if (number >= run.schedule.decisions.size())
      return fmt::format("choice {} was never reached: the run ended {}", number, where);
    if (const std::uint32_t count = run.schedule.decisions[number].count; chosen >= count)
      return fmt::format("choice {} has only {} alternatives, none of the number {}; {}", number, count, chosen,
                         known_before(run, i));
  }
  return finding.parted ? "a choice had fewer alternatives than the one taken; the run ended " + where : "";
}

}  // namespace

ReplayRecord read_replay_record(ExploreOptions& options, std::uint64_t fingerprint) {
  return exploration::is_token(options.replay) ? of_token(options) : of_file(options, fingerprint);
}

void check_is_run_of(const ReplayRecord& record, const Replayed& run, const std::string& name) {
  const int shift = 64 - record.digest_bits;
  const std::string where = parting(record, run);
  const bool is_known = record.digest_bits != 0;
  if (is_known ? run.finding.digest >> shift == record.digest >> shift : where.empty() && !run.finding.passed()) return;
  const std::string source = exploration::is_token(name) ? "--replay" : name;
  if (!is_known && where.empty())
    throw BadInput(source, "this is not the run of the record: that one crashed or was killed, this one passed");
  std::string digests = fmt::format("it had {} and a digest that begins with {}, the record says {}",
                                    counted(run.finding.events, "event"),
                                    exploration::digest_text(exploration::token_digest(run.finding.digest)),
                                    exploration::digest_text(exploration::token_digest(record.digest)));
  exploration::Trail met;
  if (!record.trail.marks.empty() && exploration::read_trail(run.finding.evidence.trail, met))
    digests += ": it left the record " + exploration::parting(record.trail, met);
  throw BadInput(source, "this is not the run of the record: " + (where.empty() ? digests : where));
}

}  // namespace waitpoint::tools
