// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/segments.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "core/error.hpp"
#include "core/exact_math.hpp"
#include "core/number_text.hpp"
#include "world/formats/limits.hpp"
#include "world/formats/line_words.hpp"

namespace waitpoint::world {
namespace {

constexpr double shortest_m = 1e-9;
constexpr std::string_view between_words = " \t\r,";

class SegmentReader {
 public:
  SegmentReader(const std::string& file, double height_m, LeftOut& left_out)
      : file_(file), height_m_(height_m), left_out_(left_out) {}

  void read_line(std::string_view line, int number) {
    line = line.substr(0, line.find('#'));
    std::string_view word = take_word(line, between_words);
    if (word.empty()) return;
    std::array<double, 4> ends{};
    for (double& coordinate : ends) {
      if (!parse_number(word, coordinate) || std::fabs(coordinate) > coordinate_m_max) {
        throw BadInput(file_, number,
                       "expected a segment 'x0 y0 x1 y1' in metres within 100 km, found " +
                           (word.empty() ? "the line's end" : shown(word)));
      }
      word = take_word(line, between_words);
    }
    if (!word.empty()) {
      throw BadInput(file_, number, "expected nothing after 'x0 y0 x1 y1', found " + shown(word));
    }
    const Point a = {ends[0], ends[1]}, b = {ends[2], ends[3]};
    if (length(b - a) < shortest_m) {
      left_out_.add(file_, number, "a segment without length", "is left out");
      return;
    }
    if (walls_.size() == obstacle_count_max) {
      throw BadInput(file_, number, "expected at most " + std::to_string(obstacle_count_max) + " segments");
    }
    walls_.push_back({"segment " + std::to_string(walls_.size()), wall_between(a, b, 0, height_m_), true});
  }

  std::vector<Obstacle> walls() {
    if (walls_.empty()) throw BadInput(file_, "expected segments 'x0 y0 x1 y1', found none");
    return std::move(walls_);
  }

 private:
  const std::string& file_;
  double height_m_;
  LeftOut& left_out_;
  std::vector<Obstacle> walls_;
};

}  // namespace

Shape wall_between(Point a, Point b, double z_low_m, double z_high_m) {
  Shape wall;
  const Point along = b - a;
  wall.pose = {0.5 * (a.x + b.x), 0.5 * (a.y + b.y), exact::atan2(along.y, along.x)};
  wall.length_m = length(along);
  wall.width_m = wall_thickness_m;
  wall.z_low_m = z_low_m;
  wall.z_high_m = z_high_m;
  return wall;
}

std::vector<Obstacle> parse_segments(std::string_view contents, const std::string& file, double height_m,
                                     LeftOut& left_out) {
  SegmentReader reader(file, height_m, left_out);
  int number = 0;
  while (!contents.empty()) {
    const std::string_view line = contents.substr(0, contents.find('\n'));
    contents.remove_prefix(std::min(line.size() + 1, contents.size()));
    reader.read_line(line, ++number);
  }
  return reader.walls();
}

}  // namespace waitpoint::world
