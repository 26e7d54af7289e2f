// SPDX-License-Identifier: BSD-3-Clause
// Executes the schedules of a search in processes, several at once: as many as the options have jobs.
#pragma once

#include <deque>

#include "fibers/explore/search/runner.hpp"
#include "tools/explore/runs/target.hpp"
#include "tools/explore/search/batches.hpp"

namespace waitpoint::tools {

class Jobs final : public exploration::Runner {
 public:
  explicit Jobs(ProcessTarget& target);

  bool is_apart() const override { return true; }
  std::uint32_t capacity() const override;
  void start(const Batch& batch) override;
  void start(std::uint64_t place, exploration::Enumeration& enumeration) override;
  bool start_rest(std::uint64_t end) override;
  bool is_idle() const override { return ended_.empty() && target_.runs().count() == 0; }
  exploration::EndedSchedule* next_ended() override;
  void kill_from(std::uint64_t place) override;
  bool is_interrupted() const override;

 private:
  void request(const Batch& batch, const Plan& plan, const WantedEvidence& wanted);
  void take(const Children::Ended& ended);

  ProcessTarget& target_;
  Batches batches_;
  std::deque<exploration::EndedSchedule> ended_;
  exploration::EndedSchedule last_ = {};
};

}  // namespace waitpoint::tools
