// SPDX-License-Identifier: BSD-3-Clause
// A YAML document as plain values that know where they were written, so that every error can name file and line, and
// documents can be put together (a robot's type and its overrides, an included floor, --set) before they are read.
//
// Keys are unique within a map and kept in their order. Anchors are copied where they are used; depth and size are
// bounded, so that no document of a few lines can expand without end.
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
    null,    ///< nothing written, `~` or `null`: the same as a key left out
    scalar,  ///< text
    list,
    map,
  };

  Kind kind = Kind::null;
  Location written;
  std::string text;                ///< scalar
  bool quoted = false;             ///< scalar: written in quotes, so never a number or a truth value
  std::vector<YamlNode> items;     ///< list
  std::vector<YamlEntry> entries;  ///< map

  bool is_null() const { return kind == Kind::null; }
  /// The value of a key of a map; nullptr if there is no such key, if its value is null, or if this is no map.
  const YamlNode* find(std::string_view key) const;
  /// The entry of a key of a map, null values included; nullptr if there is none.
  YamlEntry* entry(std::string_view key);
};

struct YamlEntry {
  std::string key;
  Location written;  ///< of the key
  YamlNode value;
};

/// The element's value of `name`, if this is a map that has one in plain text; else "".
std::string_view name_of(const YamlNode& node);

/// A hash of what is written, wherever it is: kinds, texts, keys in their order.
std::uint64_t fingerprint(const YamlNode& node);

/// What the node is, for "expected ..., found ...": "a list", "'fast'".
std::string described(const YamlNode& node);

/// Reads a file that holds one document. Throws BadInput: unreadable, no YAML, a key given twice, too deep or too
/// large.
YamlNode load_yaml(const std::filesystem::path& file);

/// Reads text whose lines count from 1 in `file`; with `file_has_lines` false all of it is written at `file` alone.
YamlNode parse_yaml(const std::string& text, const std::string& file, bool file_has_lines = true);

}  // namespace waitpoint::scenario
