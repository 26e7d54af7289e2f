// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "core/error.hpp"
#include "fibers/explore/token.hpp"
#include "tools/explore/failure_report.hpp"
#include "tools/output_file.hpp"
#include "tools/progress.hpp"
#include "tools/summary.hpp"

namespace waitpoint::tools {
namespace {

using exploration::Switch;
using exploration::Token;

/// What is to be repeated.
struct Record {
  Plan plan;
  std::uint64_t digest = 0;  ///< 0: not known
  int digest_bits = 0;       ///< so many of the upper ones are known
  StoredSchedule stored;     ///< of a file
};

Record of_token(ExploreOptions& options) {
  const Token token = exploration::read_token(options.replay);
  if (token.call != 0)
    throw BadInput("--replay", "the token '" + options.replay +
                                   "' is of a test that explores; expected one of waitpoint explore, wx1.0...");
  Record record;
  record.digest = std::uint64_t{token.digest} << 32;
  record.digest_bits = token.digest == 0 ? 0 : 32;
  if (token.strategy.empty()) {
    record.plan = {.drawn = false, .deviations = token.deviations};
  } else {
    if (exploration::make_strategy(token.strategy)->is_exhaustive())
      throw BadInput("--replay", "expected a strategy that draws its schedules in the token '" + options.replay + "'");
    options.strategy = token.strategy;
    options.seed = token.seed;
    record.plan = {.number = token.number};
  }
  return record;
}

Record of_file(ExploreOptions& options, const bridge::Scenario& scenario) {
  Record record;
  record.stored = read_schedule(options.replay);
  if (record.stored.fingerprint != scenario.fingerprint)
    throw BadInput(options.replay, 2,
                   fmt::format("expected a schedule of this scenario with these --set and --property, {:016x}, found "
                               "one of {:016x}",
                               scenario.fingerprint, record.stored.fingerprint));
  if (record.stored.from != Time() + options.from.value_or(Duration()))
    throw BadInput(options.replay, 4, "expected the same time as --from");
  options.seed = record.stored.seed;
  record.digest = record.stored.digest;
  record.digest_bits = record.digest == 0 ? 0 : 64;
  record.plan = {.number = record.stored.number, .drawn = false, .switches = record.stored.switches};
  return record;
}

/// Where the run left the record, in words; empty if it did not.
std::string parting(const Record& record, const Scene& scene, const Finding& finding) {
  const std::string where = fmt::format("behind event {} at {} s", finding.events, to_string(finding.end));
  std::vector<Switch> met = scene.schedule().switches;
  std::sort(met.begin(), met.end());
  for (std::size_t i = 0; i < record.plan.switches.size(); ++i) {
    const Switch& change = record.plan.switches[i];
    if (std::binary_search(met.begin(), met.end(), change)) continue;
    const std::vector<Told>& told = scene.switches();
    return fmt::format(
        "line {}: event {} of task {:016x} did not come to a choice that has this switch; the run left "
        "the record after event {}",
        line_of_switch(i), change.usual.sequence, change.usual.task, i == 0 || told.size() < i ? 0 : told[i - 1].event);
  }
  for (const auto& deviation : record.plan.deviations)
    if (deviation.decision >= scene.schedule().decisions.size())
      return fmt::format("choice {} was never come to: the run was over {}", deviation.decision, where);
  if (finding.parted) return "a choice had fewer alternatives than the one taken; the run was over " + where;
  return "";
}

// Throws BadInput if the run is another one than that of the record.
void check_is(const Record& record, const Scene& scene, const Finding& finding, const std::string& name) {
  const int shift = 64 - record.digest_bits;
  const std::string where = parting(record, scene, finding);
  const bool is_same = record.digest_bits == 0 ? where.empty() : finding.digest >> shift == record.digest >> shift;
  if (!is_same)
    throw BadInput(exploration::is_token(name) ? "--replay" : name,
                   "this is not the run of the record" + (where.empty() ? "" : ": " + where));
}

}  // namespace

int replay(const ExploreOptions& asked, const bridge::Scenario& scenario, std::span<const genom::ModuleType> types) {
  ExploreOptions options = asked;
  const bool is_token = exploration::is_token(options.replay);
  const Record record = is_token ? of_token(options) : of_file(options, scenario);
  std::optional<OutputFile> trace;
  if (options.trace) trace.emplace(*options.trace);
  const std::string command = replay_command(options) + " --replay " + options.replay;
  Scene scene(scenario, types, options, command);
  if (record.plan.drawn && scene.needs_profile()) {
    Scene usual(scenario, types, options, command);
    usual.prepare();
    scene.set_profile(usual.run({.drawn = false}, {.profile = true}).profile);
  }
  const double start_s = wall_clock_s();
  scene.prepare();
  exploration::Timeline timeline;
  const Finding finding = scene.run(
      record.plan, {.words = record.plan.switches.size() > 0, .places = true, .timeline = trace ? &timeline : nullptr});
  check_is(record, scene, finding, options.replay);
  bridge::RunResult result = scene.result();
  result.wall_s = wall_clock_s() - start_s;
  result.real_time_factor = result.wall_s > 0 ? result.simulated.seconds() / result.wall_s : 0;
  std::fputs(summary_text(result).c_str(), stdout);
  if (trace) {
    std::ostringstream text;
    write_trace(text, timeline);
    trace->write(text.str());
    trace->commit();
  }
  if (record.digest_bits > 0) std::puts("\nthe same run as in the record");
  if (std::fflush(stdout) != 0) throw BadInput("standard output", "cannot be written");
  if (!finding.passed()) std::fprintf(stderr, "waitpoint: failed: %s\n", finding.words.c_str());
  return finding.passed() ? 0 : 1;
}

}  // namespace waitpoint::tools
