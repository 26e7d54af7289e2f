// SPDX-License-Identifier: BSD-3-Clause
// One run in short windows of virtual time. Between windows it shows progress, polls signals, waits for the wall clock
// and accepts commands and messages of partners outside. The windows do not affect the run.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <optional>

#include "modules/outside/partners.hpp"
#include "modules/run/experiment.hpp"
#include "modules/run/journal.hpp"
#include "tools/output/progress.hpp"
#include "tools/run/journal_file.hpp"
#include "tools/run/pacing.hpp"
#include "tools/view/history/live_run.hpp"

namespace waitpoint::tools {

class Session : private outside::Host {
 public:
  /// Reason for the return of carry_on().
  enum class Stop {
    target,       ///< everything before the target time is done
    over,         ///< the run has ended, or its last time is reached
    enough,       ///< `enough` returned true after an event
    asked,        ///< `heed` returned true
    interrupted,  ///< by a signal
  };
  using Enough = std::function<bool(const kernel::EventRecord&)>;
  using Heed = std::function<bool()>;
  using Second = std::function<void(std::int64_t)>;

  /// A run to `until` at the latest. `second` is called after each simulated second, with their number, and at the end.
  Session(run::Experiment& experiment, Time until, double speed, Second second);

  /// Also writes interventions to the journal from now on, with their dates.
  void keep(JournalFile& journal) { journal_ = &journal; }

  /// Shows the run, from now on.
  void show(view::LiveRun& live);

  /// Takes in partners' messages, from now on, before each step of the world, whose state they get after it.
  /// `faults_end`: their first fault ends the run.
  void take_part(outside::Partners& partners, bool faults_end);

  /// Continues to `target`, or to the event after which `enough` returns true. `heed` is called at least ten times a
  /// second, and stops the run by returning true.
  Stop carry_on(Time target, const Enough& enough = nullptr, const Heed& heed = nullptr);

  /// See Experiment::intervene; recorded in the journal.
  Time intervene(const run::Intervention& intervention, std::optional<Time> date = std::nullopt);
  /// Changes the speed from now on.
  void set_speed(double speed) { pacing_.restart(now(), speed); }
  double speed() const { return pacing_.speed(); }

  /// Everything before this time is done; after a stop between two events of an instant, also part of that instant.
  Time now() const;
  Time until() const { return until_; }
  bool over() const { return end_ != RunEnd::time_reached || reached_ >= until_ || !fault_.empty() || is_finished_; }
  /// A partner has ended the run.
  bool is_finished() const { return is_finished_; }
  /// The fault of a partner that ended the run.
  const std::string& fault() const { return fault_; }
  /// True if partners take part: they live in real time, so that the speed cannot be changed.
  bool has_partners() const { return partners_ != nullptr; }
  /// The run's current position, for the journal.
  run::JournalEnd here() const;
  run::Experiment& experiment() override { return experiment_; }

  /// The results so far, with the wall clock's figures.
  bridge::RunResult result() const;

 private:
  Stop carry_on_in_windows(Time target, const Enough& enough, const Heed& heed);
  void close_window(Time end);
  void end_forked_copy();
  void tell_outcomes();
  void tell_lag();
  void show_window();
  void intervene(const std::string& text, const scenario::Location& written) override;
  void tell(const std::string& of, const std::string& text) override;
  void tell_fault(const std::string& of, const std::string& text) override;
  void finish() override { is_finished_ = true; }

  run::Experiment& experiment_;
  Time until_;
  Second second_;
  Progress progress_;
  Pacing pacing_;
  JournalFile* journal_ = nullptr;
  outside::Partners* partners_ = nullptr;
  view::LiveRun* live_ = nullptr;
  bool faults_end_ = false, is_behind_ = false, is_finished_ = false;
  std::string fault_;
  Duration window_;
  RunEnd end_ = RunEnd::time_reached;
  Time reached_;
  double wall_s_ = 0;
  pid_t process_;            // of the run
  std::size_t printed_ = 0;  // outcomes of interventions
};

}  // namespace waitpoint::tools
