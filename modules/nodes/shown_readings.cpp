// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/shown_readings.hpp"

#include <algorithm>
#include <cmath>

namespace waitpoint::nodes {
namespace {

std::optional<OccupancyGrid> grid_of(const GridValues& values) {
  const auto cells = static_cast<std::int64_t>(values.width) * values.height;
  if (values.width < 1 || values.height < 1 || cells > OccupancyGrid::cells_max || !(values.resolution > 0) ||
      cells != static_cast<std::int64_t>(values.cells.size()))
    return std::nullopt;
  const Pose origin{values.origin.x, values.origin.y, values.origin.heading};
  constexpr int occupied = 65, free = 25;  // per cent, as map_server has them
  OccupancyGrid grid(values.width, values.height, values.resolution, origin);
  for (int y = 0; y < values.height; ++y)
    for (int x = 0; x < values.width; ++x) {
      const int value = values.cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(values.width) +
                                     static_cast<std::size_t>(x)];
      grid[{x, y}] = value < 0           ? Cell::unknown
                     : value >= occupied ? Cell::occupied
                     : value <= free     ? Cell::free
                                         : Cell::unknown;
    }
  return grid;
}

}  // namespace

ShownMessage message_of(const ShownReading& reading) {
  ShownMessage message{.topic = reading.topic,
                       .kind = static_cast<ShownMessage::Kind>(reading.kind),
                       .date = Time::from_ns(std::max<std::int64_t>(reading.date_ns, 0)),
                       .frame = reading.frame,
                       .poses = {},
                       .grid = {}};
  message.poses.reserve(reading.places.size());
  for (const Place& place : reading.places)
    if (std::isfinite(place.x) && std::isfinite(place.y) && std::isfinite(place.heading))
      message.poses.push_back({place.x, place.y, place.heading});
  if (message.kind == ShownMessage::Kind::grid) message.grid = grid_of(reading.grid);
  return message;
}

}  // namespace waitpoint::nodes
