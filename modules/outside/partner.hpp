// SPDX-License-Identifier: BSD-3-Clause
// A process outside that takes part in a run: its messages become interventions, which the journal repeats without
// it.
#pragma once

#include <string>
#include <vector>

#include "core/time.hpp"
#include "modules/run/experiment.hpp"

namespace waitpoint::outside {

/// A partner's access to the run, which is between two windows.
class Host {
 public:
  virtual run::Experiment& experiment() = 0;
  /// For the world's next step.
  virtual void intervene(const std::string& text, const scenario::Location& written) = 0;
  /// For the person at the run: one line.
  virtual void tell(const std::string& of, const std::string& text) = 0;
  /// Tells it too; ends the run if faults are to.
  virtual void tell_fault(const std::string& of, const std::string& text) = 0;
  /// The run ends here.
  virtual void finish() = 0;

  /// The virtual time of the world's next step, where interventions act.
  Time next_step() {
    const world::World& world = experiment().world();
    return Time() + world.description().step * static_cast<std::int64_t>(world.steps() + 1);
  }

 protected:
  ~Host() = default;
};

class Partner {
 public:
  virtual ~Partner() = default;

  /// Before the run begins.
  virtual void begin(Host& host) = 0;
  /// After a window of the run: shows its state to the outside.
  virtual void publish(Host&) {}
  /// Before the next window: takes in received messages. Does not block.
  virtual void take_in(Host& host) = 0;
  /// One line for the summary.
  virtual std::string account() const = 0;
  /// So far, a line for each expectation of the scenario that only this partner can judge, and that is not met.
  virtual std::vector<std::string> unmet() const { return {}; }
};

}  // namespace waitpoint::outside
