// SPDX-License-Identifier: BSD-3-Clause
// Executes the schedules of a search of a body: in this process, one after the other.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "fibers/explore/body.hpp"
#include "fibers/explore/races/distinct_races.hpp"
#include "fibers/explore/search/pair_sample.hpp"
#include "fibers/explore/search/runner.hpp"
#include "fibers/explore/supervisor.hpp"
#include "fibers/explore/target/explore_options.hpp"

namespace waitpoint::exploration {

class BodyRuns final : public Runner {
 public:
  /// All must outlive this.
  BodyRuns(Body& body, const ExploreOptions& options, const Profile& profile, Supervisor& supervisor);

  bool is_apart() const override { return false; }
  std::uint32_t capacity() const override { return has_ended_ ? 0 : 1; }
  void start(const Batch& batch) override;
  void start(std::uint64_t place, Enumeration& enumeration) override;
  bool is_idle() const override { return !has_ended_; }
  EndedSchedule* next_ended() override { return std::exchange(has_ended_, false) ? &ended_ : nullptr; }

  /// The finding of the last run, which had this verdict; with its data races, if they are to be reported, that no run
  /// before had.
  Finding finding_of(const RunVerdict& verdict);

 private:
  void run(Strategy& strategy, const std::string& name, std::uint64_t place, std::uint64_t number);

  Body& body_;
  const ExploreOptions& options_;
  const Profile& profile_;
  Supervisor& supervisor_;
  std::unique_ptr<Strategy> drawing_;
  const SampledSchedules sampled_;
  ReadsFromRelation relation_;  // of a sampled schedule, the last one
  races::DistinctRaces new_races_;
  EndedSchedule ended_ = {};  // the last one
  bool has_ended_ = false;
};

}  // namespace waitpoint::exploration
