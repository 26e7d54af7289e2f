// SPDX-License-Identifier: BSD-3-Clause
// When runs end, and how fast virtual time passes.
#pragma once

#include <optional>

#include "core/time.hpp"
#include "tools/command/command.hpp"

namespace waitpoint::tools {

void declare_until(Command& command, std::optional<Duration>& until, const char* section = "Time");

/// Simulated seconds per second, at most; 0: no limit. Where virtual time meets processes outside it is 1 if it is not
/// given.
void declare_speed(Command& command, std::optional<double>& speed, bool is_rare = false);

}  // namespace waitpoint::tools
