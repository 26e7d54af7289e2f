// SPDX-License-Identifier: BSD-3-Clause
// A process whose work is shown in browsers, as its parent sees it, which serves them and has the terminal.
#pragma once

#include <sys/types.h>

#include <string>

namespace waitpoint::tools {

class ShownProcess {
 public:
  /// `what` it does, for messages: "run". heed_signals() must have been called. Processes that it makes and leaves
  /// behind are this one's from now on.
  ShownProcess(pid_t process, std::string what);

  /// True when its parent has nothing more to do: after a signal, once the process has ended. Tells of its end.
  bool is_done(const std::string& url);
  bool has_ended() const { return has_ended_; }
  /// Ends all processes that it has left behind: first what this one shows of them must be given up.
  static void end_others();
  /// In the process that is shown, at its beginning: it is killed with its parent.
  static void end_with_parent();
  /// Its exit status, or 128 and the signal that ended it.
  int status() const;

 private:
  pid_t process_;
  std::string what_;
  int status_ = 0;
  bool has_ended_ = false, is_interrupted_ = false;
};

}  // namespace waitpoint::tools
