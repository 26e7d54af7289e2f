// SPDX-License-Identifier: BSD-3-Clause
// An unmodified program with simulated threads: it fails by its exit status, a signal, a deadlock or a lack of
// progress.
//
// Each run is a process forked just before the program's main(). All runs have the same random numbers and addresses;
// only the schedules differ, and their switch points.
#pragma once

#include <set>

#include "tools/exec/fork_server.hpp"
#include "tools/exec/linked_libraries.hpp"
#include "tools/explore/runs/run_streams.hpp"
#include "tools/explore/runs/snapshot_tree.hpp"
#include "tools/explore/runs/target.hpp"
#include "tools/nodes/log_folder.hpp"

namespace waitpoint::tools {

class ProgramTarget final : public ProcessTarget {
 public:
  /// BadInput for a program that cannot be simulated. The options must outlive this.
  explicit ProgramTarget(const ExploreOptions& options);

  ~ProgramTarget() override;

  std::string name() const override {
    return options_.has_nodes ? options_.scenario.stem().string() : calls_.files.programs.title();
  }
  std::uint64_t fingerprint() const override { return fingerprint_; }
  exploration::TargetTraits traits() const override;
  const ExploreOptions& options() const override { return options_; }
  /// Starts it once, up to main().
  void prepare() override;
  using ProcessTarget::run;
  Finding run(const Plan& plan, const WantedEvidence& wanted) override;

 private:
  bool has_processes() const override { return true; }

  // The runs with the same switch points, and the process that makes them.
  struct Runs {
    explicit Runs(const ProgramFiles& of) : files(of) {}

    ProgramFiles files;
    std::optional<exploration::Profile> profile = {};  // of the default order with these switch points
    RunStreams streams = {};                           // of the present or last run
    std::optional<ForkServer> server = {};
  };

  bool shows_new_races(const Finding& finding);
  const exploration::Profile& profile_of_calls();
  AccessObstacle prepare_accesses();
  AccessObstacle learn_accesses();
  Finding run_at_accesses(const Plan& plan, const WantedEvidence& wanted);
  Finding observe_accesses(const Plan& plan);
  Finding run_at_calls(const Plan& plan, const WantedEvidence& wanted);
  Finding run_once(Runs& runs, const Plan& plan, const WantedEvidence& wanted, const exploration::Profile& profile);
  Finding run_in_process(Runs& runs, const posix::Settings& settings, const Plan& plan, const WantedEvidence& wanted,
                         const exploration::Profile& profile, bool makes_snapshots);
  RunMemory& begin_run(Runs& runs, const posix::Settings& settings, const Plan& plan, const WantedEvidence& wanted,
                       bool makes_snapshots);

  const ExploreOptions& options_;
  Runs calls_;                    // with accesses, too, if the program is instrumented
  std::optional<Runs> accesses_;  // with breakpoints
  std::optional<AccessObstacle> obstacle_ = {};
  std::uint64_t libraries_ = 0;  // that were loaded in runs at accesses: a bit for each
  std::uint64_t fingerprint_;
  Waits waits_;
  std::set<exploration::RacingCode> told_;         // the races of this process's findings so far
  std::optional<LogFolder> logs_, own_logs_ = {};  // of all processes that make runs, and of this one; for nodes
  SnapshotTree snapshots_;                         // of runs at calls; they end before their server
};

/// A digest of the program's file, its words and the settings that its runs share.
std::uint64_t fingerprint_of(const ProgramFiles& files, const ExploreOptions& options);

/// BadInput if the options ask for weak memory, which only instrumented programs have.
void check_memory(const ExploreOptions& options, const ProgramFiles& files);

}  // namespace waitpoint::tools
