// SPDX-License-Identifier: BSD-3-Clause
// Launch files of tests, with packages and variables of their own.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "modules/ros1/launch_file.hpp"
#include "modules/scenario/parameter_value.hpp"
#include "tests/modules/scenario/scenario_text.hpp"

namespace waitpoint::ros1 {

class LaunchTexts : public ::testing::Test {
 protected:
  /// What the file `a.launch` with this text says. Other files, and packages in `share`, may lie beside it.
  Launch read(const std::string& text, const LaunchArguments& arguments = {}, const std::string& ns = "/") {
    Launch launch;
    LaunchSurroundings surroundings = {Packages({folder_.path() / "share"}),
                                       [this](const std::string& name) -> std::optional<std::string> {
                                         return variables_.contains(name) ? std::optional(variables_[name])
                                                                          : std::nullopt;
                                       },
                                       [](const std::string& yaml, const std::string& file) {
                                         return scenario::parameter_value(scenario::parse_yaml(yaml, file));
                                       }};
    read_launch_file({.file = folder_.write("a.launch", text),
                      .arguments = arguments,
                      .ns = ns,
                      .written = {(folder_.path() / "s.yaml").string(), 7}},
                     surroundings, launch);
    return launch;
  }
  /// With the elements of <launch>, which begin in line 2.
  Launch read_elements(const std::string& elements, const LaunchArguments& arguments = {}) {
    return read("<launch>\n" + elements + "\n</launch>", arguments);
  }
  /// The error, without the folder's name.
  std::string complaint(const std::string& text, const LaunchArguments& arguments = {}) {
    std::string message = scenario::message_of<BadInput>([&] { read(text, arguments); });
    const std::string folder = folder_.path().string() + "/";
    for (std::size_t at = message.find(folder); at != message.npos; at = message.find(folder))
      message.erase(at, folder.size());
    return message;
  }
  std::string complaint_about(const std::string& elements, const LaunchArguments& arguments = {}) {
    return complaint("<launch>\n" + elements + "\n</launch>", arguments);
  }

  scenario::TemporaryFolder folder_;
  std::map<std::string, std::string> variables_;
};

/// "/a/b=1 /c=\"x\"": all parameters by name.
inline std::string text_of(const std::map<std::string, Parameter>& parameters) {
  std::string text;
  for (const auto& [name, parameter] : parameters)
    text += (text.empty() ? "" : " ") + name + "=" + parameter.value.dump();
  return text;
}

/// "a:b c:d".
inline std::string text_of(const std::vector<Remapping>& remappings) {
  std::string text;
  for (const Remapping& each : remappings) text += (text.empty() ? "" : " ") + each.from + ":" + each.to;
  return text;
}

inline std::string text_of(const std::vector<EnvironmentVariable>& environment) {
  std::string text;
  for (const EnvironmentVariable& each : environment) text += (text.empty() ? "" : " ") + each.name + "=" + each.value;
  return text;
}

}  // namespace waitpoint::ros1
