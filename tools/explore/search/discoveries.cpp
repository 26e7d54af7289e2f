// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search/discoveries.hpp"

#include <cstdio>

#include "tools/explore/runs/switch_points.hpp"

namespace waitpoint::tools {

void Discoveries::take(FailedRun run) {
  const ExploreOptions& options = target_.options();
  std::vector<std::string> lines;
  if (options.races == Races::report && !run.finding.evidence.races.empty())
    lines =
        races_.take(run.finding.evidence.races, name_of(run, options),
                    replay_command(with_switches_at(run.finding.switch_at, options), to_text(token_of(run, options))));
  const ProcessFinding::Kind kind = run.finding.kind;
  const bool is_first = kind != ProcessFinding::Kind::passed && !first_.contains(kind);
  if (is_first && (kind != ProcessFinding::Kind::race || options.races == Races::fail))
    lines.push_back(name_of(run, options) + ": " + run.finding.headline());
  if (is_first) first_.emplace(kind, std::move(run));
  if (lines.empty()) return;
  progress_.finish();
  for (const std::string& line : lines) std::fprintf(stderr, "waitpoint: %s\n", line.c_str());
}

std::string Discoveries::besides(const std::vector<ToldRace>& told) const {
  const ExploreOptions& options = target_.options();
  std::string text;
  for (const auto& [kind, run] : first_)
    if (&run != gravest() && kind != ProcessFinding::Kind::race)
      text.insert(
          0, "also found, by " + name_of(run, options) + ": " + run.finding.headline() + "\nreplay: " +
                 replay_command(with_switches_at(run.finding.switch_at, options), to_text(token_of(run, options))) +
                 "\n");
  return text + races_.besides(told);
}

}  // namespace waitpoint::tools
