// SPDX-License-Identifier: BSD-3-Clause
// Documents put together: one laid over another, and single values set by their path.
#pragma once

#include <string>
#include <string_view>

#include "modules/scenario/yaml_tree.hpp"

namespace waitpoint::scenario {

/// `over` laid over `base`. Maps are merged key by key; so are lists whose elements all have names, element by element
/// (new names at the end); anything else in `over` takes the place of what `base` has.
YamlNode laid_over(const YamlNode& base, const YamlNode& over);

/// An option `--set path=value`, taken apart. `path` has keys, and for elements of lists their index or name, joined by
/// dots; `value` is YAML and is written at the option. Throws BadInput for text that is not of this form.
struct Assignment {
  std::string path;
  YamlNode value;

  explicit Assignment(const std::string& text);
};

/// Replaces the value at the assignment's path. Keys of maps that are missing are made: who reads the document tells
/// unknown ones. Throws BadInput naming the option for an element that a list does not have, and for a path through a
/// plain value.
void assign(YamlNode& document, const Assignment& assignment);

}  // namespace waitpoint::scenario
