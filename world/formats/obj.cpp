// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/obj.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/number_text.hpp"
#include "world/formats/line_words.hpp"
#include "world/formats/mesh_builder.hpp"

namespace waitpoint::world {
namespace {

// Keywords of appearance and names, which are ignored.
constexpr std::array<std::string_view, 17> looks = {"vn",     "vt",     "vp",     "g",          "o",        "s",
                                                    "mtllib", "usemtl", "mg",     "bevel",      "c_interp", "d_interp",
                                                    "lod",    "usemap", "maplib", "shadow_obj", "trace_obj"};
constexpr std::array<std::string_view, 14> others = {"p",    "l",    "curv", "curv2", "surf", "cstype", "deg",
                                                     "bmat", "step", "parm", "trim",  "hole", "scrv",   "end"};

template <std::size_t count>
bool is_one_of(std::string_view word, const std::array<std::string_view, count>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

class ObjReader {
 public:
  ObjReader(const std::string& file, LeftOut& left_out) : builder_(file, left_out), file_(file), left_out_(left_out) {}

  void read_line(std::string_view line, int number) {
    line = line.substr(0, line.find('#'));
    const std::string_view word = take_word(line);
    if (word.empty() || is_one_of(word, looks)) return;
    if (word == "v") {
      builder_.read_corner(line, number, "expected 'v x y z'");
    } else if (word == "f") {
      read_face(line, number);
    } else if (is_one_of(word, others)) {
      left_out_.add(file_, number, "'" + std::string(word) + "'", "is left out");
    } else {
      builder_.fail(number, "expected OBJ: 'v', 'f' and so on, found " + shown(word));
    }
  }

  TriangleMesh mesh() { return builder_.mesh(); }

 private:
  void read_face(std::string_view line, int number) {
    std::uint32_t first = 0, last = 0;
    std::size_t count = 0;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
      const std::uint32_t corner = corner_of(word.substr(0, word.find('/')), number);
      if (count == 0) first = corner;
      if (count > 1) builder_.add_triangle(first, last, corner, number);
      last = corner;
      ++count;
    }
    if (count < 3) builder_.fail(number, "expected three corners of a face, or more");
  }

  // Corners are numbered from 1; negative numbers count back from the last corner.
  std::uint32_t corner_of(std::string_view word, int number) const {
    const auto count = static_cast<std::int64_t>(builder_.corner_count());
    std::int64_t given = 0;
    const bool good = parse_number(word, given) && given != 0 && given <= count && given >= -count;
    if (!good)
      builder_.fail(number, "expected one of the " + std::to_string(count) + " corners before, found " + shown(word));
    return static_cast<std::uint32_t>(given > 0 ? given - 1 : count + given);
  }

  MeshBuilder builder_;
  const std::string& file_;
  LeftOut& left_out_;
};

}  // namespace

TriangleMesh parse_obj(std::string_view contents, const std::string& file, LeftOut& left_out) {
  ObjReader reader(file, left_out);
  int number = 0;
  while (!contents.empty()) {
    const std::string_view line = contents.substr(0, contents.find('\n'));
    contents.remove_prefix(std::min(line.size() + 1, contents.size()));
    reader.read_line(line, ++number);
  }
  return reader.mesh();
}

}  // namespace waitpoint::world
