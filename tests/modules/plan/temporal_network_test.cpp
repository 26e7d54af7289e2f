// SPDX-License-Identifier: BSD-3-Clause
#include "modules/plan/temporal_network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "tests/modules/plan/random_networks.hpp"

namespace waitpoint::plan {
namespace {

using namespace std::chrono_literals;

// Floyd and Warshall's closure; nothing if a cycle is negative.
std::optional<std::vector<Duration>> closure(std::size_t points, const std::vector<Edge>& edges) {
  std::vector<Duration> d(points * points, Duration::max());
  for (std::size_t i = 0; i < points; ++i) d[i * points + i] = Duration();
  for (const Edge& edge : edges) d[edge.from * points + edge.to] = std::min(d[edge.from * points + edge.to], edge.most);
  for (std::size_t k = 0; k < points; ++k)
    for (std::size_t i = 0; i < points; ++i)
      for (std::size_t j = 0; j < points; ++j)
        if (d[i * points + k] != Duration::max() && d[k * points + j] != Duration::max())
          d[i * points + j] = std::min(d[i * points + j], d[i * points + k] + d[k * points + j]);
  for (std::size_t i = 0; i < points; ++i)
    if (d[i * points + i] < Duration()) return std::nullopt;
  return d;
}

std::vector<Duration> distances(const TemporalNetwork& network) {
  std::vector<Duration> d;
  for (PointId i = 0; i < network.points(); ++i)
    for (PointId j = 0; j < network.points(); ++j) d.push_back(network.distance(i, j));
  return d;
}

TEST(TemporalNetwork, BoundsAreMinimalAfterEachConstraint) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    test::Draw draw(seed);
    const std::size_t points = draw.between(2, 9);
    TemporalNetwork network(points);
    std::vector<Edge> edges;
    for (int i = 0; i < 30; ++i) {
      edges.push_back(test::random_edge(draw, points, static_cast<std::uint32_t>(i)));
      const auto expected = closure(points, edges);
      ASSERT_EQ(network.add(edges.back()), expected.has_value()) << "seed " << seed;
      if (expected) {
        ASSERT_EQ(distances(network), *expected) << "seed " << seed;
      } else {
        edges.pop_back();
      }
    }
  }
}

TEST(TemporalNetwork, RollsBackExactly) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    test::Draw draw(seed);
    TemporalNetwork network(6);
    std::vector<std::pair<std::size_t, std::vector<Duration>>> past;
    for (int i = 0; i < 60; ++i) {
      if (!past.empty() && draw.between(0, 3) == 0) {
        const std::size_t to = draw.between(0, past.size() - 1);
        network.roll_back(past[to].first);
        ASSERT_EQ(distances(network), past[to].second);
        past.resize(to);
      }
      past.emplace_back(network.mark(), distances(network));
      network.add(test::random_edge(draw, 6, static_cast<std::uint32_t>(i)));
    }
  }
}

TEST(TemporalNetwork, ConflictIsANegativeCycle) {
  int conflicts = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    test::Draw draw(seed);
    TemporalNetwork network(6);
    std::vector<Edge> edges;
    for (std::uint32_t i = 0; i < 40; ++i) {
      edges.push_back(test::random_edge(draw, 6, i));
      if (network.add(edges.back())) continue;
      ++conflicts;
      Duration sum;
      const std::vector<std::uint32_t>& cycle = network.conflict();
      ASSERT_EQ(cycle.front(), i);
      for (std::size_t k = 0; k < cycle.size(); ++k) {
        sum += edges[cycle[k]].most;
        ASSERT_EQ(edges[cycle[k]].to, edges[cycle[(k + 1) % cycle.size()]].from);
      }
      ASSERT_LT(sum, Duration());
    }
  }
  EXPECT_GT(conflicts, 100);
}

TEST(TemporalNetwork, ATickDecides) {
  TemporalNetwork network(2);
  EXPECT_TRUE(network.add({1, origin, -Duration(5s), 0}));
  EXPECT_FALSE(network.add({origin, 1, Duration(5s) - Duration(1ns), 1}));
  EXPECT_TRUE(network.add({origin, 1, 5s, 2}));
  EXPECT_EQ(network.earliest(1), network.latest(1));
}

}  // namespace
}  // namespace waitpoint::plan
