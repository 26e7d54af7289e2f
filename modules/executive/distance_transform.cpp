// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/distance_transform.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"

namespace waitpoint::executive {
namespace {

// From so many steps along a column on, a square is at least square_half_cells_max.
constexpr std::uint16_t no_cell = 129;
constexpr std::int64_t no_square = std::numeric_limits<std::int64_t>::max();

std::int64_t square_to_edge(std::int64_t cells) {
  const std::int64_t half_cells = std::max<std::int64_t>(0, 2 * cells - 1);
  return half_cells * half_cells;
}

std::int64_t floor_divide(std::int64_t a, std::int64_t b) {  // b > 0
  return a >= 0 ? a / b : -((-a + b - 1) / b);
}

}  // namespace

void DistanceTransform::run(std::span<const Cell> cells, std::int32_t width, std::int32_t height,
                            std::span<std::uint16_t> squares) {
  const std::size_t columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  WAITPOINT_CHECK(cells.size() == columns * rows && squares.size() == columns * rows, "arrays of the wrong size");
  along_columns(cells, columns, squares);
  row_.resize(columns);
  sites_.resize(2 * columns + 1);
  heights_.resize(2 * columns + 1);
  starts_.resize(2 * columns + 1);
  for (std::size_t y = 0; y < rows; ++y) divide(squares.subspan(y * columns, columns));
}

// Each part reaches no_cell beyond its outermost obstacles: farther cells are beyond the cap.
void DistanceTransform::divide(std::span<std::uint16_t> row) {
  const auto is_near = [](std::uint16_t steps) { return steps < no_cell; };
  auto done = row.begin();
  for (auto near = std::find_if(done, row.end(), is_near); near != row.end();) {
    const auto begin = near - std::min<std::ptrdiff_t>(near - done, no_cell);
    auto last = near;
    // The next obstacle's part would overlap, or touch, this one.
    while (near != row.end() && near - last <= 2 * no_cell) {
      last = near;
      near = std::find_if(near + 1, row.end(), is_near);
    }
    const auto end = last + std::min<std::ptrdiff_t>(row.end() - last, no_cell);
    std::fill(done, begin, square_half_cells_max);
    along_row({begin, end});
    done = end;
  }
  std::fill(done, row.end(), square_half_cells_max);
}

// The steps to the nearest occupied cell of the same column, at most no_cell; in the memory of the result, for a map
// may have a hundred million cells.
void DistanceTransform::along_columns(std::span<const Cell> cells, std::size_t width, std::span<std::uint16_t> steps) {
  const auto one_more = [](std::uint16_t cells) {
    return cells < no_cell ? static_cast<std::uint16_t>(cells + 1) : no_cell;
  };
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::uint16_t below = i >= width ? steps[i - width] : no_cell;
    steps[i] = cells[i] == Cell::occupied ? 0 : one_more(below);
  }
  for (std::size_t i = steps.size(); i-- > width;) steps[i - width] = std::min(steps[i - width], one_more(steps[i]));
}

// From steps along the columns to squared distances.
void DistanceTransform::along_row(std::span<std::uint16_t> part) {
  const auto width = static_cast<std::int32_t>(part.size());
  std::transform(part.begin(), part.end(), row_.begin(),
                 [](std::uint16_t steps) { return steps < no_cell ? square_to_edge(steps) : no_square; });
  // The envelope: site k is the lowest parabola from starts_[k], a half-cell coordinate, to the next one's start.
  std::size_t count = 0;
  const auto add_site = [&](std::int32_t site, std::int64_t height) {
    std::int64_t start = 0;
    while (count > 0) {
      const std::int64_t other = sites_[count - 1];
      // First integer coordinate at which the new parabola is strictly lower.
      const std::int64_t numerator =
          height + static_cast<std::int64_t>(site) * site - heights_[count - 1] - other * other;
      start = std::max<std::int64_t>(0, floor_divide(numerator, 2 * (site - other)) + 1);
      if (start > starts_[count - 1]) break;
      --count;
      start = 0;
    }
    if (start > 2 * static_cast<std::int64_t>(width)) return;
    sites_[count] = site;
    heights_[count] = height;
    starts_[count++] = start;
  };
  for (std::int32_t x = 0; x <= width; ++x) {
    const std::int64_t left = x > 0 ? row_[static_cast<std::size_t>(x - 1)] : no_square;
    const std::int64_t right = x < width ? row_[static_cast<std::size_t>(x)] : no_square;
    // Between equal heights the edge is nowhere lower, at a cell's centre, than the centre lines beside it.
    if (left != right) add_site(2 * x, std::min(left, right));
    if (right != no_square) add_site(2 * x + 1, right);
  }
  std::size_t k = 0;
  for (std::int32_t x = 0; x < width; ++x) {
    std::int64_t square = square_half_cells_max;
    if (count > 0) {
      const std::int64_t at = 2 * static_cast<std::int64_t>(x) + 1;
      while (k + 1 < count && starts_[k + 1] <= at) ++k;
      const std::int64_t d = at - sites_[k];
      square = std::min(square, d * d + heights_[k]);
    }
    part[static_cast<std::size_t>(x)] = static_cast<std::uint16_t>(square);
  }
}

}  // namespace waitpoint::executive
