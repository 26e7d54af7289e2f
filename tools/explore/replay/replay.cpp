// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/replay/replay.hpp"

#include <optional>

#include "core/error.hpp"
#include "tools/command/system_confinement.hpp"
#include "tools/explore/replay/replay_json.hpp"
#include "tools/explore/replay/replay_record.hpp"
#include "tools/explore/runs/replay_command.hpp"
#include "tools/explore/runs/scene.hpp"
#include "tools/output/json_document.hpp"
#include "tools/output/output_file.hpp"
#include "tools/output/progress.hpp"
#include "tools/output/summary.hpp"

namespace waitpoint::tools {

int replay(const ExploreOptions& asked, const scenario::Scenario& scenario, std::span<const genom::ModuleType> types) {
  ExploreOptions options = asked;
  const ReplayRecord record = read_replay_record(options, scenario.fingerprint);
  std::optional<OutputFile> trace;
  if (options.trace) trace.emplace(*options.trace);
  const std::string command = replay_command(options, options.replay);
  Scene scene(scenario, types, options, command);
  confine_to_listed_files();
  if (record.plan.drawn && needs_profile(options.strategy)) {
    Scene usual(scenario, types, options, command);
    usual.prepare();
    scene.set_profile(usual.run({.drawn = false}, {.profile = true}).lesson.profile);
  }
  const double start_s = wall_clock_s();
  scene.prepare();
  WantedEvidence wanted{.words = !record.plan.drawn, .places = true};
  if (options.trace) wanted.events = {.trace = true};
  if (!wanted.events && !record.trail.marks.empty()) wanted.trail = record.trail.log_spacing;
  const Finding finding = scene.run(record.plan, wanted);
  check_is_run_of(record, {scene.schedule(), scene.switches(), finding}, options.replay);
  bridge::RunResult result = scene.result();
  result.seed = options.seed;  // not the seed of the schedule's noise, which is derived from it
  result.wall_s = wall_clock_s() - start_s;
  result.real_time_factor = result.wall_s > 0 ? result.simulated.seconds() / result.wall_s : 0;
  write_text(summary_text(result), options.json);
  if (trace) {
    trace->write(finding.evidence.trace);
    trace->commit();
  }
  if (record.digest_bits > 0) write_text("\nthe same run as in the record\n", options.json);
  if (!finding.passed()) std::fprintf(stderr, "waitpoint: failed: %s\n", finding.words.c_str());
  const int status = finding.passed() ? 0 : 1;
  if (!options.json) return status;
  return end_with_json("explore", status, replay_json(options, record, finding, summary_json(result)));
}

}  // namespace waitpoint::tools
