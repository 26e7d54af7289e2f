// SPDX-License-Identifier: BSD-3-Clause
// Small random temporal networks, whose bounds are a few ticks.
#pragma once

#include <cstdint>
#include <vector>

#include "core/random.hpp"
#include "modules/plan/dispatcher.hpp"

namespace waitpoint::plan::test {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : stream_(seed, "plan", "test") {}
  /// Uniform, inclusive.
  std::size_t between(std::size_t low, std::size_t high) {
    return low + static_cast<std::size_t>(stream_.below(high - low + 1, draws_++));
  }
  Duration ticks(int low, int high) {
    return Duration::from_ns(low + static_cast<int>(between(0, static_cast<std::size_t>(high - low))));
  }

 private:
  RandomStream stream_;
  std::uint64_t draws_ = 0;
};

inline Edge random_edge(Draw& draw, std::size_t points, std::uint32_t label) {
  const PointId from = static_cast<PointId>(draw.between(0, points - 1));
  const PointId to = static_cast<PointId>((from + draw.between(1, points - 1)) % points);
  return {from, to, draw.ticks(-4, 8), label};
}

/// One or two contingent links among four or five points besides the origin; all points are within a few ticks of it.
inline Network random_network(std::uint64_t seed) {
  Draw draw(seed);
  Network network;
  const std::size_t links = draw.between(1, 2);
  network.points = 1 + 2 * links + draw.between(0, 2);
  network.natural.assign(network.points, false);
  std::uint32_t label = 1;
  for (PointId i = 0; i < links; ++i) {
    // The second may begin with the end of the first.
    const PointId start = i == 1 && draw.between(0, 3) == 0 ? 2 : 1 + 2 * i;
    const Duration least = draw.ticks(1, 2);
    network.links.push_back({start, 2 + 2 * i, least, least + draw.ticks(0, 3), label++});
    network.natural[2 + 2 * i] = true;
  }
  for (PointId point = 1; point < network.points; ++point) {
    network.edges.push_back({point, origin, Duration(), label++});
    network.edges.push_back({origin, point, Duration::from_ns(7), label++});
  }
  for (std::size_t i = draw.between(1, 5); i > 0; --i) {
    const PointId from = static_cast<PointId>(draw.between(1, network.points - 1));
    const PointId to =
        static_cast<PointId>(1 + (from - 1 + draw.between(1, network.points - 2)) % (network.points - 1));
    network.edges.push_back({from, to, draw.ticks(-3, 4), label++});
  }
  return network;
}

}  // namespace waitpoint::plan::test
