// SPDX-License-Identifier: BSD-3-Clause
// The place of a piece of input: a line of a file, or an option of the command line.
#pragma once

#include <filesystem>
#include <string>

#include "core/error.hpp"

namespace waitpoint::scenario {

struct Location {
  std::string file;  ///< as the user named it; for an option, its text: "--set world.step_ms=5"
  int line = 0;      ///< counts from 1; 0 for an option or an unreadable file

  /// The error to throw about the input at this place: "FILE:LINE: message".
  BadInput bad(const std::string& message) const { return BadInput(file, line, message); }

  /// Resolves a path given here: relative to the file or, for an option, to the current directory.
  std::filesystem::path resolve(const std::string& path) const {
    return line > 0 ? std::filesystem::path(file).parent_path() / path : std::filesystem::path(path);
  }

  /// "office.yaml:12".
  std::string text() const { return line > 0 ? file + ":" + std::to_string(line) : file; }
};

}  // namespace waitpoint::scenario
