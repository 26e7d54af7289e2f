// SPDX-License-Identifier: BSD-3-Clause
// One run as the program carries it out: in short windows of virtual time, between which progress is shown, signals
// are heeded, the wall clock is waited for and somebody may do something. The windows change nothing in the run.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "modules/run/experiment.hpp"
#include "modules/run/journal.hpp"
#include "tools/output/progress.hpp"
#include "tools/run/journal_file.hpp"
#include "tools/run/pacing.hpp"

namespace waitpoint::tools {

class Session {
 public:
  /// Why carry_on() came back.
  enum class Stop {
    target,       ///< all before the time asked for is done
    over,         ///< the run has ended, or its last time is reached
    enough,       ///< after the event at which `enough` said so
    asked,        ///< `heed` said so
    interrupted,  ///< by a signal
  };
  using Enough = std::function<bool(const kernel::EventRecord&)>;
  using Heed = std::function<bool()>;
  using Second = std::function<void(std::int64_t)>;

  /// A run to `until` at the latest. `second` is called when that many simulated seconds are done, and at the end.
  Session(bridge::Experiment& experiment, Time until, double speed, Second second);

  /// What is done from now on is written there too, with its date.
  void keep(JournalFile& journal) { journal_ = &journal; }

  /// Carries on to `target`, or to the event at which `enough`, which is asked after each, says so. `heed` is called
  /// ten times a second or more, and stops the run by true.
  Stop carry_on(Time target, const Enough& enough = nullptr, const Heed& heed = nullptr);

  /// See Experiment::intervene; kept in the journal.
  Time intervene(const bridge::Intervention& intervention, std::optional<Time> date = std::nullopt);
  /// Another speed from now on.
  void set_speed(double speed) { pacing_.restart(now(), speed); }
  double speed() const { return pacing_.speed(); }

  /// What is before is done; where the run stopped between two events of an instant, some of that instant too.
  Time now() const;
  Time until() const { return until_; }
  bool over() const { return end_ != RunEnd::time_reached || reached_ >= until_; }
  /// Where the run is now, for the journal.
  bridge::JournalEnd here() const;
  bridge::Experiment& experiment() { return experiment_; }

  /// What has come out so far, with the figures of the wall clock.
  bridge::RunResult result() const;

 private:
  Stop carry_on_in_windows(Time target, const Enough& enough, const Heed& heed);
  void close_window(Time end);
  void tell_outcomes();

  bridge::Experiment& experiment_;
  Time until_;
  Second second_;
  Progress progress_;
  Pacing pacing_;
  JournalFile* journal_ = nullptr;
  RunEnd end_ = RunEnd::time_reached;
  Time reached_;
  double wall_s_ = 0;
  std::size_t told_ = 0;  // outcomes of interventions
};

}  // namespace waitpoint::tools
