// SPDX-License-Identifier: BSD-3-Clause
// Lines of a file descriptor, waited for or not: what is typed while a run goes on must not hold it up.
#pragma once

#include <string>

namespace waitpoint::tools {

class LineReader {
 public:
  enum class Result {
    line,
    nothing,      ///< no whole line is there yet
    end,          ///< of the input; a last line without a newline comes before
    interrupted,  ///< by a signal that was noted
  };

  explicit LineReader(int descriptor) : descriptor_(descriptor) {}

  /// Waits for a line.
  Result wait(std::string& line);
  /// Takes a line if one is there.
  Result poll(std::string& line);

 private:
  bool take(std::string& line);
  Result read(std::string& line, int timeout_ms);

  int descriptor_;
  std::string buffer_;
  bool ended_ = false;
};

}  // namespace waitpoint::tools
