// SPDX-License-Identifier: BSD-3-Clause
// Parses command lines of `waitpoint` for tests.
#pragma once

#include <string>
#include <vector>

#include "core/error.hpp"
#include "tools/options.hpp"

namespace waitpoint::tools {

/// The options of `waitpoint ARGUMENTS`.
inline Options read(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "waitpoint");
  return read_options(static_cast<int>(arguments.size()), arguments.data(), "waitpoint 1.2.3");
}

/// The message with which they are rejected; empty if they are valid.
inline std::string message(const std::vector<const char*>& arguments) {
  try {
    read(arguments);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

}  // namespace waitpoint::tools
