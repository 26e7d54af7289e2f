// SPDX-License-Identifier: BSD-3-Clause
// System threads that a run started in this process: a simulation itself starts none.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace waitpoint::tools {

class SystemThreads {
 public:
  /// Existing threads are not the run's.
  SystemThreads();
  /// Records new threads; one that starts and ends between two calls is missed.
  void look();
  /// Their names in quotes, without duplicates.
  std::vector<std::string> found() const;

 private:
  std::map<int, std::string> earlier_;  // by id
  std::set<std::string> came_;
};

}  // namespace waitpoint::tools
