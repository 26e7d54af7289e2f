// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/explore_report.hpp"

#include <ostream>

namespace waitpoint {

std::ostream& operator<<(std::ostream& out, const ExploreReport& report) {
  if (!report.passed) return out << report.text;
  out << "passed " << report.schedules << " schedules, " << report.distinct << " distinct";
  if (!report.scope.empty()) out << ": " << report.scope;
  if (report.chance_of_news) out << "; " << to_text(*report.chance_of_news);
  if (report.leaked_bytes > 0) out << "; each leaves " << report.leaked_bytes << " bytes on the heap";
  return out;
}

}  // namespace waitpoint
