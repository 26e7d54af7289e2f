// SPDX-License-Identifier: BSD-3-Clause
// Command lines of `waitpoint` as tests give them.
#pragma once

#include <string>
#include <vector>

#include "core/error.hpp"
#include "tools/options.hpp"

namespace waitpoint::tools {

/// What `waitpoint ARGUMENTS` asks for.
inline Options read(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "waitpoint");
  return read_options(static_cast<int>(arguments.size()), arguments.data(), "waitpoint 1.2.3");
}

/// With which words it is refused; empty if it is not.
inline std::string message(const std::vector<const char*>& arguments) {
  try {
    read(arguments);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

}  // namespace waitpoint::tools
