// SPDX-License-Identifier: BSD-3-Clause
// The place of a piece of input: a line of a file, or an option of the command line.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace waitpoint {

/// A file's name, stored once for the million values of a file that are copied with their places.
class FileName {
 public:
  FileName() = default;
  FileName(const char* name) : FileName(std::string(name)) {}
  FileName(std::string name) : name_(std::make_shared<const std::string>(std::move(name))) {}

  operator const std::string&() const {
    static const std::string none;
    return name_ == nullptr ? none : *name_;
  }
  const std::string& text() const { return *this; }

 private:
  std::shared_ptr<const std::string> name_;
};

struct Location {
  FileName file;  ///< as the user named it; for an option, its text: "--set world.step_ms=5"
  int line = 0;   ///< counts from 1; 0 for an option or an unreadable file

  /// The error to throw about the input at this place: "FILE:LINE: message".
  BadInput bad(const std::string& message) const { return BadInput(file, line, message); }

  /// Resolves a path given here: relative to the file or, for an option, to the current directory.
  std::filesystem::path resolve(const std::string& path) const {
    return line > 0 ? std::filesystem::path(file.text()).parent_path() / path : std::filesystem::path(path);
  }

  /// "office.yaml:12".
  std::string text() const { return line > 0 ? file.text() + ":" + std::to_string(line) : file.text(); }
};

}  // namespace waitpoint
