// SPDX-License-Identifier: BSD-3-Clause
// A person's interpreter on one robot: evaluates commands one after another, in a task of the robot.
#pragma once

#include <deque>

#include "modules/tcl/module_link.hpp"

namespace waitpoint::tcl {

class Shell {
 public:
  /// Gets the output of a command line by line, and at its end its result.
  using Tell = std::function<void(Time date, const std::string& text, bool is_result)>;

  /// `names` and `library`, Tcl's, must outlive the shell.
  Shell(genom::NameSpace& names, const Library& library, const std::string& robot, Tell tell);

  /// From any task: evaluates a command after those submitted before.
  void submit(const std::string& command);
  /// The body of the task, which never ends by itself.
  void run();

 private:
  const Library& library_;
  std::string robot_;
  Tell tell_;
  ModuleLink link_;
  threads::mutex mutex_{"commands"};
  threads::counting_semaphore<> submitted_{0, "commands"};
  std::deque<std::string> commands_;
};

}  // namespace waitpoint::tcl
