// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/stl.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "core/number_text.hpp"
#include "world/formats/limits.hpp"
#include "world/formats/line_words.hpp"
#include "world/formats/mesh_builder.hpp"

namespace waitpoint::world {
namespace {

constexpr std::size_t header_bytes = 84, triangle_bytes = 50;

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 4; i-- > 0;) number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

double coordinate_at(std::string_view bytes, std::size_t at) {
  return static_cast<double>(std::bit_cast<float>(number_at(bytes, at)));
}

TriangleMesh parse_bytes(std::string_view contents, std::size_t count, MeshBuilder& builder) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = header_bytes + triangle_bytes * i;
    const auto first = static_cast<std::uint32_t>(builder.corner_count());
    for (std::size_t corner = 1; corner <= 3; ++corner) {  // the normal comes before them
      const std::size_t of = at + 12 * corner;
      builder.add_corner(
          {coordinate_at(contents, of), coordinate_at(contents, of + 4), coordinate_at(contents, of + 8)}, 0);
    }
    builder.add_triangle(first, first + 1, first + 2, 0);
  }
  return builder.mesh();
}

bool is_word(std::string_view word, std::string_view lower_case) {
  return std::equal(word.begin(), word.end(), lower_case.begin(), lower_case.end(),
                    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
}

class TextReader {
 public:
  explicit TextReader(MeshBuilder& builder) : builder_(builder) {}

  void read_line(std::string_view line, int number) {
    const std::string_view word = take_word(line);
    if (word.empty() || is_word(word, "solid") || is_word(word, "facet") || is_word(word, "endfacet") ||
        is_word(word, "endsolid"))
      return;
    if (is_word(word, "outer")) {
      if (in_loop_) builder_.fail(number, "expected 'endloop' before another loop");
      in_loop_ = true;
      first_ = builder_.corner_count();
    } else if (is_word(word, "vertex") && in_loop_) {
      builder_.read_corner(line, number, "expected 'vertex x y z'");
    } else if (is_word(word, "endloop") && in_loop_) {
      if (builder_.corner_count() != first_ + 3) builder_.fail(number, "expected three vertices in a loop");
      const auto a = static_cast<std::uint32_t>(first_);
      builder_.add_triangle(a, a + 1, a + 2, number);
      in_loop_ = false;
    } else {
      builder_.fail(number, "expected STL: 'facet', 'outer loop', 'vertex' and so on, found " + shown(word));
    }
  }

  void end(int number) const {
    if (in_loop_) builder_.fail(number, "expected 'endloop' before the file's end");
  }

 private:
  MeshBuilder& builder_;
  bool in_loop_ = false;
  std::size_t first_ = 0;  // corner of the loop
};

}  // namespace

TriangleMesh parse_stl(std::string_view contents, const std::string& file, LeftOut& left_out) {
  MeshBuilder builder(file, left_out);
  const bool has_header = contents.size() >= header_bytes;
  const std::size_t count = has_header ? number_at(contents, header_bytes - 4) : 0;
  if (has_header && contents.size() == header_bytes + triangle_bytes * count)
    return parse_bytes(contents, count, builder);
  if (!is_word(contents.substr(0, 5), "solid")) {
    if (has_header && contents.size() > header_bytes + triangle_bytes * count && count > 0)
      return parse_bytes(contents, count, builder);  // with trailing bytes
    builder.fail(
        0, "expected STL: text that begins with 'solid', or 84 bytes and 50 for each triangle" +
               (has_header ? ", found " + std::to_string(contents.size()) + " bytes for " + counted(count, "triangle")
                           : ", found " + counted(contents.size(), "byte")));
  }
  TextReader reader(builder);
  int number = 0;
  while (!contents.empty()) {
    const std::string_view line = contents.substr(0, contents.find('\n'));
    contents.remove_prefix(std::min(line.size() + 1, contents.size()));
    reader.read_line(line, ++number);
  }
  reader.end(number);
  return builder.mesh();
}

}  // namespace waitpoint::world
