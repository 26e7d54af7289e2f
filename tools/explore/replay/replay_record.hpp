// SPDX-License-Identifier: BSD-3-Clause
// The record that --replay names, a token or a file: a run to repeat, and its identification.
#pragma once

#include "fibers/explore/report/narrator.hpp"
#include "fibers/explore/target/plan.hpp"
#include "tools/explore/replay/schedule_file.hpp"
#include "tools/explore/runs/explore_options.hpp"
#include "tools/explore/runs/finding.hpp"

namespace waitpoint::tools {

struct ReplayRecord {
  Plan plan;
  std::uint64_t digest = 0;  ///< 0: unknown
  int digest_bits = 0;       ///< number of known upper bits of the digest
  exploration::Trail trail;  ///< if known
  StoredSchedule stored;     ///< of a file
};

/// A run by a record's plan.
struct Replayed {
  const exploration::Schedule& schedule;
  const std::vector<exploration::Told>& told;  ///< its switches
  const Finding& finding;
};

/// Reads options.replay, for the target with this fingerprint; the record's strategy and seed become the options'.
/// BadInput for a token or a file of another target.
ReplayRecord read_replay_record(ExploreOptions& options, std::uint64_t fingerprint);

/// BadInput, with the first difference, if the run differs from the record's; `name` is the argument of --replay.
void check_is_run_of(const ReplayRecord& record, const Replayed& run, const std::string& name);

}  // namespace waitpoint::tools
