// SPDX-License-Identifier: BSD-3-Clause
// A YAML document as plain values with their places in the input, so that every error can name file and line, and
// documents can be combined (a robot type with overrides, an included floor, --set) before they are read.
//
// Keys are unique within a map and keep their order. Aliases are copies of their anchors, `<<` is carried out; depth
// and size are bounded, so that a short document cannot expand without limit: yaml_builder.hpp. A file has at most 64
// MiB.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "modules/scenario/location.hpp"

namespace waitpoint::scenario {

struct YamlEntry;

struct YamlNode {
  enum class Kind {
    null,    ///< empty, `~` or `null`: equivalent to a missing key
    scalar,  ///< text
    list,
    map,
  };

  Kind kind = Kind::null;
  Location written;
  std::string text;                ///< scalar
  bool quoted = false;             ///< scalar: in quotes, so never a number or boolean
  std::vector<YamlNode> items;     ///< list
  std::vector<YamlEntry> entries;  ///< map

  bool is_null() const { return kind == Kind::null; }
  /// The value of a key; nullptr if the key is missing, its value is null, or this is not a map.
  const YamlNode* find(std::string_view key) const;
  /// The entry of a key, even with a null value; nullptr if there is none.
  YamlEntry* entry(std::string_view key);
};

struct YamlEntry {
  std::string key;
  Location written;  ///< of the key
  YamlNode value;
};

/// The value of the key `name` if this is a map and the value is a scalar; else "".
std::string_view name_of(const YamlNode& node);

/// A hash of kinds, texts and keys in order; independent of places.
std::uint64_t fingerprint(const YamlNode& node);

/// Description of a node for "expected ..., found ...": "a list", "'fast'".
std::string described(const YamlNode& node);

/// Reads a file with one document. Throws BadInput for an unreadable file, invalid YAML, a duplicate key, or excessive
/// depth or size.
YamlNode load_yaml(const std::filesystem::path& file);

/// Parses text whose lines count from 1 in `file`; with `file_has_lines` false all values are located at `file` itself.
YamlNode parse_yaml(const std::string& text, const std::string& file, bool file_has_lines = true);

}  // namespace waitpoint::scenario
