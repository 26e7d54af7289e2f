// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/race_report.hpp"

#include <sstream>

#include "fibers/explore/races/races.hpp"
#include "fibers/posix/exec/race_log.hpp"

namespace waitpoint::tools {

std::string races_of(const posix::Record& record) {
  std::ostringstream text;
  if (record.race_log != nullptr)
    for (const races::Race& race : races::in_words(record.race_log->races)) text << race;
  return text.str();
}

}  // namespace waitpoint::tools
