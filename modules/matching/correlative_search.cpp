// SPDX-License-Identifier: BSD-3-Clause
#include "modules/matching/correlative_search.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "modules/matching/cell_of.hpp"

namespace waitpoint::matching {

ScorePyramid::ScorePyramid(const SurfaceMap& map, unsigned levels)
    : cell_m_(map.cell_m()), x_(map.x()), y_(map.y()), levels_(levels) {
  Level maxima{map.width(), map.height(), 0, {map.scores().begin(), map.scores().end()}};  // over the blocks alone
  levels_[0] = maxima;
  for (unsigned h = 1; h < levels; ++h) {
    const Level below = std::move(maxima);
    const auto value = [](const Level& level, int x, int y) -> std::uint8_t {
      if (x < 0 || y < 0 || x >= level.width || y >= level.height) return 0;
      return level
          .values[static_cast<std::size_t>(y) * static_cast<std::size_t>(level.width) + static_cast<std::size_t>(x)];
    };
    maxima = {(below.width + 1) / 2, (below.height + 1) / 2, 0, {}};
    maxima.values.reserve(static_cast<std::size_t>(maxima.width) * static_cast<std::size_t>(maxima.height));
    const auto of_four = [&value](const Level& level, int x, int y) {
      return std::max({value(level, x, y), value(level, x + 1, y), value(level, x, y + 1), value(level, x + 1, y + 1)});
    };
    for (int y = 0; y < maxima.height; ++y) {
      for (int x = 0; x < maxima.width; ++x) maxima.values.push_back(of_four(below, 2 * x, 2 * y));
    }
    // A block's worth of cells from any cell of a block on lies in that block and the next ones: one block more, before
    // the first, has the first ones as its next.
    Level& level = levels_[h];
    level.width = maxima.width + 1;
    level.height = maxima.height + 1;
    level.margin = 1;
    level.values.reserve(static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height));
    for (int y = -1; y < maxima.height; ++y) {
      for (int x = -1; x < maxima.width; ++x) level.values.push_back(of_four(maxima, x, y));
    }
  }
}

int ScorePyramid::column(double coordinate_m) const { return cell_of(coordinate_m / cell_m_); }

namespace {

struct CellOfPoint {
  int x, y;
};

/// All poses of one heading whose offset from the window's centre is less than 2^level cells beyond (x, y).
struct Block {
  std::uint32_t bound;
  int turn, x, y;
  unsigned level;

  // For a queue of the best first: a total order.
  friend bool operator<(const Block& a, const Block& b) {
    if (a.bound != b.bound) return a.bound < b.bound;
    if (a.level != b.level) return a.level > b.level;
    if (a.turn != b.turn) return a.turn > b.turn;
    return a.x != b.x ? a.x > b.x : a.y > b.y;
  }
};

class Search {
 public:
  Search(const ScorePyramid& pyramid, std::span<const SurfacePoint> scan, const SearchWindow& window,
         const SearchParameters& parameters)
      : pyramid_(pyramid), window_(window), parameters_(parameters) {
    const Point* kept = nullptr;
    for (const SurfacePoint& p : scan) {
      if (kept != nullptr && length(p.position - *kept) < parameters.spacing_m) continue;
      kept = &p.position;
      points_.push_back(p.position);
    }
    least_ = static_cast<std::uint32_t>(parameters.score_min * greatest());
  }

  std::vector<Peak> run() {
    std::vector<Peak> peaks;
    if (points_.empty()) return peaks;
    start();
    for (std::uint32_t opened = 0; !blocks_.empty(); ++opened) {
      const Block block = blocks_.top();
      blocks_.pop();
      if (opened == parameters_.openings_max) return {};
      if (!peaks.empty() && block.bound < parameters_.rival_share * peaks[0].score * greatest()) break;
      if (near_a_peak(block, peaks)) continue;
      if (block.level > 0) {
        open(block);
        continue;
      }
      peaks.push_back({pose_of(block), block.bound / greatest()});
      if (peaks.size() == parameters_.peaks_max) break;
    }
    return peaks;
  }

 private:
  double greatest() const { return 255.0 * static_cast<double>(points_.size()); }

  Pose pose_of(const Block& block) const {
    return {window_.centre.x + block.x * pyramid_.cell_m(), window_.centre.y + block.y * pyramid_.cell_m(),
            exact::wrap_angle(window_.centre.heading + block.turn * step_rad_)};
  }

  void start() {
    step_rad_ = pyramid_.cell_m() / parameters_.arm_m;
    turns_ = static_cast<int>(std::ceil(window_.half_turn_rad / step_rad_));
    if (2 * turns_ * step_rad_ > 2 * exact::pi) turns_ = static_cast<int>(exact::pi / step_rad_);
    const int half_x = static_cast<int>(std::ceil(window_.half_width_m / pyramid_.cell_m()));
    const int half_y = static_cast<int>(std::ceil(window_.half_height_m / pyramid_.cell_m()));
    const unsigned top = pyramid_.levels() - 1;
    unsigned level = 0;
    while (level < top && (2 << level) <= std::max(half_x, half_y)) ++level;
    const int size = 1 << level;
    for (int turn = -turns_; turn <= turns_; ++turn) {
      rotate(turn);
      for (int y = -half_y; y <= half_y; y += size) {
        for (int x = -half_x; x <= half_x; x += size) push({0, turn, x, y, level});
      }
    }
  }

  void rotate(int turn) {
    const auto [sine, cosine] = exact::sincos(window_.centre.heading + turn * step_rad_);
    std::vector<CellOfPoint> cells;
    cells.reserve(points_.size());
    for (const Point& p : points_) {
      cells.push_back({pyramid_.column(window_.centre.x + (cosine * p.x - sine * p.y)),
                       pyramid_.column(window_.centre.y + (sine * p.x + cosine * p.y))});
    }
    cells_.push_back(std::move(cells));
  }

  void push(Block block) {
    std::uint32_t sum = 0;
    const int turn = block.turn + turns_;
    for (const CellOfPoint& cell : cells_[static_cast<std::size_t>(turn)]) {
      sum += pyramid_.bound(block.level, cell.x + block.x, cell.y + block.y);
    }
    if (sum < least_) return;
    block.bound = sum;
    blocks_.push(block);
  }

  void open(const Block& block) {
    const int half = 1 << (block.level - 1);
    for (const int dy : {0, half}) {
      for (const int dx : {0, half}) push({0, block.turn, block.x + dx, block.y + dy, block.level - 1});
    }
  }

  // True if all poses of a block are one with a peak.
  bool near_a_peak(const Block& block, const std::vector<Peak>& peaks) const {
    const Pose low = pose_of(block);
    const double size = ((1 << block.level) - 1) * pyramid_.cell_m();
    for (const Peak& peak : peaks) {
      const double dx = std::max(std::fabs(low.x - peak.pose.x), std::fabs(low.x + size - peak.pose.x));
      const double dy = std::max(std::fabs(low.y - peak.pose.y), std::fabs(low.y + size - peak.pose.y));
      if (dx <= parameters_.apart_m && dy <= parameters_.apart_m &&
          std::fabs(exact::wrap_angle(low.heading - peak.pose.heading)) <= parameters_.apart_rad) {
        return true;
      }
    }
    return false;
  }

  const ScorePyramid& pyramid_;
  SearchWindow window_;
  SearchParameters parameters_;
  std::vector<Point> points_;
  std::vector<std::vector<CellOfPoint>> cells_;  // by turn
  std::priority_queue<Block> blocks_;
  double step_rad_ = 0;
  int turns_ = 0;
  std::uint32_t least_ = 0;
};

}  // namespace

std::vector<Peak> search(const ScorePyramid& pyramid, std::span<const SurfacePoint> scan, const SearchWindow& window,
                         const SearchParameters& parameters) {
  return Search(pyramid, scan, window, parameters).run();
}

}  // namespace waitpoint::matching
