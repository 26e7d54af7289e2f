// SPDX-License-Identifier: BSD-3-Clause
// Where real data lie that are not part of the project: tests that use them skip where there are none.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace waitpoint::test {

/// $WAITPOINT_DATA, or ../shared/data seen from the project's root; none if there is no such folder.
inline std::optional<std::string> data_folder() {
  namespace fs = std::filesystem;
  const char* given = std::getenv("WAITPOINT_DATA");
  const fs::path root = fs::path(__FILE__).parent_path() / "..";
  const fs::path folder = given != nullptr ? fs::path(given) : root / "../shared/data";
  std::error_code none;
  if (!fs::is_directory(folder, none)) return std::nullopt;
  return folder.string();
}

}  // namespace waitpoint::test
