// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ros1/launch_reading.hpp"

#include <tinyxml2.h>

#include "core/file_contents.hpp"

namespace waitpoint::ros1 {
namespace {

constexpr std::size_t launch_bytes_max = std::size_t{64} << 20;
constexpr std::size_t elements_max = 20'000, scope_size_max = 2000;

}  // namespace

std::string LaunchReading::path_in(const LaunchScope& scope, const std::string& file) {
  return (std::filesystem::path(scope.file.text()).parent_path() / file).lexically_normal().string();
}

std::string LaunchReading::contents_of(const std::string& file, std::string_view expected) {
  std::string contents = file_contents(file, expected, launch_bytes_max);
  bytes += contents.size();
  if (bytes > launch_bytes_max) throw BadInput(file, "expected at most 64 MiB in all files of a launch");
  launch.add_text(contents);
  return contents;
}

void LaunchReading::count(const tinyxml2::XMLElement& element, const LaunchScope& scope) {
  const Location written{scope.file, element.GetLineNum()};
  if (++elements > elements_max)
    throw written.bad("expected at most " + std::to_string(elements_max) + " elements in all files of a launch");
  const std::size_t size = scope.arguments.size() + scope.declared.size() + scope.remappings.size() +
                           scope.environment.size() + scope.node_parameters.size();
  if (size > scope_size_max)
    throw written.bad("expected at most " + std::to_string(scope_size_max) +
                      " arguments, remappings, variables and parameters of nodes in a scope");
}

}  // namespace waitpoint::ros1
