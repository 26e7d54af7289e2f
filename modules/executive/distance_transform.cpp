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

void DistanceTransform::run(std::span<const std::uint8_t> occupied, std::int32_t width, std::int32_t height,
                            std::span<std::uint16_t> squares) {
  const std::size_t columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  WAITPOINT_CHECK(occupied.size() == columns * rows && squares.size() == columns * rows, "arrays of the wrong size");
  along_columns(occupied, columns, squares);
  row_.resize(columns);
  sites_.resize(2 * columns + 1);
  heights_.resize(2 * columns + 1);
  starts_.resize(2 * columns + 1);
  for (std::size_t y = 0; y < rows; ++y) {
    const std::span<std::uint16_t> row = squares.subspan(y * columns, columns);
    bool any = false;
    for (std::size_t x = 0; x < columns; ++x) {
      any |= row[x] < no_cell;
      row_[x] = row[x] < no_cell ? square_to_edge(row[x]) : no_square;
    }
    if (any)
      along_row(width, row_, row);
    else
      std::fill(row.begin(), row.end(), square_half_cells_max);
  }
}

// The steps to the nearest occupied cell of the same column, at most no_cell; in the memory of the result, for a map
// may have a hundred million cells.
void DistanceTransform::along_columns(std::span<const std::uint8_t> occupied, std::size_t width,
                                      std::span<std::uint16_t> steps) {
  const auto one_more = [](std::uint16_t cells) {
    return cells < no_cell ? static_cast<std::uint16_t>(cells + 1) : no_cell;
  };
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::uint16_t below = i >= width ? steps[i - width] : no_cell;
    steps[i] = occupied[i] ? 0 : one_more(below);
  }
  for (std::size_t i = steps.size(); i-- > width;) steps[i - width] = std::min(steps[i - width], one_more(steps[i]));
}

void DistanceTransform::along_row(std::int32_t width, std::span<const std::int64_t> column_squares,
                                  std::span<std::uint16_t> squares) {
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
    const std::int64_t left = x > 0 ? column_squares[static_cast<std::size_t>(x - 1)] : no_square;
    const std::int64_t right = x < width ? column_squares[static_cast<std::size_t>(x)] : no_square;
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
    squares[static_cast<std::size_t>(x)] = static_cast<std::uint16_t>(square);
  }
}

}  // namespace waitpoint::executive
