// SPDX-License-Identifier: BSD-3-Clause
// The references of launch files besides files: packages, variables of the environment; and the reader of their YAML.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "modules/ros1/packages.hpp"

namespace waitpoint::ros1 {

/// The value of a YAML text, with the types of parameters; null for an empty one. Lines of errors, which are BadInput,
/// are those of the text, in `file`.
using YamlValue = std::function<nlohmann::json(const std::string& text, const std::string& file)>;

struct LaunchSurroundings {
  Packages packages;
  Environment environment;
  YamlValue yaml;
};

}  // namespace waitpoint::ros1
