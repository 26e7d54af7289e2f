// SPDX-License-Identifier: BSD-3-Clause
// Tells a computing process from a waiting one, by the system's accounting.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>

namespace waitpoint::exploration {

/// The longest time without CPU usage before a process that should compute counts as blocked.
inline constexpr std::uint32_t idle_s_max = 10;

/// The unit of CPU times.
inline constexpr std::uint64_t ticks_per_s = 100;

/// The CPU time of `process`, in ticks; none if it is stopped, for example by a debugger.
std::optional<std::uint64_t> ticks_of(pid_t process);

}  // namespace waitpoint::exploration
