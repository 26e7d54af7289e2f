// SPDX-License-Identifier: BSD-3-Clause
// How a module's task computes: its local clock, and the processor that it shares. Both are the scenario's to say, for
// a task under `tasks.<task>`, processor and priority for all tasks of a module beside its other parameters:
//
//   processor: cpu                    # declared by the robot; without it, each task has one of its own
//   priority: 10                      # the greater the more urgent
//   tasks:
//     motion: {clock: {kind: interval, cost_us: [100, 300], scale: x0.5}, priority: 20}
//     control: {clock: cpu}           # the module's control task
#pragma once

#include "modules/genom/name_space.hpp"
#include "modules/genom/settings.hpp"

namespace waitpoint::genom {

struct TaskComputing {
  threads::ClockOptions clock;
  threads::processor* on = nullptr;
  int priority = 0;
};

/// Reads `processor` and `priority` after `prefix`, which overwrite `defaults`. BadInput for a processor that the robot
/// does not declare.
TaskComputing read_processor(Settings& settings, const std::string& prefix, const NameSpace& names,
                             TaskComputing defaults = {});

/// Reads all that there is after `prefix`: "tasks.motion.".
TaskComputing read_computing(Settings& settings, const std::string& prefix, const NameSpace& names,
                             const TaskComputing& defaults);

}  // namespace waitpoint::genom
