// SPDX-License-Identifier: BSD-3-Clause
// Ways to a goal on a map: the distance to the goal from every cell in which the robot fits, by Dijkstra's algorithm,
// with a cost near walls, so that descending it keeps away from them.
#pragma once

#include <nav_msgs/OccupancyGrid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

struct Place {
  double x = 0, y = 0;
};

class Route {
 public:
  static constexpr float unreachable = std::numeric_limits<float>::infinity();

  /// A robot of this radius (m) keeps this distance from walls where there is room.
  Route(const nav_msgs::OccupancyGrid& map, double radius, double wanted) : map_(map), cost_(map.data.size(), 1) {
    const int reach = static_cast<int>(std::ceil(wanted / map.info.resolution));
    for (int y = 0; y < height(); ++y)
      for (int x = 0; x < width(); ++x)
        if (map.data[at(x, y)] != 0) close(x, y, reach, radius, wanted);
  }

  void set_goal(const Place& goal) {
    left_.assign(cost_.size(), unreachable);
    using Entry = std::tuple<float, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const auto [goal_x, goal_y] = cell(goal);
    if (!contains(goal_x, goal_y)) return;
    left_[at(goal_x, goal_y)] = 0;
    open.emplace(0.0F, at(goal_x, goal_y));
    while (!open.empty()) {
      const auto [left, here] = open.top();
      open.pop();
      if (left > left_[here]) continue;
      const int x = static_cast<int>(here) % width(), y = static_cast<int>(here) / width();
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          if (!contains(x + dx, y + dy)) continue;
          const std::size_t next = at(x + dx, y + dy);
          const float through = left + cost_[next] * std::sqrt(static_cast<float>(dx * dx + dy * dy));
          if (through >= left_[next]) continue;
          left_[next] = through;
          open.emplace(through, next);
        }
    }
  }

  /// The way from a place, up to this length (m); empty if there is none.
  std::vector<Place> from(const Place& place, double length) const {
    std::vector<Place> way;
    auto [x, y] = cell(place);
    if (left_.empty() || !contains(x, y)) return way;
    for (double gone = 0; gone < length && left_[at(x, y)] > 0;) {
      int best_x = x, best_y = y;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          if (contains(x + dx, y + dy) && left_[at(x + dx, y + dy)] < left_[at(best_x, best_y)])
            best_x = x + dx, best_y = y + dy;
      if (best_x == x && best_y == y) return way;
      gone += std::hypot(best_x - x, best_y - y) * map_.info.resolution;
      x = best_x;
      y = best_y;
      way.push_back(centre(x, y));
    }
    return way;
  }

 private:
  int width() const { return static_cast<int>(map_.info.width); }
  int height() const { return static_cast<int>(map_.info.height); }
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width() && y < height(); }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * map_.info.width + static_cast<std::size_t>(x);
  }
  // Of maps that are not turned.
  std::pair<int, int> cell(const Place& place) const {
    return {static_cast<int>(std::floor((place.x - map_.info.origin.position.x) / map_.info.resolution)),
            static_cast<int>(std::floor((place.y - map_.info.origin.position.y) / map_.info.resolution))};
  }
  Place centre(int x, int y) const {
    return {map_.info.origin.position.x + (x + 0.5) * map_.info.resolution,
            map_.info.origin.position.y + (y + 0.5) * map_.info.resolution};
  }

  // A robot that is too near already may leave, at a high price.
  void close(int wall_x, int wall_y, int reach, double radius, double wanted) {
    constexpr float too_near = 1000, near_most = 10;
    for (int y = wall_y - reach; y <= wall_y + reach; ++y)
      for (int x = wall_x - reach; x <= wall_x + reach; ++x) {
        if (!contains(x, y)) continue;
        const double away = std::hypot(x - wall_x, y - wall_y) * map_.info.resolution;
        if (away >= wanted) continue;
        const float price =
            away < radius ? too_near : 1 + near_most * static_cast<float>((wanted - away) / (wanted - radius));
        cost_[at(x, y)] = std::max(cost_[at(x, y)], price);
      }
  }

  nav_msgs::OccupancyGrid map_;
  std::vector<float> cost_, left_;
};
