// SPDX-License-Identifier: BSD-3-Clause
// A scenario from which runs set out: from its beginning, each with noise of its own, or from a time in mid-run that
// all have in common.
//
//   --from 40:   0 ===== default order ===== 40 +---- schedule 0 ----
//                                               +---- schedule 1 ----     each in a process of its own, forked there
//
// A scene that stands in mid-run can be left only once in a process; from the beginning, as often as one likes.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "fibers/explore/report/narrator.hpp"
#include "fibers/explore/schedules/explorer.hpp"
#include "modules/run/experiment.hpp"
#include "tools/explore/target.hpp"

namespace waitpoint::tools {

class Scene final : public Target {
 public:
  /// BadInput for a scenario that cannot be run. What is given must outlive the scene.
  Scene(const bridge::Scenario& scenario, std::span<const genom::ModuleType> types, const ExploreOptions& options,
        std::string replay);
  ~Scene() override;

  std::string name() const override { return scenario_.name; }
  std::uint64_t fingerprint() const override { return scenario_.fingerprint; }
  bool has_noise() const override { return true; }
  const ExploreOptions& options() const override { return options_; }
  /// Goes to the time from which runs part, if there is one.
  void prepare() override;
  void set_profile(exploration::Profile profile) override { profile_ = std::move(profile); }
  using Target::run;
  Finding run(const Plan& plan, const Request& request) override;

  /// After run().
  bridge::RunResult result() const;
  const std::vector<exploration::Told>& switches() const;
  const exploration::Schedule& schedule() const;

  /// The seed of the noise of schedule `number`; that of the first is the scenario's own, as `waitpoint run` has it.
  std::uint64_t noise(std::uint64_t number) const;

 private:
  struct Stage;
  void watch_and_carry_out(const Plan& plan, const Request& request, Finding& finding);
  void carry_out(Time until, Finding& finding);
  void judge(Finding& finding, bool goals_too) const;
  bool is_stopped() const;
  void tell_stop(Finding& finding) const;

  const bridge::Scenario& scenario_;
  std::span<const genom::ModuleType> types_;
  const ExploreOptions& options_;
  std::string replay_;
  bool judged_at_until_;  // whether a run that is cut short must have reached its goals by then
  exploration::Profile profile_;
  std::unique_ptr<Stage> stage_;
  bool is_left_ = false;
};

}  // namespace waitpoint::tools
