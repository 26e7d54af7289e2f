// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/run_watch.hpp"

#include <utility>

#include "tools/exec/accounts.hpp"
#include "tools/exec/family_report.hpp"
#include "tools/exec/program_run.hpp"
#include "tools/output/progress.hpp"

namespace waitpoint::tools {

RunWatch::RunWatch(const posix::Record& record, double limit_s, double patience_s,
                   const exploration::TimeLimit& time_limit, const volatile std::sig_atomic_t& is_to_stop)
    : record_(record),
      watchdog_(record, patience_s),
      limit_s_(limit_s),
      start_s_(wall_clock_s()),
      time_limit_(time_limit),
      is_to_stop_(is_to_stop) {}

bool RunWatch::is_to_end() {
  if (!words_.empty()) return true;
  const bool is_over = limit_s_ > 0 && wall_clock_s() - start_s_ >= limit_s_;
  const char* const stopped = time_limit_.is_over() ? "stopped at the time limit" : "stopped by a signal";
  if (is_to_stop_ != 0 || is_over)
    words_ = (is_over ? over_limit(limit_s_) : stopped) + " at " + to_string(time_of(record_)) +
             " s of virtual time\n" + states_of(record_);
  else
    words_ = watchdog_.look();
  if (words_.empty()) has_gone_on_ = events_of(record_) != std::exchange(events_, events_of(record_));
  while (words_.ends_with('\n')) words_.pop_back();
  return !words_.empty();
}

}  // namespace waitpoint::tools
