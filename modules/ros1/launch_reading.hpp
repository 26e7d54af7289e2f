// SPDX-License-Identifier: BSD-3-Clause
// The state of reading a launch file and those that it includes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "modules/ros1/launch.hpp"
#include "modules/ros1/launch_surroundings.hpp"
#include "modules/ros1/substitution.hpp"

namespace tinyxml2 {
class XMLElement;
}

namespace waitpoint::ros1 {

struct LaunchReading {
  LaunchReading(LaunchSurroundings& given, Launch& result) : surroundings(given), substitution(given), launch(result) {}

  /// The path of a file that the launch file of the scope names: relative to that one.
  static std::string path_in(const LaunchScope& scope, const std::string& file);
  /// The contents of a file, which becomes part of the launch's fingerprint. BadInput as of core/file_contents.hpp, and
  /// if all files together have more than 64 MiB.
  std::string contents_of(const std::string& file, std::string_view expected);

  /// Counts an element in the scope around it. BadInput at its line if there are more than 20 000, or if the scope has
  /// more than 2000 arguments, remappings, variables and parameters, which each scope within it copies.
  void count(const tinyxml2::XMLElement& element, const LaunchScope& scope);

  LaunchSurroundings& surroundings;
  Substitution substitution;
  Launch& launch;
  std::vector<std::filesystem::path> open;  ///< the launch file and those included, from the outermost on; canonical
  std::size_t files = 0;                    ///< launch files so far
  std::size_t elements = 0;                 ///< elements so far, of all files
  std::size_t bytes = 0;                    ///< of all files so far
};

}  // namespace waitpoint::ros1
