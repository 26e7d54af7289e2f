// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/search/discoveries.hpp"

#include <cstdio>

namespace waitpoint::exploration {

std::string Discoveries::replay_of(const FailedRun& run) const {
  return target_.replay_command(run.finding, to_text(token_of(run, options_, call_)));
}

void Discoveries::take(FailedRun run) {
  std::vector<std::string> lines;
  if (options_.races == Races::report && !run.finding.evidence.races.empty())
    lines = races_.take(run.finding.evidence.races, name_of(run, options_), replay_of(run));
  const RunVerdict::Kind kind = run.finding.kind;
  const bool is_first = kind != RunVerdict::Kind::passed && !first_.contains(kind);
  if (is_first && progress_ != nullptr && (kind != RunVerdict::Kind::race || options_.races == Races::fail))
    lines.push_back(name_of(run, options_) + ": " + run.finding.headline());
  if (is_first) first_.emplace(kind, std::move(run));
  if (lines.empty()) return;
  if (progress_ != nullptr) progress_->finish();
  for (const std::string& line : lines) std::fprintf(stderr, "waitpoint: %s\n", line.c_str());
}

std::string Discoveries::besides(const FailedRun& reported, const std::vector<ToldRace>& told) const {
  std::string text;
  for (const auto& [kind, run] : first_)
    if (kind != reported.finding.kind && kind != RunVerdict::Kind::race)
      text.insert(0, "also found, by " + name_of(run, options_) + ": " + run.finding.headline() +
                         "\nreplay: " + replay_of(run) + "\n");
  return text + races_.besides(told);
}

}  // namespace waitpoint::exploration
