// SPDX-License-Identifier: BSD-3-Clause
//
//   30 +-----+-----+-----+-----+-----+-----+     rooms 1..6     y 21.5 .. 30
//      |  1  |  2  |  3  |  4  |  5  |  6  |
//   21 +-- --+-- --+-- --+-- --+-- --+-- --+
//      |             corridor              |     y 19.5 .. 21.5
//   19 +  +-- --+-- ---+-- ----+-- --+--+  +
//      |  |  7  |   8   |   9   |  10 |  |  |     y 10.5 .. 19.5, corridors x 0 .. 2 and 38 .. 40 beside
//   10 +  +-- --+-- ---+-- ----+-- --+--+  +
//      |             corridor              |     y 8.5 .. 10.5
//    8 +-- --+-- --+-- --+-- --+-- --+-- --+
//      | 11  | 12  | 13  | 14  | 15  | 16  |     y 0 .. 8.5
//    0 +-----+-----+-----+-----+-----+-----+
#include <array>

#include "tests/modules/segloc/tour.hpp"

namespace waitpoint::synthetic {
namespace {

constexpr double thickness_m = 0.12, door_m = 1.0;

void upright_wall(Room& room, double x, double y0, double y1) {
  room.add_box({x, 0.5 * (y0 + y1), 0}, thickness_m, y1 - y0);
}

// A wall from x0 to x1 with a door about each of the places.
void wall_with_doors(Room& room, double y, double x0, double x1, std::span<const double> doors) {
  double from = x0;
  for (const double door : doors) {
    room.add_box({0.5 * (from + door - 0.5 * door_m), y, 0}, door - 0.5 * door_m - from, thickness_m);
    from = door + 0.5 * door_m;
  }
  room.add_box({0.5 * (from + x1), y, 0}, x1 - from, thickness_m);
}

void furnish(Room& room, double x, double y, double turned, int kind) {
  switch (kind % 4) {
    case 0:  // a desk along the wall and a cupboard
      room.add_box({x + 1.4, y + 1.2, turned}, 1.6, 0.8);
      room.add_box({x - 1.9, y - 1.4, 0}, 0.45, 1.2);
      break;
    case 1:  // two desks back to back, a waste bin
      room.add_box({x - 1.2, y + 0.9, 0.1 + turned}, 1.6, 1.6);
      room.add_disc({{x + 1.7, y - 1.2}, 0.15});
      break;
    case 2:  // a round table and a shelf
      room.add_disc({{x + 1.4, y + 0.7}, 0.6});
      room.add_box({x - 1.6, y + 1.6, 0}, 1.8, 0.35);
      break;
    default:  // chairs: four legs each
      for (int i = 0; i < 3; ++i) {
        const double cx = x + 1.5 - 0.2 * i, cy = y - 1.4 + 1.1 * i;
        for (int leg = 0; leg < 4; ++leg) {
          room.add_disc({{cx + (leg & 1 ? 0.2 : -0.2), cy + (leg & 2 ? 0.2 : -0.2)}, 0.02});
        }
      }
      room.add_box({x - 1.8, y + 0.5, -0.2 + turned}, 0.8, 1.4);
  }
}

}  // namespace

Room office() {
  Room room;
  const std::array<Point, 4> corner{{{0, 0}, {40, 0}, {40, 30}, {0, 30}}};
  for (std::size_t i = 0; i < 4; ++i) room.add_wall(corner[i], corner[(i + 1) % 4]);
  const std::array<double, 6> upper{3.0, 10.0, 17.5, 23.0, 29.5, 37.0}, lower{4.0, 9.0, 16.5, 24.0, 31.0, 36.0};
  const std::array<double, 4> inner_upper{5.0, 14.0, 24.5, 34.0}, inner_lower{6.5, 15.0, 22.5, 33.0};
  wall_with_doors(room, 21.5, 0, 40, upper);
  wall_with_doors(room, 8.5, 0, 40, lower);
  wall_with_doors(room, 19.5, 2, 38, inner_upper);
  wall_with_doors(room, 10.5, 2, 38, inner_lower);
  upright_wall(room, 2, 10.5, 19.5);
  upright_wall(room, 38, 10.5, 19.5);
  for (const double x : {6.5, 13.5, 20.0, 26.5, 33.0}) {
    upright_wall(room, x, 21.5, 30);
    upright_wall(room, x, 0, 8.5);
  }
  for (const double x : {10.0, 19.0, 29.0}) upright_wall(room, x, 10.5, 19.5);
  const std::array<double, 6> column{3.2, 10, 16.7, 23.2, 29.7, 36.5};
  for (int i = 0; i < 6; ++i) {
    furnish(room, column[static_cast<std::size_t>(i)], 26.5, 0.05 * i, i);
    furnish(room, column[static_cast<std::size_t>(i)], 3.5, -0.07 * i, i + 1);
  }
  const std::array<double, 4> inner{6.0, 14.5, 24.0, 33.5};
  for (int i = 0; i < 4; ++i) furnish(room, inner[static_cast<std::size_t>(i)], 15, 0.2 * i, i + 2);
  room.add_box({12, 8.75, 0}, 1.2, 0.4);  // obstacles in the corridors
  room.add_box({27, 21.2, 0}, 0.9, 0.5);
  room.add_disc({{39.6, 14}, 0.2});
  return room;
}

std::vector<Point> office_way() {
  return {{1, 9.5},     {4, 9.5},    {4, 6},       {3.4, 5},     {4, 6.5},     {4, 9.5},     {9, 9.5},     {9, 5.5},
          {9, 9.5},     {16.5, 9.5}, {16.5, 5},    {16.5, 9.5},  {22.5, 9.5},  {22.5, 13.5}, {24, 12.6},   {22.5, 12},
          {22.5, 9.5},  {31, 9.5},   {31, 5.5},    {31, 9.5},    {39, 9.5},    {39, 20.5},   {37, 20.5},   {37, 24},
          {35.6, 25.6}, {37, 23.5},  {37, 20.5},   {29.5, 20.4}, {29.5, 24},   {29.5, 20.4}, {26, 20.2},   {24.5, 20.4},
          {24.5, 17.6}, {22, 17.2},  {24.5, 17.8}, {24.5, 20.4}, {17.5, 20.5}, {17.5, 25},   {17.5, 20.5}, {10, 20.5},
          {10, 24.5},   {10, 20.5},  {5, 20.5},    {5, 17},      {5, 20.5},    {1, 20.5},    {1, 9.5},     {15, 9.6},
          {15, 12.5},   {15, 9.6},   {36, 9.5},    {36, 6.5},    {36, 9.5},    {39, 9.5},    {39, 20.5},   {1, 20.4},
          {1, 9.5}};
}

std::vector<Walker> office_walkers() {
  return {{{2, 9.1}, {38, 9.1}, 0.25, 0.45},
          {{38, 20.9}, {2, 20.9}, 0.25, 0.35},
          {{1.4, 11}, {1.4, 19}, 0.3, 0.3},
          {{14, 26}, {18, 28}, 0.2, 0.3}};
}

}  // namespace waitpoint::synthetic
