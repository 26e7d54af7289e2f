// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace waitpoint::tools {

/// The switch points of explored programs: simulated calls; accesses of threads to memory that they share and write,
/// too. Instrumented programs always have both. Automatic: schedules of both kinds.
enum class SwitchAt : std::uint8_t { automatic, calls, accesses };

}  // namespace waitpoint::tools
