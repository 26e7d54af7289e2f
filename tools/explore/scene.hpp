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
#include <optional>
#include <span>
#include <string>

#include "fibers/explore/explorer.hpp"
#include "fibers/explore/profile.hpp"
#include "fibers/explore/timeline.hpp"
#include "modules/bridge/experiment.hpp"
#include "tools/explore/explore_options.hpp"
#include "tools/explore/finding.hpp"
#include "tools/explore/narrator.hpp"
#include "tools/explore/plan.hpp"

namespace waitpoint::tools {

class Scene {
 public:
  /// What is to be seen of a run beside what it comes to.
  struct Request {
    bool profile = false;
    bool words = false;   ///< switches in words
    bool places = false;  ///< where in the source tasks stand that a report names
    exploration::Timeline* timeline = nullptr;
    Time timeline_from = Time();
    std::optional<std::size_t> decision = {};  ///< what was chosen there
  };

  /// BadInput for a scenario that cannot be run. What is given must outlive the scene.
  Scene(const bridge::Scenario& scenario, std::span<const genom::ModuleType> types, const ExploreOptions& options,
        std::string replay);
  ~Scene();

  /// Goes to the time from which runs part, if there is one.
  void prepare();
  /// How the default order goes from here on: for strategies that are to know.
  void set_profile(exploration::Profile profile) { profile_ = std::move(profile); }
  /// Whether a drawn schedule depends on that.
  bool needs_profile() const;

  /// One run in this process, by the plan.
  Finding run(const Plan& plan, const Request& request);
  Finding run(const Plan& plan) { return run(plan, Request()); }

  /// After run().
  bridge::RunResult result() const;
  const std::vector<Told>& switches() const;
  const exploration::Schedule& schedule() const;

  const bridge::Scenario& scenario() const { return scenario_; }
  const ExploreOptions& options() const { return options_; }
  /// The seed of the noise of schedule `number`; that of the first is the scenario's own, as `waitpoint run` has it.
  std::uint64_t noise(std::uint64_t number) const;

 private:
  struct Stage;
  void watch_and_carry_out(const Plan& plan, const Request& request, Finding& finding);
  void carry_out(Time until, Finding& finding);
  void judge(Finding& finding, bool goals_too) const;

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
