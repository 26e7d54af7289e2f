// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/distance_transform.hpp"

#include <algorithm>
#include <cstring>
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

// Eight cells of a row at a time, by vectors that every processor has; the rest one by one.
typedef std::uint16_t EightSteps __attribute__((vector_size(16)));
typedef std::uint8_t EightCells __attribute__((vector_size(8)));

template <class Vector, class Element>
Vector load(const Element* from) {
  Vector vector;
  std::memcpy(&vector, from, sizeof vector);
  return vector;
}
template <class Vector>
void store(Vector vector, std::uint16_t* to) {
  std::memcpy(to, &vector, sizeof vector);
}
template <class Steps>
Steps one_more(Steps steps) {
  const auto more = static_cast<Steps>(steps + 1), most = static_cast<Steps>(Steps{} + no_cell);
  return more < most ? more : most;
}
// All bits where a cell is occupied.
EightSteps occupied(EightSteps, const Cell* cells) {
  const auto eight = __builtin_convertvector(load<EightCells>(cells), EightSteps);
  return reinterpret_cast<EightSteps>(eight == static_cast<std::uint16_t>(Cell::occupied));
}
std::uint16_t occupied(std::uint16_t, const Cell* cell) { return *cell == Cell::occupied ? 0xFFFF : 0; }

// Calls act(zero of the cells' type, index of the first cell) for all cells of the row from `first` on.
template <class Act>
void for_each_of_row(std::size_t first, std::size_t width, const Act& act) {
  std::size_t x = 0;
  for (; x + 8 <= width; x += 8) act(EightSteps{}, first + x);
  for (; x < width; ++x) act(std::uint16_t{0}, first + x);
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
    while (near != row.end() && near - last <= std::ptrdiff_t{2} * no_cell) {
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
  const auto upwards = [&](auto at, std::size_t i) {
    using Steps = decltype(at);
    const Steps below = i >= width ? load<Steps>(&steps[i - width]) : static_cast<Steps>(at + no_cell);
    store(static_cast<Steps>(one_more(below) & ~occupied(at, &cells[i])), &steps[i]);
  };
  for (std::size_t first = 0; first < steps.size(); first += width) for_each_of_row(first, width, upwards);
  const auto downwards = [&](auto at, std::size_t i) {
    using Steps = decltype(at);
    const Steps own = load<Steps>(&steps[i - width]), other = one_more(load<Steps>(&steps[i]));
    store(own < other ? own : other, &steps[i - width]);
  };
  for (std::size_t end = steps.size(); end > width; end -= width) for_each_of_row(end - width, width, downwards);
}

// From steps along the columns to squared distances.
void DistanceTransform::along_row(std::span<std::uint16_t> part) {
  const auto width = static_cast<std::int32_t>(part.size());
  std::transform(part.begin(), part.end(), row_.begin(),
                 [](std::uint16_t steps) { return steps < no_cell ? square_to_edge(steps) : no_square; });
  // The envelope: site k is the lowest parabola from starts_[k], a half-cell coordinate, to the next one's start.
  std::size_t count = 0;
  const auto add_site = [&](std::int32_t site, std::int64_t height) {
    const auto height_at = [](std::int64_t x, std::int64_t site, std::int64_t height) {
      return (x - site) * (x - site) + height;
    };
    // Parabolas differ by a linear function: one that is lower at the start of an earlier site is lower from there on.
    while (count > 0 && height_at(starts_[count - 1], site, height) <
                            height_at(starts_[count - 1], sites_[count - 1], heights_[count - 1]))
      --count;
    std::int64_t start = 0;
    if (count > 0) {
      // First integer coordinate at which the new parabola is strictly lower; equal heights need no division.
      const std::int64_t other = sites_[count - 1], rise = height - heights_[count - 1];
      const std::int64_t twice_middle = site + other, twice_apart = 2 * (site - other);
      start = (rise == 0 ? twice_middle / 2 : floor_divide(rise + twice_middle * (site - other), twice_apart)) + 1;
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
