// SPDX-License-Identifier: BSD-3-Clause
// The scenario of a command, and what it may read: docs/trust.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/command/command.hpp"
#include "tools/command/system_confinement.hpp"

namespace waitpoint::tools {

struct ScenarioOptions {
  std::filesystem::path scenario;
  std::vector<std::string> assignments;            ///< of --set, in their order: "world.step_ms=5"
  std::vector<std::filesystem::path> confined_to;  ///< the only folders to read from; empty: all
  bool is_confined = false;
  std::vector<std::string> allowed;  ///< of --allow
  SystemConfinement system;          ///< with --confined
};

enum class ScenarioArgument { required, optional };

void declare_scenario(Command& command, ScenarioOptions& options,
                      ScenarioArgument argument = ScenarioArgument::required);

}  // namespace waitpoint::tools
