// SPDX-License-Identifier: BSD-3-Clause
// What --replay names, a token or a file: the run that is to be repeated, and by what it is known.
#pragma once

#include "fibers/explore/report/narrator.hpp"
#include "tools/explore/explore_options.hpp"
#include "tools/explore/finding.hpp"
#include "tools/explore/plan.hpp"
#include "tools/explore/schedule_file.hpp"

namespace waitpoint::tools {

struct ReplayRecord {
  Plan plan;
  std::uint64_t digest = 0;  ///< 0: not known
  int digest_bits = 0;       ///< so many of the upper ones are known
  exploration::Trail trail;  ///< where it is known
  StoredSchedule stored;     ///< of a file
};

/// A run by the plan of a record.
struct Replayed {
  const exploration::Schedule& schedule;
  const std::vector<exploration::Told>& told;  ///< its switches
  const Finding& finding;
};

/// Of options.replay, for the target of this fingerprint; the record's strategy and seed become the options'. BadInput
/// for a token or a file of something else.
ReplayRecord read_replay_record(ExploreOptions& options, std::uint64_t fingerprint);

/// BadInput, which says where it parted, for a run that is another one than that of the record; `name` is what
/// --replay named.
void check_is_run_of(const ReplayRecord& record, const Replayed& run, const std::string& name);

}  // namespace waitpoint::tools
