// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/installed_part.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/missing_part.hpp"
#include "core/nearest_name.hpp"
#include "tools/command/data_folder.hpp"

namespace waitpoint::tools {

namespace {

// Of the library or program that contains this function.
std::filesystem::path own_folder() {
  static const char here = 0;
  Dl_info info{};
  if (dladdr(&here, &info) == 0 || info.dli_fname == nullptr) return {};
  return std::filesystem::path(info.dli_fname).parent_path();
}

/// Those that are there: beside the program, and at the place of installation.
std::vector<std::filesystem::path> folders_of_scenarios() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  std::vector<std::filesystem::path> folders;
  for (const std::filesystem::path& data :
       {program.parent_path() / "share/waitpoint", std::filesystem::path(data_folder)})
    if (std::filesystem::exists(data / "scenarios", error)) folders.push_back(data / "scenarios");
  return folders;
}

}  // namespace

std::filesystem::path find_part(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const std::filesystem::path installed = std::filesystem::path(library_folder) / name;
  // A tree that was moved since it was installed: its folders lie to each other as they did.
  const std::filesystem::path prefix = std::filesystem::path(data_folder).parent_path().parent_path();
  const std::filesystem::path moved =
      folder.parent_path() / std::filesystem::path(library_folder).lexically_relative(prefix) / name;
  for (const std::filesystem::path& place : {own_folder() / "waitpoint" / name, folder / ".." / name, moved, installed})
    if (std::filesystem::exists(place)) return std::filesystem::canonical(place);
  throw BadInput("programs", name + ", which they need, is not installed: " + missing_part::programs);
}

std::filesystem::path find_gdb_script(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const std::filesystem::path installed = std::filesystem::path(data_folder) / "gdb";
  for (const std::filesystem::path& place : {folder / "gdb", folder / "../share/waitpoint/gdb", installed})
    if (std::filesystem::exists(place / name)) return (place / name).lexically_normal();
  throw BadInput("gdb", "the gdb commands are not installed: expected " + (installed / name).string());
}

std::filesystem::path scenarios_folder() {
  const std::vector<std::filesystem::path> folders = folders_of_scenarios();
  if (folders.empty())
    throw BadInput("scenarios", "there are none beside this program, nor in " + std::string(data_folder));
  return folders.front();
}

std::filesystem::path find_scenario(const std::string& name) {
  std::filesystem::path local = name;
  std::error_code error;
  if (local.empty() || local.has_parent_path() || std::filesystem::exists(local, error)) return local;
  std::vector<std::string> names;
  for (const std::filesystem::path& folder : folders_of_scenarios()) {
    for (const std::string& file : {name, name + ".yaml"})
      if (std::filesystem::is_regular_file(folder / file, error)) return folder / file;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
      if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem());
  }
  std::ranges::sort(names);
  const std::vector<std::string_view> known(names.begin(), names.end());
  if (const std::string near = did_you_mean(local.stem().string(), known); !near.empty())
    throw BadInput(name, "there is no such file, nor a shipped scenario" + near);
  return local;
}

}  // namespace waitpoint::tools
