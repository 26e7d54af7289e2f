// SPDX-License-Identifier: BSD-3-Clause
// The threads of the operating system that a run brought into this process: a simulation has none but its own.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace waitpoint::tools {

class SystemThreads {
 public:
  /// Those that are there now are none of the run's.
  SystemThreads();
  /// Notes those that came; one that came and went between two looks is not seen.
  void look();
  /// Their names in quotes, each once.
  std::vector<std::string> found() const;

 private:
  std::map<int, std::string> earlier_;  // by id
  std::set<std::string> came_;
};

}  // namespace waitpoint::tools
