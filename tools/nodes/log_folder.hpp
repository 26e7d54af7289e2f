// SPDX-License-Identifier: BSD-3-Clause
// Where nodes of ROS write their logs and settings. Leftovers of earlier runs there would be part of a run.
#pragma once

#include <sys/types.h>

#include <filesystem>

namespace waitpoint::tools {

/// A folder that is removed by the process that made it. Its path always has the same length.
class LogFolder {
 public:
  /// Among the system's temporary ones. BadInput if it cannot be made.
  LogFolder();
  /// Of this process, in the folder of another one.
  explicit LogFolder(const LogFolder& around);
  ~LogFolder();
  LogFolder& operator=(const LogFolder&) = delete;

  /// From now on programs that this process starts use it, by ROS's variables of the environment.
  void use() const;
  /// Removes its contents.
  void clear() const;

 private:
  std::filesystem::path path_;
  pid_t maker_;
};

}  // namespace waitpoint::tools
