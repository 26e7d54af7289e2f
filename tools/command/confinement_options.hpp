// SPDX-License-Identifier: BSD-3-Clause
// The options --confined and --allow of the commands that read scenarios: docs/trust.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/command/command_line.hpp"

namespace waitpoint::tools {

struct ConfinementArguments {
  bool is_confined = false;
  std::vector<std::string> allowed;

  void add(Command& command);
  /// The folders to which reading is confined: the scenario's own, then those of --allow; empty: not confined.
  std::vector<std::filesystem::path> folders(const std::filesystem::path& scenario) const;
};

}  // namespace waitpoint::tools
