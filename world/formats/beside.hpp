// SPDX-License-Identifier: BSD-3-Clause
// The path of a file that another file names.
#pragma once

#include <filesystem>
#include <string>

namespace waitpoint::world {

/// Resolves `path`, relative to the folder of `file`.
inline std::string beside(const std::string& file, const std::string& path) {
  return (std::filesystem::path(file).parent_path() / path).lexically_normal().string();
}

}  // namespace waitpoint::world
