// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/installed_part.hpp"

#include "core/error.hpp"
#include "tools/command/data_folder.hpp"

namespace waitpoint::tools {

std::filesystem::path find_part(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const std::filesystem::path installed = std::filesystem::path(library_folder) / name;
  for (const std::filesystem::path& place : {folder / ".." / name, installed})
    if (std::filesystem::exists(place)) return std::filesystem::canonical(place);
  throw BadInput("programs", "the library they need is not installed: expected " + installed.string());
}

}  // namespace waitpoint::tools
