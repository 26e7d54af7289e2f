// SPDX-License-Identifier: BSD-3-Clause
// Combination of documents: overlays, and single values set by path.
#pragma once

#include <string>
#include <string_view>

#include "modules/scenario/yaml_tree.hpp"

namespace waitpoint::scenario {

/// `base` overridden by `over`. Maps are merged by key, and lists by element name if all their elements have names (new
/// names at the end); any other value of `over` replaces that of `base`.
YamlNode laid_over(const YamlNode& base, const YamlNode& over);
/// The same of two lists: elements of `over` override those of `base` with their names; others are appended.
void lay_elements_over(YamlNode& base, const YamlNode& over);

/// A parsed option `--set path=value`. `path` has keys, and indices or names of list elements, joined by dots; `value`
/// is YAML located at the option. Throws BadInput for other text.
struct Assignment {
  std::string path;
  YamlNode value;

  explicit Assignment(const std::string& text);
};

/// Replaces the value at the assignment's path. Missing keys of maps are added; unknown ones are found when the
/// document is read. Throws BadInput naming the option for a missing list element or a path through a scalar.
void assign(YamlNode& document, const Assignment& assignment);

}  // namespace waitpoint::scenario
