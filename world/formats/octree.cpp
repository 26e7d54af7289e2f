// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/octree.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "core/error.hpp"
#include "core/file_contents.hpp"
#include "core/number_text.hpp"
#include "world/formats/limits.hpp"
#include "world/formats/line_words.hpp"

namespace waitpoint::world {
namespace {

constexpr int levels = 16;
constexpr double resolution_m_max = 1e3;

/// A box of cells, in units of the least cell from the corner of the tree.
struct Block {
  std::uint32_t x_low, x_high, y_low, y_high, z_low, z_high;
  std::uint32_t size() const { return y_high - y_low; }  // while it is a column
};

class OctreeReader {
 public:
  OctreeReader(std::string_view contents, const std::string& file) : rest_(contents), file_(file) {}

  std::vector<Block> cells() {
    read_header();
    if (node_count_ > 0) read_root();
    if (cells_.empty()) fail("expected occupied cells, found none");
    return std::move(cells_);
  }
  double resolution_m() const { return resolution_m_; }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw BadInput(file_, message); }

  std::string_view take_line() {
    const std::string_view line = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(std::min(line.size() + 1, rest_.size()));
    return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
  }

  void read_header() {
    constexpr std::string_view expected =
        "expected an octree: '# Octomap OcTree file' or '# Octomap OcTree binary file'";
    const std::string_view first = take_line();
    if (!first.starts_with("# Octomap OcTree")) fail(std::string(expected));
    is_binary_ = first.find("binary") != first.npos;
    constexpr int lines_max = 100;
    for (int number = 2; number < lines_max; ++number) {
      const std::string_view line = take_line();
      const std::string_view key = line.substr(0, line.find(' '));
      const std::string_view value = line.substr(std::min(key.size() + 1, line.size()));
      if (key == "data") return check_header();
      if (key == "id") {
        is_coloured_ = value == "ColorOcTree";
        if (value != "OcTree" && !is_coloured_)
          fail("expected a tree of id OcTree or ColorOcTree, found " + shown(value));
      } else if (key == "size") {
        if (!parse_number(value, node_count_)) fail("expected 'size' to be a number of nodes, found " + shown(value));
      } else if (key == "res") {
        if (!parse_number(value, resolution_m_)) resolution_m_ = 0;
      } else if (!key.starts_with('#') && !key.empty()) {
        fail("expected 'id', 'size', 'res' or 'data', found " + shown(key));
      }
    }
    fail("expected a header that ends with 'data'");
  }

  void check_header() const {
    if (!(resolution_m_ > 0 && resolution_m_ <= resolution_m_max))
      fail("expected 'res' to be the edge of a cell, above 0 and at most 1000 m");
  }

  unsigned take_byte() {
    if (rest_.empty()) fail("expected an octree of " + counted(node_count_, "node") + ", found the file's end");
    const auto byte = static_cast<unsigned char>(rest_.front());
    rest_.remove_prefix(1);
    return byte;
  }

  void add(const Block& cell) {
    if (cells_.size() == octree_cell_count_max)
      fail("expected at most " + std::to_string(octree_cell_count_max) + " occupied cells");
    cells_.push_back(cell);
  }

  static Block child_of(const Block& node, unsigned child) {
    const std::uint32_t half = node.size() / 2;
    const auto part = [&](unsigned bit, std::uint32_t low) { return (child >> bit & 1) != 0 ? low + half : low; };
    const std::uint32_t x = part(0, node.x_low), y = part(1, node.y_low), z = part(2, node.z_low);
    return {x, x + half, y, y + half, z, z + half};
  }

  void read_root() {
    constexpr std::uint32_t whole = std::uint32_t{1} << levels;
    const Block root = {0, whole, 0, whole, 0, whole};
    is_binary_ ? read_states(root, levels) : read_odds(root, levels);
  }

  // A node with children; it has no state of its own.
  void read_states(const Block& node, int level) {
    if (level == 0) fail("expected a tree of at most 16 levels");
    unsigned states = take_byte();
    states |= take_byte() << 8;
    for (unsigned child = 0; child < 8; ++child)
      if ((states >> 2 * child & 3) == 2) add(child_of(node, child));
    for (unsigned child = 0; child < 8; ++child)
      if ((states >> 2 * child & 3) == 3) read_states(child_of(node, child), level - 1);
  }

  void read_odds(const Block& node, int level) {
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i) bits |= std::uint32_t{take_byte()} << 8 * i;
    const float odds = std::bit_cast<float>(bits);
    for (int i = 0; is_coloured_ && i < 3; ++i) take_byte();
    const unsigned children = take_byte();
    if (children != 0 && level == 0) fail("expected a tree of at most 16 levels");
    if (children == 0 && odds >= 0) add(node);  // false for NaN
    for (unsigned child = 0; child < 8; ++child)
      if ((children >> child & 1) != 0) read_odds(child_of(node, child), level - 1);
  }

  std::string_view rest_;
  const std::string& file_;
  bool is_binary_ = false, is_coloured_ = false;
  std::uint64_t node_count_ = 0;
  double resolution_m_ = 0;
  std::vector<Block> cells_;
};

// Merges neighbours, which sorting by `key` makes adjacent; `joins(first, second)` extends the first and returns true
// if the second continues it.
template <class Key, class Joins>
void merge(std::vector<Block>& blocks, Key key, Joins joins) {
  std::sort(blocks.begin(), blocks.end(), [&](const Block& a, const Block& b) { return key(a) < key(b); });
  std::size_t last = 0;
  for (std::size_t i = 1; i < blocks.size(); ++i)
    if (!joins(blocks[last], blocks[i])) blocks[++last] = blocks[i];
  blocks.resize(std::min(blocks.size(), last + 1));
}

void merge_all(std::vector<Block>& blocks) {
  merge(
      blocks, [](const Block& b) { return std::tuple(b.size(), b.y_low, b.x_low, b.z_low); },
      [](Block& a, const Block& b) {
        const bool follows =
            std::tie(a.y_low, a.y_high, a.x_low, a.z_high) == std::tie(b.y_low, b.y_high, b.x_low, b.z_low);
        if (follows) a.z_high = b.z_high;
        return follows;
      });
  merge(
      blocks, [](const Block& b) { return std::tuple(b.size(), b.z_low, b.z_high, b.y_low, b.x_low); },
      [](Block& a, const Block& b) {
        const bool follows = std::tie(a.z_low, a.z_high, a.y_low, a.y_high, a.x_high) ==
                             std::tie(b.z_low, b.z_high, b.y_low, b.y_high, b.x_low);
        if (follows) a.x_high = b.x_high;
        return follows;
      });
  merge(
      blocks, [](const Block& b) { return std::tuple(b.z_low, b.z_high, b.x_low, b.x_high, b.y_low); },
      [](Block& a, const Block& b) {
        const bool follows = std::tie(a.z_low, a.z_high, a.x_low, a.x_high, a.y_high) ==
                             std::tie(b.z_low, b.z_high, b.x_low, b.x_high, b.y_low);
        if (follows) a.y_high = b.y_high;
        return follows;
      });
}

// Boxes that share a face have it at exactly the same coordinate.
Shape shape_of(const Block& block, double resolution_m) {
  const auto at = [&](std::uint32_t cell) { return (static_cast<double>(cell) - (1 << (levels - 1))) * resolution_m; };
  Shape shape;
  shape.pose = {0.5 * (at(block.x_low) + at(block.x_high)), 0.5 * (at(block.y_low) + at(block.y_high)), 0};
  shape.length_m = at(block.x_high) - at(block.x_low);
  shape.width_m = at(block.y_high) - at(block.y_low);
  shape.z_low_m = at(block.z_low);
  shape.z_high_m = at(block.z_high);
  return shape;
}

bool is_within(const Shape& shape) {
  return std::max({std::fabs(shape.pose.x), std::fabs(shape.pose.y), std::fabs(shape.z_low_m),
                   std::fabs(shape.z_high_m), shape.length_m, shape.width_m}) <= coordinate_m_max;
}

}  // namespace

std::vector<Shape> parse_octree(std::string_view contents, const std::string& file) {
  OctreeReader reader(contents, file);
  std::vector<Block> blocks = reader.cells();
  merge_all(blocks);
  if (blocks.size() > obstacle_count_max)
    throw BadInput(file, "expected at most " + std::to_string(obstacle_count_max) + " boxes of cells");
  std::vector<Shape> shapes;
  for (const Block& block : blocks) {
    shapes.push_back(shape_of(block, reader.resolution_m()));
    if (!is_within(shapes.back())) throw BadInput(file, "expected cells within 100 km");
  }
  return shapes;
}

std::vector<Obstacle> read_octree(const std::string& file, const std::string& name, const Pose& pose, double height_m,
                                  LeftOut& left_out) {
  std::vector<Obstacle> obstacles;
  for (Shape shape : parse_octree(file_contents(file, "an octree of OctoMap's", octree_bytes_max), file)) {
    shape.pose = compose(pose, shape.pose);
    shape.z_low_m += height_m;
    shape.z_high_m += height_m;
    if (shape.z_high_m <= 0) {
      left_out.add(file, 1, "an obstacle below the floor", "is left out");
    } else {
      obstacles.push_back({name + " " + std::to_string(obstacles.size()), shape});
    }
  }
  return obstacles;
}

}  // namespace waitpoint::world
