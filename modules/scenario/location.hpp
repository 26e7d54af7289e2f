// SPDX-License-Identifier: BSD-3-Clause
// Where something was written: a line of a file, or an option of the command line.
#pragma once

#include <filesystem>
#include <string>

#include "core/error.hpp"

namespace waitpoint::scenario {

struct Location {
  std::string file;  ///< as the user named it; for an option, its text: "--set world.step_ms=5"
  int line = 0;      ///< counts from 1; 0 for an option or a file that cannot be read at all

  /// The error to throw about what stands here.
  BadInput bad(const std::string& message) const { return BadInput(file, line, message); }

  /// A path written here is relative to the file, or for an option to the current directory.
  std::filesystem::path resolve(const std::string& path) const {
    return line > 0 ? std::filesystem::path(file).parent_path() / path : std::filesystem::path(path);
  }

  /// "office.yaml:12".
  std::string text() const { return line > 0 ? file + ":" + std::to_string(line) : file; }
};

}  // namespace waitpoint::scenario
