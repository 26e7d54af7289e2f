// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit/compare.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/command/interruption.hpp"
#include "tools/command/options/results.hpp"
#include "tools/fit/comparison.hpp"
#include "tools/fit/comparison_picture.hpp"
#include "tools/fit/log_scan.hpp"
#include "tools/output/json_document.hpp"
#include "tools/output/output_file.hpp"
#include "tools/replay/playback_run.hpp"
#include "tools/run/run_watchdog.hpp"

namespace waitpoint::tools {
namespace {

/// Tells of scans with more beams than the modules get.
std::string thinned_text(const logs::SensorLog& log) {
  std::size_t beams = 0;
  for (const logs::LoggedScan& scan : log.scans) beams = std::max(beams, scan.range_m.size());
  const std::size_t every = beam_stride(beams);
  return every == 1 ? "" : fmt::format("{}: one beam in {} of {}\n", log.file, every, beams);
}

}  // namespace

void declare(Command& command, CompareOptions& options) {
  command.description = "Compares two logs, such as of a real robot and of a simulated one (docs/fidelity.md).";
  command.examples = {"real.log simulated.bag --picture both.svg"};
  declare_log(command, options.first);
  declare_other_log(command, options.second);
  declare_summary(command, options.summary, options.json);
  declare_picture(command, options.picture, "draw the distribution functions of both");
  command.finally([&options] {
    options.second.scenario = options.first.scenario;
    options.second.modules = options.first.modules;
    options.second.assignments = options.first.assignments;
  });
}

int compare(const CompareOptions& options, std::span<const genom::ModuleType> types) {
  heed_signals();
  const RunWatchdog watchdog(RunWatchdog::usual_limit_s);
  std::optional<OutputFile> picture, summary;
  if (options.picture) picture.emplace(*options.picture);
  if (options.summary) summary.emplace(*options.summary);
  const std::optional<ReplayedLog> first = replayed_log(options.first, types);
  if (!first) return interrupted_status;
  const std::optional<ReplayedLog> second = replayed_log(options.second, types);
  if (!second) return interrupted_status;
  const std::vector<Sample> of_first = samples_of(*first), of_second = samples_of(*second);
  const std::vector<Compared> rows = compared(of_first, of_second);
  if (picture) {
    picture->write(comparison_picture_svg(first->log.file, of_first, second->log.file, of_second));
    picture->commit();
  }
  if (summary) {
    summary->write(comparison_json(first->log.file, second->log.file, rows));
    summary->commit();
  }
  write_text(fmt::format("{} and {}\n{}{}\n{}", first->log.file, second->log.file, thinned_text(first->log),
                         thinned_text(second->log), comparison_text(rows)),
             options.json);
  if (!options.json) return 0;
  return end_with_json("compare", 0, comparison_json(first->log.file, second->log.file, rows));
}

}  // namespace waitpoint::tools
