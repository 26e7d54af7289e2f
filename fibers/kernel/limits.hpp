// SPDX-License-Identifier: BSD-3-Clause
// What bounds a run, so that nothing in it grows or goes on without end.
#pragma once

#include <cstdint>

namespace waitpoint::kernel {

inline constexpr std::uint32_t tasks_max = 1u << 20;
/// Of tasks and timers, and messages under way.
inline constexpr std::uint32_t events_max = 2 * tasks_max;
/// Waitpoints that a task may pass at one instant before its ties get a turn.
inline constexpr std::uint32_t turns_max = 1000;
/// Turns at one instant, and turns_max more a task, after which a run makes no progress: some tens of millions of
/// waitpoints, which a test that gives its computing no cost may well pass.
inline constexpr std::uint64_t idle_turns_max = 20'000;
/// Calls that a task may make while it is unwound: one that makes more does not leave, and is abandoned.
inline constexpr std::uint32_t refusals_max = 10'000;

}  // namespace waitpoint::kernel
