// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/distinct_files.hpp"

#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <filesystem>
#include <map>

#include "core/error.hpp"
#include "tools/command/option_values.hpp"

namespace waitpoint::tools {
namespace {

/// The file of that name, with existing links followed. Empty unless it is, or would be, a regular file.
std::filesystem::path meant_by(const std::string& name) {
  std::error_code error;
  if (std::filesystem::exists(name, error) && !std::filesystem::is_regular_file(name, error)) return {};
  const std::filesystem::path path = std::filesystem::weakly_canonical(std::filesystem::absolute(name, error), error);
  return error ? std::filesystem::path(name) : path;
}

bool is_null_device(const struct stat& status) { return S_ISCHR(status.st_mode) && status.st_rdev == makedev(1, 3); }

bool leads_to_standard_output(const std::string& name) {
  if (name == "-") return true;
  struct stat named {
  }, standard{};
  return stat(name.c_str(), &named) == 0 && fstat(STDOUT_FILENO, &standard) == 0 && named.st_dev == standard.st_dev &&
         named.st_ino == standard.st_ino && !is_null_device(named);
}

}  // namespace

void check_distinct(const std::vector<NamedFile>& files) {
  std::map<std::filesystem::path, const NamedFile*> known;
  for (const NamedFile& file : files) {
    const std::filesystem::path path = meant_by(file.name);
    if (path.empty()) continue;
    const auto [other, is_new] = known.emplace(path, &file);
    if (is_new) continue;
    const NamedFile& first = *other->second;
    throw BadInput(file.option, "'" + file.name + "' is the file that " + first.option +
                                    (first.use == NamedFile::Use::written ? " writes" : " reads"));
  }
}

void check_beside_json(const std::vector<NamedFile>& files) {
  for (const NamedFile& file : files)
    if (file.use == NamedFile::Use::written && leads_to_standard_output(file.name))
      refuse("--json", "no other file on standard output", file.option + " " + file.name);
}

}  // namespace waitpoint::tools
