// SPDX-License-Identifier: BSD-3-Clause
// A program with commands, declared: what its help, its man pages and the completion of shells are made from.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "tools/command/command.hpp"

namespace waitpoint::tools {

struct DeclaredProgram {
  std::string name;     ///< in texts
  std::string version;  ///< has the name in its first line
  Command own{""};      ///< the options without a command
  std::vector<std::unique_ptr<Command>> commands;

  Command& add(const std::string& command) { return *commands.emplace_back(std::make_unique<Command>(command)); }
  /// Null if there is none of this name.
  Command* find(const std::string& command) const {
    const auto found = std::ranges::find_if(commands, [&](const auto& each) { return each->name == command; });
    return found == commands.end() ? nullptr : found->get();
  }
  std::string version_line() const { return version.substr(0, version.find('\n')); }
};

}  // namespace waitpoint::tools
