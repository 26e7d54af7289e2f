// SPDX-License-Identifier: BSD-3-Clause
// A parameter as a user wrote it, still without a type: a scenario stores a module's parameters so, and the module
// applies them to its declared fields.
#pragma once

#include <string>

#include "core/error.hpp"

namespace waitpoint {

struct Setting {
  std::string key;   ///< nested keys and list positions are joined by dots: "tasks.motion.period_ms", "gains.0"
  std::string text;  ///< the value as written
  std::string file;  ///< the file, or the option ("--set ...")
  int line = 0;      ///< counts from 1; 0 for an option

  /// The error to throw if the setting cannot be used.
  BadInput bad(const std::string& expected) const { return BadInput(file, line, expected); }
};

}  // namespace waitpoint
