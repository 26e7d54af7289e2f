// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/confinement_options.hpp"

#include "core/error.hpp"

namespace waitpoint::tools {

void ConfinementArguments::add(Command& command) {
  command.flag("--confined", is_confined,
               "for a stranger's scenario: it may only name files in its own folder and below\n"
               "it, and no programs (docs/trust.md)");
  command.repeated("--allow", allowed, "FOLDER", "with --confined: files in FOLDER, too; may be repeated");
}

std::vector<std::filesystem::path> ConfinementArguments::folders(const std::filesystem::path& scenario) const {
  if (!is_confined) {
    if (!allowed.empty()) throw BadInput("--allow", "expected --confined beside it");
    return {};
  }
  std::vector<std::filesystem::path> folders = {scenario.has_parent_path() ? scenario.parent_path() : "."};
  folders.insert(folders.end(), allowed.begin(), allowed.end());
  return folders;
}

}  // namespace waitpoint::tools
