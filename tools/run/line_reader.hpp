// SPDX-License-Identifier: BSD-3-Clause
// Lines of a file descriptor, blocking or not: commands typed during a run must not delay it.
#pragma once

#include <string>

namespace waitpoint::tools {

class LineReader {
 public:
  enum class Result {
    line,
    nothing,      ///< no complete line yet
    end,          ///< of the input; a last line without a newline is returned first
    interrupted,  ///< by a recorded signal
  };

  explicit LineReader(int descriptor) : descriptor_(descriptor) {}

  /// Blocks until a line arrives.
  Result wait(std::string& line);
  /// Returns a line if one is available.
  Result poll(std::string& line);

 private:
  bool take(std::string& line);
  Result read(std::string& line, int timeout_ms);

  int descriptor_;
  std::string buffer_;
  bool ended_ = false;
};

}  // namespace waitpoint::tools
