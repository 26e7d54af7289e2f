// SPDX-License-Identifier: BSD-3-Clause
// Changes a tree of YAML values as a person could who makes mistakes: other numbers, keys of other maps, subtrees
// twice, exchanged, removed or taken from another document. The result is a tree again, so that most changes reach what
// is behind the parser.
#pragma once

#include <map>
#include <random>
#include <string>
#include <vector>

#include "modules/scenario/yaml_tree.hpp"

namespace waitpoint::fuzz {

/// A replacement of a number that is written as `text`.
std::string other_number(const std::string& text, std::minstd_rand& random);

/// The entries and items that documents have at each key: the parts that can be put into others there.
class Vocabulary {
 public:
  void learn(const scenario::YamlNode& document) { learn(document, ""); }
  /// A part of a map, or of a list, at `key`; null if there is none.
  const scenario::YamlEntry* entry(const std::string& key, std::minstd_rand& random) const;
  const scenario::YamlNode* item(const std::string& key, std::minstd_rand& random) const;

 private:
  void learn(const scenario::YamlNode& node, const std::string& key);

  std::map<std::string, std::vector<scenario::YamlEntry>> entries_;
  std::map<std::string, std::vector<scenario::YamlNode>> items_;
};

/// Changes one to four places.
void mutate(scenario::YamlNode& document, const Vocabulary& vocabulary, std::minstd_rand& random);

}  // namespace waitpoint::fuzz
