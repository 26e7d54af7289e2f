// SPDX-License-Identifier: BSD-3-Clause
// Where the project lies, the real data that are no part of it, and what runs the tests: some skip without them.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "core/error.hpp"

namespace waitpoint::test {

/// $WAITPOINT_ROOT, or the nearest folder above this program, this source or the current folder that has the scenarios.
inline std::filesystem::path project_root() {
  namespace fs = std::filesystem;
  if (const char* given = std::getenv("WAITPOINT_ROOT"); given != nullptr && *given != '\0') return given;
  for (const fs::path& start :
       {fs::read_symlink("/proc/self/exe"), fs::absolute(__FILE__).lexically_normal(), fs::current_path() / "."})
    for (fs::path folder = start.parent_path(); folder != folder.root_path(); folder = folder.parent_path())
      if (fs::exists(folder / "scenarios" / "office.yaml")) return folder;
  throw BadInput("WAITPOINT_ROOT", "the project is not found: expected its folder");
}

/// $WAITPOINT_DATA, or ../shared/data seen from the project's root; none if there is no such folder.
inline std::optional<std::string> data_folder() {
  const char* given = std::getenv("WAITPOINT_DATA");
  const std::filesystem::path folder =
      given != nullptr ? std::filesystem::path(given) : project_root() / ".." / "shared" / "data";
  std::error_code none;
  if (!std::filesystem::is_directory(folder, none)) return std::nullopt;
  return folder.string();
}

/// True where another program runs this one, as qemu does (run_tests.py names it): the system cannot start a program of
/// that processor by itself, and gdb cannot read it.
inline bool is_emulated() { return std::getenv("WAITPOINT_UNDER") != nullptr; }

}  // namespace waitpoint::test
