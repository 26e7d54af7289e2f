// SPDX-License-Identifier: BSD-3-Clause
// Computing of a module's tasks: the local clock of each, and the processor that it shares. A scenario sets them for a
// task under `tasks.<task>`; processor and priority also for all tasks of a module, beside its parameters:
//
//   processor: cpu                    # declared by the robot; default: a processor per task
//   priority: 10                      # greater is more urgent
//   tasks:
//     motion: {clock: {kind: interval, cost_us: [100, 300], scale: x0.5}, priority: 20}
//     control: {clock: cpu}           # the module's control task
#pragma once

#include <span>
#include <string_view>

#include "modules/genom/name_space.hpp"
#include "modules/genom/settings.hpp"

namespace waitpoint::genom {

struct TaskComputing {
  threads::ClockOptions clock;
  threads::processor* on = nullptr;
  int priority = 0;
};

/// The words for the kinds of clocks.
std::span<const std::string_view> clock_kinds();

/// Reads `processor` and `priority` behind `prefix`, which override `defaults`. A processor that the robot does not
/// declare is BadInput.
TaskComputing read_processor(Settings& settings, const std::string& prefix, const NameSpace& names,
                             TaskComputing defaults = {});

/// Reads processor, priority and clock behind `prefix`, such as "tasks.motion.".
TaskComputing read_computing(Settings& settings, const std::string& prefix, const NameSpace& names,
                             const TaskComputing& defaults);

}  // namespace waitpoint::genom
