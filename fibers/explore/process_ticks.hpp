// SPDX-License-Identifier: BSD-3-Clause
// Whether another process computes or waits: by what the system counts of it.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>

namespace waitpoint::exploration {

/// So long may a process of which nothing but computing is expected compute nothing.
inline constexpr std::uint32_t idle_s_max = 10;

/// The time that `process` has computed, in the system's ticks; nothing where it is stopped, by a debugger for example.
std::optional<std::uint64_t> ticks_of(pid_t process);

}  // namespace waitpoint::exploration
