// SPDX-License-Identifier: BSD-3-Clause
// Says when a run is to be ended from outside: it does not go on, takes longer than its limit, or this process is asked
// to stop.
#pragma once

#include <csignal>
#include <string>

#include "fibers/explore/target/time_limit.hpp"
#include "tools/exec/watchdog.hpp"

namespace waitpoint::tools {

class RunWatch {
 public:
  /// `limit_s` of the wall clock; none if it is not positive. `patience_s`: that of a Watchdog. `time_limit`: the
  /// search's, which explains a request to stop.
  RunWatch(const posix::Record& record, double limit_s, double patience_s, const exploration::TimeLimit& time_limit,
           const volatile std::sig_atomic_t& is_to_stop);

  /// Looks, unless it has said so already; call at intervals.
  bool is_to_end();
  /// Why the run is to be ended; empty if it is not.
  const std::string& words() const { return words_; }
  /// At the last look but one it had come less far. How far a run comes that is ended meanwhile depends on the machine.
  bool has_gone_on() const { return has_gone_on_; }

 private:
  const posix::Record& record_;
  Watchdog watchdog_;
  double limit_s_, start_s_;
  const exploration::TimeLimit& time_limit_;
  const volatile std::sig_atomic_t& is_to_stop_;
  std::uint64_t events_ = 0;
  bool has_gone_on_ = true;
  std::string words_;
};

}  // namespace waitpoint::tools
