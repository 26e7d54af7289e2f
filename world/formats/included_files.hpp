// SPDX-License-Identifier: BSD-3-Clause
// Nested includes of files, with limits; a file must not include itself, directly or indirectly.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace waitpoint::world {

class IncludedFiles {
 public:
  static constexpr std::size_t depth_max = 16;
  static constexpr std::size_t count_max = 1000;

  /// `bytes_max` limits the total size of all files, including `contents`.
  IncludedFiles(const std::string& file, const std::string& contents, std::size_t bytes_max);

  /// The contents of a file included by line `line` of `from`; the file is open until leave(). BadInput, naming that
  /// line, if the file is missing or already open, or exceeds a limit.
  std::string enter(const std::string& file, const std::string& from, int line);
  void leave() { open_.pop_back(); }

 private:
  std::vector<std::string> open_;  // canonical paths
  std::size_t count_ = 0, bytes_, bytes_max_;
};

}  // namespace waitpoint::world
