// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/yaml_tree.hpp"

#include "core/digest.hpp"

namespace waitpoint::scenario {

const YamlNode* YamlNode::find(std::string_view key) const {
  for (const YamlEntry& entry : entries) {
    if (entry.key == key) return entry.value.is_null() ? nullptr : &entry.value;
  }
  return nullptr;
}

YamlEntry* YamlNode::entry(std::string_view key) {
  for (YamlEntry& entry : entries) {
    if (entry.key == key) return &entry;
  }
  return nullptr;
}

std::string_view name_of(const YamlNode& node) {
  const YamlNode* name = node.find("name");
  return name != nullptr && name->kind == YamlNode::Kind::scalar ? std::string_view(name->text) : std::string_view();
}

std::uint64_t fingerprint(const YamlNode& node) {
  Digest digest;
  digest.add(static_cast<std::uint64_t>(node.kind));
  digest.add(std::string_view(node.text));
  for (const YamlNode& item : node.items) digest.add(fingerprint(item));
  for (const YamlEntry& entry : node.entries) {
    digest.add(std::string_view(entry.key));
    digest.add(fingerprint(entry.value));
  }
  return digest.value();
}

std::string described(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::null: return "nothing";
    case YamlNode::Kind::list: return "a list";
    case YamlNode::Kind::map: return "a map of keys";
    case YamlNode::Kind::scalar: break;
  }
  return "'" + node.text + "'";
}

}  // namespace waitpoint::scenario
