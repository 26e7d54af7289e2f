// SPDX-License-Identifier: BSD-3-Clause
// Parses the text of a Stage world, with its includes, into a tree.
//
//   include "pioneer.inc"            the text of another file, relative to this one
//   define NAME TYPE ( ... )         a type derived from TYPE
//   TYPE ( ... )                     a thing of a type, with properties: `size [1 2 3]`, `color "red"`, `fov 180`
//   # ...                            a comment, to the end of the line
//
// Types are built in or defined before. A thing inherits the properties of its type that it does not set itself, and
// the things in its type besides its own. These are looked up, not copied, so that a tree is never larger than its
// text.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace waitpoint::world {

/// A line of a file.
struct StagePlace {
  const std::string* file = nullptr;
  int line = 0;
};

/// The supported properties.
enum class StageKey {
  acceleration_bounds,
  bitmap,
  boundary,
  drive,
  fov,
  name,
  obstacle_return,
  origin,
  points,
  pose,
  range,
  range_max,
  range_min,
  ranger_return,
  samples,
  scount,
  size,
  sview,
  update_interval,
  velocity_bounds,
  wheelbase,
  z,
};
inline constexpr std::array<std::string_view, 22> stage_keys = {
    "acceleration_bounds", "bitmap",          "boundary",  "drive",  "fov",   "name",
    "obstacle_return",     "origin",          "points",    "pose",   "range", "range_max",
    "range_min",           "ranger_return",   "samples",   "scount", "size",  "sview",
    "update_interval",     "velocity_bounds", "wheelbase", "z"};

struct StageProperty {
  std::string_view name;
  std::vector<std::string_view> values;  ///< one, or the elements of a list
  StagePlace place;
};

struct StageThing {
  std::string_view type;             ///< as written
  std::string_view built_in;         ///< its built-in base type: "model", "position", "ranger", ...
  const StageThing* base = nullptr;  ///< the definition of its type; null for a built-in one
  int depth = 0;                     ///< length of its chain of definitions
  int nesting = 0;                   ///< depth of the things within it, those of its type included
  std::array<const StageProperty*, stage_keys.size()> known{};  ///< the last mention of each, here or in its type
  StagePlace place;
  std::vector<StageProperty> properties;
  std::vector<StageThing> things;

  /// Null if the property is not given.
  const StageProperty* find(StageKey key) const { return known[static_cast<std::size_t>(key)]; }
  /// Any property, such as "spose[2]": its last mention here or in its type; null if it is not given.
  const StageProperty* find_named(std::string_view name) const;
};

/// Not movable: its parts refer to each other.
class StageText {
 public:
  /// Parses the contents of `file`. BadInput, naming file and line.
  StageText(const std::string& contents, const std::string& file);
  StageText(const StageText&) = delete;
  StageText& operator=(const StageText&) = delete;

  /// The world, with its own properties and its things.
  const StageThing& world() const { return world_; }

 private:
  friend class StageParser;

  std::deque<std::string> names_, texts_;  // of the files
  std::deque<StageThing> definitions_;
  std::map<std::string_view, const StageThing*> types_;
  StageThing world_;
};

}  // namespace waitpoint::world
