// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/distinct_files.hpp"

#include <filesystem>
#include <map>

#include "core/error.hpp"

namespace waitpoint::tools {
namespace {

/// The file of that name, with existing links followed. Empty unless it is, or would be, a regular file.
std::filesystem::path meant_by(const std::string& name) {
  std::error_code error;
  if (std::filesystem::exists(name, error) && !std::filesystem::is_regular_file(name, error)) return {};
  const std::filesystem::path path = std::filesystem::weakly_canonical(std::filesystem::absolute(name, error), error);
  return error ? std::filesystem::path(name) : path;
}

}  // namespace

void check_distinct(const std::vector<NamedFile>& files) {
  std::map<std::filesystem::path, const NamedFile*> known;
  for (const NamedFile& file : files) {
    const std::filesystem::path path = file.name.empty() ? std::filesystem::path() : meant_by(file.name);
    if (path.empty()) continue;
    const auto [other, is_new] = known.emplace(path, &file);
    if (is_new) continue;
    const NamedFile& first = *other->second;
    throw BadInput(file.option, "'" + file.name + "' is the file that " + first.option +
                                    (first.use == NamedFile::Use::written ? " writes" : " reads"));
  }
}

}  // namespace waitpoint::tools
