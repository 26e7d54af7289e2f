// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ros1/packages.hpp"

#include <tinyxml2.h>
#include <unistd.h>

#include <algorithm>
#include <deque>
#include <utility>

#include "core/file_list.hpp"

namespace waitpoint::ros1 {
namespace {

namespace fs = std::filesystem;

constexpr int folder_levels_max = 5;
constexpr std::size_t folders_max = 20'000;  // of a root: a workspace has some hundreds
constexpr std::uintmax_t manifest_bytes_max = 1 << 20;

bool is_file(const fs::path& path) {
  std::error_code none;
  return fs::is_regular_file(path, none);
}

bool is_executable_file(const fs::path& path) { return is_file(path) && access(path.c_str(), X_OK) == 0; }

// Sorted, without hidden ones. Links are followed: the depth is bounded.
std::vector<fs::path> folders_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code failed;
  for (fs::directory_iterator each(folder, failed), end; !failed && each != end; each.increment(failed)) {
    std::error_code none;
    if (each->path().filename().native().front() != '.' && each->is_directory(none)) found.push_back(each->path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::optional<std::string> name_in_manifest(const fs::path& manifest) {
  std::error_code failed;
  const std::uintmax_t bytes = fs::file_size(manifest, failed);
  tinyxml2::XMLDocument document;
  FileList::add(manifest, FileRole::read);
  if (failed || bytes > manifest_bytes_max || document.LoadFile(manifest.c_str()) != tinyxml2::XML_SUCCESS)
    return std::nullopt;
  const tinyxml2::XMLElement* const package = document.FirstChildElement("package");
  const tinyxml2::XMLElement* const name = package == nullptr ? nullptr : package->FirstChildElement("name");
  const char* const text = name == nullptr ? nullptr : name->GetText();
  if (text == nullptr) return std::nullopt;
  constexpr std::string_view blanks = " \t\r\n";
  const std::string_view view = text;
  const std::size_t first = std::min(view.find_first_not_of(blanks), view.size());
  return std::string(view.substr(first, view.find_last_not_of(blanks) + 1 - first));
}

// Level by level.
std::map<std::string, fs::path> packages_below(const fs::path& root) {
  std::map<std::string, fs::path> packages;
  std::deque<std::pair<fs::path, int>> open{{root, 0}};
  for (std::size_t count = 0; !open.empty() && count < folders_max; ++count) {
    const auto [folder, level] = std::move(open.front());
    open.pop_front();
    if (is_file(folder / "CATKIN_IGNORE")) continue;
    if (const fs::path manifest = folder / "package.xml"; is_file(manifest)) {
      if (std::optional<std::string> name = name_in_manifest(manifest)) packages.emplace(std::move(*name), folder);
      continue;
    }
    if (level == folder_levels_max) continue;
    for (fs::path& inner : folders_in(folder)) open.emplace_back(std::move(inner), level + 1);
  }
  return packages;
}

std::optional<fs::path> executable_within(const fs::path& package, const std::string& type) {
  std::deque<std::pair<fs::path, int>> open{{package, 0}};
  for (std::size_t count = 0; !open.empty() && count < folders_max; ++count) {
    const auto [folder, level] = std::move(open.front());
    open.pop_front();
    if (is_executable_file(folder / type)) return folder / type;
    if (level == folder_levels_max) continue;
    for (fs::path& inner : folders_in(folder)) open.emplace_back(std::move(inner), level + 1);
  }
  return std::nullopt;
}

bool is_one_word(const std::string& name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == name.npos;
}

}  // namespace

Packages::Packages(std::vector<fs::path> roots) : roots_(std::move(roots)) {}

Packages Packages::of(const Environment& environment) {
  std::vector<fs::path> roots;
  const std::string listed = environment("ROS_PACKAGE_PATH").value_or("");
  for (std::size_t at = 0; at < listed.size();) {
    const std::size_t end = std::min(listed.find(':', at), listed.size());
    if (end > at) roots.emplace_back(listed.substr(at, end - at));
    at = end + 1;
  }
  const fs::path of_debian = "/usr/share";
  if (std::find(roots.begin(), roots.end(), of_debian) == roots.end()) roots.push_back(of_debian);
  return Packages(std::move(roots));
}

std::optional<fs::path> Packages::folder(const std::string& package) {
  if (!is_one_word(package)) return std::nullopt;
  for (const fs::path& root : roots_) {
    if (const fs::path manifest = root / package / "package.xml"; is_file(manifest)) {
      if (name_in_manifest(manifest) == package) return root / package;
    }
    // Where installed packages are, each has the folder of its name, beside thousands of folders of others.
    if (root.filename() == "share") continue;
    const auto known = found_.find(root);
    const auto& packages = known != found_.end() ? known->second : (found_[root] = packages_below(root));
    if (const auto found = packages.find(package); found != packages.end()) return found->second;
  }
  return std::nullopt;
}

std::optional<fs::path> Packages::executable(const std::string& package, const std::string& type) {
  const std::optional<fs::path> of_package = folder(package);
  if (!of_package || !is_one_word(type)) return std::nullopt;
  const fs::path own = fs::path("lib") / package / type;
  const fs::path above = of_package->parent_path();
  if (above.filename() == "share")
    if (fs::path file = above.parent_path() / own; is_executable_file(file)) return file;
  fs::path beside = fs::absolute(above).lexically_normal();
  for (int level = 0; level <= folder_levels_max && beside.has_relative_path(); ++level, beside = beside.parent_path())
    if (fs::path file = beside / "devel" / own; is_executable_file(file)) return file;
  return executable_within(*of_package, type);
}

}  // namespace waitpoint::ros1
