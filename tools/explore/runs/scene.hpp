// SPDX-License-Identifier: BSD-3-Clause
// A scenario as the origin of runs: from its beginning, each with its own noise, or from a time in mid-run, up to which
// all share one run.
//
//   --from 40:   0 ===== default order ===== 40 +---- schedule 0 ----
//                                               +---- schedule 1 ----     each in a process of its own, forked there
//
// A scene in mid-run supports one run per process; from the beginning, any number.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "fibers/explore/schedules/explorer.hpp"
#include "fibers/explore/target/evidence_recorder.hpp"
#include "modules/run/experiment.hpp"
#include "tools/explore/runs/target.hpp"

namespace waitpoint::tools {

class FloorFrames;

class Scene final : public ProcessTarget {
 public:
  /// BadInput for an invalid scenario. The arguments must outlive the scene.
  Scene(const scenario::Scenario& scenario, std::span<const genom::ModuleType> types, const ExploreOptions& options,
        std::string replay);
  ~Scene() override;

  std::string name() const override { return scenario_.name; }
  std::uint64_t fingerprint() const override { return scenario_.fingerprint; }
  exploration::TargetTraits traits() const override;
  const ExploreOptions& options() const override { return options_; }
  /// Advances to the time at which runs part, if one is set.
  void prepare() override;
  using ProcessTarget::run;
  Finding run(const Plan& plan, const WantedEvidence& wanted) override;

  /// After run().
  bridge::RunResult result() const;
  const std::vector<exploration::Told>& switches() const;
  const exploration::Schedule& schedule() const;

  /// The seed of schedule `number`'s noise; number 0 has the scenario's own, as in `waitpoint run`.
  std::uint64_t noise(std::uint64_t number) const;

 private:
  bool has_processes() const override { return false; }
  struct Stage;
  void record_and_carry_out(const Plan& plan, const WantedEvidence& wanted, Finding& finding);
  void carry_out(Time until, const exploration::EvidenceRecorder& recording, FloorFrames* floor, Finding& finding);
  void judge(Finding& finding, bool goals_too) const;

  const scenario::Scenario& scenario_;
  std::span<const genom::ModuleType> types_;
  const ExploreOptions& options_;
  std::string replay_;
  bool judged_at_until_;  // a run cut short must have reached its goals by then
  std::unique_ptr<Stage> stage_;
  bool is_left_ = false;
};

}  // namespace waitpoint::tools
