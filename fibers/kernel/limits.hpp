// SPDX-License-Identifier: BSD-3-Clause
// The bounds of a run's size, and of its activity at one instant.
#pragma once

#include <cstdint>

namespace waitpoint::kernel {

inline constexpr std::uint32_t tasks_max = 1u << 20;
/// Tasks, timers and messages under way.
inline constexpr std::uint32_t events_max = 2 * tasks_max;
/// Waitpoints that a task may pass at one instant before it yields to its ties.
inline constexpr std::uint32_t waitpoints_max = 1000;
/// After this number of yields at one instant, plus waitpoints_max per task, a run ends without progress, unless a task
/// has taken what another one gave (turn.hpp, note_transfer()). That is some tens of millions of waitpoints: tests
/// whose computing has no cost may pass many at one instant.
inline constexpr std::uint64_t idle_yields_max = 20'000;
/// After this number of yields at one instant a robot's events go behind those of the others, for which it may wait.
inline constexpr std::uint64_t idle_yields_of_robot = 512;
/// Places of robots in the order of one instant; later ones share the last.
inline constexpr std::uint32_t places_max = (1u << 17) - 1;
/// After this number of waitpoints at one instant a run ends even so: half a minute of processor time. The default of
/// set_instant_limit().
inline constexpr std::uint64_t instant_limit = 2'000'000'000;
/// Calls that a task may make while it is unwound; after more it is abandoned.
inline constexpr std::uint32_t refusals_max = 10'000;

}  // namespace waitpoint::kernel
