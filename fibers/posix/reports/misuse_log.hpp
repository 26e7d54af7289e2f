// SPDX-License-Identifier: BSD-3-Clause
// Misuses of primitives and threads in a run (family/misuse.hpp), of all processes, in the family's memory.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "core/time.hpp"
#include "fibers/sync/report/source_lines.hpp"

namespace waitpoint::posix {

struct LoggedMisuse {
  std::string sentence;  ///< "main unlocks mutex m, locked by thread 1"
  Time time;
  sync::CodePlaces calls;
};

/// family::Part::misuses: each sentence once.
struct MisuseLog {
  std::vector<LoggedMisuse> misuses;
};

/// From now on misuses of this process are logged.
void begin_misuse_log();

}  // namespace waitpoint::posix
