// SPDX-License-Identifier: BSD-3-Clause
// One parameter as a user wrote it, before anybody knows its type: a scenario keeps a module's parameters so, and the
// module applies them to the fields it declares.
#pragma once

#include <string>

#include "core/error.hpp"

namespace waitpoint {

struct Setting {
  std::string key;   ///< nested keys and list positions are joined by dots: "tasks.motion.period_ms", "gains.0"
  std::string text;  ///< the value as written
  std::string file;  ///< the file, or the option ("--set ...") that said so
  int line = 0;      ///< counts from 1; 0 for an option

  /// The error to throw where this cannot be used.
  BadInput bad(const std::string& expected) const { return BadInput(file, line, expected); }
};

}  // namespace waitpoint
