// SPDX-License-Identifier: BSD-3-Clause
#include "modules/plan/controllability.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>

#include "tests/modules/plan/random_networks.hpp"

namespace waitpoint::plan {
namespace {

Duration ticks(std::int64_t n) { return Duration::from_ns(n); }

/// The game of an executor against nature, tick by tick, solved by trying all moves of both. In each tick nature ends
/// links first; then the executor, which has seen that, executes points.
class Game {
 public:
  explicit Game(const Network& network) : network_(network), times_(network.points, ahead) { times_[origin] = 0; }
  bool executor_wins() { return wins_from(0); }

 private:
  static constexpr int ahead = -1;

  bool is_lost() const {
    for (const Edge& edge : network_.edges) {
      const int from = times_[edge.from], to = times_[edge.to];
      if (from != ahead && to != ahead && ticks(to - from) > edge.most) return true;
      if (from != ahead && to == ahead && ticks(now_ - from) > edge.most) return true;
    }
    return false;
  }
  bool is_over() const { return std::find(times_.begin(), times_.end(), ahead) == times_.end(); }

  // For all sets of links that nature may end now.
  bool wins_from(int now) {
    now_ = now;
    if (is_lost()) return false;
    if (is_over()) return true;
    std::vector<int> key = times_;
    key.push_back(now);
    const auto known = solved_.find(key);
    if (known != solved_.end()) return known->second;
    std::vector<const ContingentLink*> may_end;
    std::size_t must = 0;
    for (const ContingentLink& link : network_.links) {
      if (times_[link.start] == ahead || times_[link.end] != ahead) continue;
      const Duration since = ticks(now - times_[link.start]);
      if (since < link.least) continue;
      if (since == link.most) must |= std::size_t{1} << may_end.size();
      may_end.push_back(&link);
    }
    bool wins = true;
    for (std::size_t set = 0; set < std::size_t{1} << may_end.size() && wins; ++set) {
      if ((set & must) != must) continue;
      const std::vector<int> before = times_;
      for (std::size_t i = 0; i < may_end.size(); ++i)
        if ((set >> i & 1) != 0) times_[may_end[i]->end] = now;
      wins = moves(now);
      times_ = before;
    }
    solved_[key] = wins;
    return wins;
  }

  // For some set of points that the executor can execute now.
  bool moves(int now) {
    std::vector<PointId> open;
    for (PointId point = 0; point < network_.points; ++point)
      if (times_[point] == ahead && !network_.natural[point]) open.push_back(point);
    const std::vector<int> before = times_;
    bool wins = false;
    for (std::size_t set = 0; set < std::size_t{1} << open.size() && !wins; ++set) {
      for (std::size_t i = 0; i < open.size(); ++i)
        if ((set >> i & 1) != 0) times_[open[i]] = now;
      now_ = now;
      wins = !is_lost() && (is_over() || wins_from(now + 1));
      times_ = before;
    }
    return wins;
  }

  const Network& network_;
  std::vector<int> times_;
  int now_ = 0;
  std::map<std::vector<int>, bool> solved_;
};

/// Executes the network with the given durations of its links; true if all constraints hold.
bool executes(const Network& network, const std::vector<Duration>& durations) {
  Dispatcher dispatcher(network);
  std::vector<std::optional<Duration>> times(network.points);
  times[origin] = Duration();
  for (Duration now; now < ticks(30); now += ticks(1)) {
    for (std::size_t i = 0; i < network.links.size(); ++i) {
      const ContingentLink& link = network.links[i];
      if (!times[link.start] || times[link.end] || now - *times[link.start] != durations[i]) continue;
      if (!dispatcher.execute(link.end, now)) return false;
      times[link.end] = now;
    }
    for (PointId point = 0; point < network.points; ++point) {
      const std::optional<Duration> ready = dispatcher.ready_at(point);
      if (!ready || *ready > now) continue;
      if (!dispatcher.execute(point, now)) return false;
      times[point] = now;
      point = 0;  // others may have become ready
    }
  }
  for (const Edge& edge : network.edges)
    if (!times[edge.from] || !times[edge.to] || *times[edge.to] - *times[edge.from] > edge.most) return false;
  return dispatcher.all_executed();
}

/// For all durations that nature can choose.
bool executes_always(const Network& network) {
  std::vector<Duration> durations;
  for (const ContingentLink& link : network.links) durations.push_back(link.least);
  for (;;) {
    if (!executes(network, durations)) return false;
    std::size_t i = 0;
    for (; i < durations.size() && durations[i] == network.links[i].most; ++i) durations[i] = network.links[i].least;
    if (i == durations.size()) return true;
    durations[i] += ticks(1);
  }
}

TEST(Controllability, AgreesWithAGameSolvedByBruteForce) {
  int controllable = 0, only_consistent = 0;
  for (std::uint64_t seed = 0; seed < 2500; ++seed) {
    const Network network = test::random_network(seed);
    const Dispatcher dispatcher(network);
    const bool expected = Game(network).executor_wins();
    if (!dispatcher.consistent()) {
      ASSERT_FALSE(expected) << "seed " << seed;
      continue;
    }
    ASSERT_EQ(dispatcher.controllability().controllable, expected) << "seed " << seed;
    ++(expected ? controllable : only_consistent);
    ASSERT_EQ(dispatcher.controllability().conflict.empty(), expected) << "seed " << seed;
  }
  EXPECT_GT(controllable, 300);
  EXPECT_GT(only_consistent, 300);
}

TEST(Controllability, ExecutionKeepsAllConstraintsWhateverNatureChooses) {
  int controllable = 0;
  for (std::uint64_t seed = 10000; seed < 13000; ++seed) {
    const Network network = test::random_network(seed);
    const Dispatcher dispatcher(network);
    if (!dispatcher.consistent() || !dispatcher.controllability().controllable) continue;
    ++controllable;
    ASSERT_TRUE(executes_always(network)) << "seed " << seed;
  }
  EXPECT_GT(controllable, 300);
}

// The picture must be taken at most one tick before the end of a drive of one to three.
TEST(Controllability, ConflictHasTheConstraintsAtFault) {
  Network network;
  network.points = 4;
  network.natural = {false, false, true, false};
  network.links = {{1, 2, ticks(1), ticks(3), 7}};
  network.edges = {{1, origin, Duration(), 1}, {2, 3, -ticks(1), 8}, {3, 2, ticks(1), 9}, {3, origin, Duration(), 2}};
  const Dispatcher dispatcher(network);
  ASSERT_TRUE(dispatcher.consistent());
  EXPECT_FALSE(dispatcher.controllability().controllable);
  std::vector<std::uint32_t> labels = dispatcher.controllability().conflict;
  std::sort(labels.begin(), labels.end());
  EXPECT_EQ(labels, (std::vector<std::uint32_t>{7, 8, 9}));
}

// After the drive or two ticks, whichever is first.
TEST(Controllability, WaitEndsWithTheLinkOrTheTime) {
  Network network;
  network.points = 4;
  network.natural = {false, false, true, false};
  network.links = {{1, 2, ticks(1), ticks(5), 1}};
  network.edges = {{3, 2, ticks(3), 2}, {1, origin, Duration(), 3}};
  for (const std::int64_t took : {1, 2, 5}) {
    Dispatcher dispatcher(network);
    ASSERT_TRUE(dispatcher.controllability().controllable);
    ASSERT_TRUE(dispatcher.execute(1, Duration()));
    EXPECT_EQ(dispatcher.ready_at(3), ticks(2));
    if (took > 2) continue;
    ASSERT_TRUE(dispatcher.execute(2, ticks(took)));
    EXPECT_LE(dispatcher.ready_at(3), ticks(took));
  }
}

}  // namespace
}  // namespace waitpoint::plan
