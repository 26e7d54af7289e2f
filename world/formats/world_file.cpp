// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/world_file.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "core/file_contents.hpp"
#include "world/formats/limits.hpp"
#include "world/formats/map_server.hpp"
#include "world/formats/merged_cells.hpp"
#include "world/formats/sdf.hpp"
#include "world/formats/segments.hpp"
#include "world/formats/stage.hpp"

namespace waitpoint::world {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
constexpr std::string_view expectation =
    "a world: a map_server YAML file, a segment map, an SDF file or a world of Stage's";

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

// The rest of the text after leading blanks and comments, which begin with '#' in all formats but SDF.
std::string_view behind_comments(std::string_view text) {
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  while (!text.empty()) {
    const char c = text.front();
    if (c == '#') {
      text.remove_prefix(std::min(text.find('\n'), text.size()));
    } else if (c == ' ' || (c >= '\t' && c <= '\r')) {
      text.remove_prefix(1);
    } else {
      break;
    }
  }
  return text;
}

}  // namespace

std::optional<WorldFormat> format_of(std::string_view contents) {
  const std::string_view text = behind_comments(contents);
  if (text.empty()) return std::nullopt;
  if (text.front() == '<') return WorldFormat::sdf;
  if (text.starts_with("---") || text.starts_with("%YAML") || text.front() == '{') return WorldFormat::map_server;
  const bool signed_number =
      text.size() > 1 && (text[0] == '-' || text[0] == '.') && (is_digit(text[1]) || text[1] == '.');
  if (is_digit(text.front()) || signed_number) return WorldFormat::segments;
  if (!is_letter(text.front())) return std::nullopt;
  const auto end = std::find_if(text.begin(), text.end(), [](char c) { return !is_letter(c) && !is_digit(c); });
  return end != text.end() && *end == ':' ? WorldFormat::map_server : WorldFormat::stage;
}

WorldFile read_world_file(const std::string& file, double height_m) {
  const std::string contents = file_contents(file, expectation, text_bytes_max);
  const std::optional<WorldFormat> format = format_of(contents);
  if (!format) throw BadInput(file, 1, "expected " + std::string(expectation));
  WorldFile world;
  LeftOut left_out;
  switch (*format) {
    case WorldFormat::segments: world.obstacles = parse_segments(contents, file, height_m, left_out); break;
    case WorldFormat::map_server:
      world.grid = parse_map_server_map(contents, file, left_out);
      world.obstacles = obstacles_of(*world.grid, "map", 0, height_m, file);
      break;
    case WorldFormat::sdf: {
      SdfWorld sdf = parse_sdf(contents, file, left_out);
      world.obstacles = std::move(sdf.obstacles);
      world.meshes = std::move(sdf.meshes);
      world.has_heights = true;
      break;
    }
    case WorldFormat::stage: {
      StageWorld stage = parse_stage(contents, file, left_out);
      world.obstacles = std::move(stage.obstacles);
      world.bodies = std::move(stage.bodies);
      world.origins = std::move(stage.origins);
      world.has_heights = true;
      break;
    }
  }
  world.warnings = left_out.warnings();
  return world;
}

}  // namespace waitpoint::world
