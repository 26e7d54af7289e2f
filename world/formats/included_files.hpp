// SPDX-License-Identifier: BSD-3-Clause
// The files that one file takes in, which may take in others: none of them itself, and not without end.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace waitpoint::world {

class IncludedFiles {
 public:
  static constexpr std::size_t depth_max = 16;
  static constexpr std::size_t count_max = 1000;

  /// `bytes_max`: of all of them together. The including file counts with the size of its `contents`.
  IncludedFiles(const std::string& file, const std::string& contents, std::size_t bytes_max);

  /// The contents of a file that line `line` of `from` includes, which is being read until leave(). BadInput, naming
  /// that line: missing, being read already, too deep, too many.
  std::string enter(const std::string& file, const std::string& from, int line);
  void leave() { open_.pop_back(); }

 private:
  std::vector<std::string> open_;  // without links and dots
  std::size_t count_ = 0, bytes_, bytes_max_;
};

}  // namespace waitpoint::world
