// SPDX-License-Identifier: BSD-3-Clause
// Where packages of ROS and their executables are.
//
// A package is a folder with a file package.xml that has its name. Roots are looked through in their order: first the
// folder ROOT/PACKAGE, as Debian and catkin's installations have them, then the folders below, sorted by name, at most
// 5 levels deep, unless the root is called `share`; not below a package, nor in hidden folders and those with a file
// CATKIN_IGNORE.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace waitpoint::ros1 {

/// The value of a variable of the environment, if it is set.
using Environment = std::function<std::optional<std::string>(const std::string& name)>;

class Packages {
 public:
  explicit Packages(std::vector<std::filesystem::path> roots);
  /// The folders of ROS_PACKAGE_PATH, then /usr/share.
  static Packages of(const Environment& environment);

  const std::vector<std::filesystem::path>& roots() const { return roots_; }

  /// The package's folder; none if there is no such package.
  std::optional<std::filesystem::path> folder(const std::string& package);

  /// The executable file `type` of a package: for PREFIX/share/PACKAGE it is PREFIX/lib/PACKAGE/TYPE; else it is
  /// devel/lib/PACKAGE/TYPE beside one of the folders above the package; else it is within the package's folder, the
  /// first one by name of the highest level. None if there is no such file.
  std::optional<std::filesystem::path> executable(const std::string& package, const std::string& type);

 private:
  std::vector<std::filesystem::path> roots_;
  /// Of each root that was looked through: its packages' folders.
  std::map<std::filesystem::path, std::map<std::string, std::filesystem::path>> found_;
};

}  // namespace waitpoint::ros1
