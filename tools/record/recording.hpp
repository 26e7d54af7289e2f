// SPDX-License-Identifier: BSD-3-Clause
// What happens in a run, for viewers: `--record FILE.mcap` for Foxglove, `--record FILE.log` for CARMEN's tools.
//
// A recording looks at the world and at the robots' posters after each step of the world. Looking is no event: a run is
// the same whether it is recorded or not, and the same run gives the same bytes.
#pragma once

#include <exception>

#include "modules/run/experiment.hpp"

namespace waitpoint::tools {

class Recording {
 public:
  virtual ~Recording() = default;
  /// Before the run, which it must outlive. The scenario is the experiment's.
  virtual void begin(bridge::Experiment& experiment) = 0;
  /// After a step of the world, at `now`. Throws nothing, as it would be through the world's task: what fails is told
  /// by finish().
  void observe(const bridge::Experiment& experiment, Time now);
  /// The run is over: gives the file its name. Throws BadInput where it could not be written.
  void finish(const bridge::RunResult& result);

 private:
  virtual void record(const bridge::Experiment& experiment, Time now) = 0;
  virtual void commit(const bridge::RunResult& result) = 0;

  std::exception_ptr failure_;
};

}  // namespace waitpoint::tools
