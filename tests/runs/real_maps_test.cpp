// SPDX-License-Identifier: BSD-3-Clause
// Maps from outside the project: a robot reaches every free cell that is connected to its start.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <queue>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "modules/run/experiment.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tests/project.hpp"
#include "tools/papers_modules.hpp"
#include "world/formats/map_server.hpp"

namespace waitpoint {
namespace {

constexpr double radius_m = 0.26;
constexpr double clearance_m = 0.05;
constexpr int goal_count = 6;

// Cells whose centres are free and farther than radius + clearance from every occupied square.
std::vector<bool> open_cells(const OccupancyGrid& grid) {
  const double reach = (radius_m + clearance_m) / grid.resolution_m();
  const int window = static_cast<int>(std::ceil(reach)) + 1;
  std::vector<bool> open(static_cast<std::size_t>(grid.width()) * static_cast<std::size_t>(grid.height()));
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width()) + static_cast<std::size_t>(x);
  };
  for (int y = 0; y < grid.height(); ++y)
    for (int x = 0; x < grid.width(); ++x) open[at(x, y)] = grid[{x, y}] == Cell::free;
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) {
      if (grid[{x, y}] != Cell::occupied) continue;
      for (int v = std::max(0, y - window); v <= std::min(grid.height() - 1, y + window); ++v) {
        for (int u = std::max(0, x - window); u <= std::min(grid.width() - 1, x + window); ++u) {
          const double dx = std::max(0.0, std::abs(u - x) - 0.5), dy = std::max(0.0, std::abs(v - y) - 0.5);
          if (dx * dx + dy * dy < reach * reach) open[at(u, v)] = false;
        }
      }
    }
  }
  return open;
}

// The open cells connected to `from` by edges.
std::vector<CellIndex> connected(const OccupancyGrid& grid, std::vector<bool>& open, CellIndex from) {
  const auto at = [&](CellIndex c) {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(grid.width()) + static_cast<std::size_t>(c.x);
  };
  std::vector<CellIndex> reached;
  std::queue<CellIndex> next;
  open[at(from)] = false;
  for (next.push(from); !next.empty(); next.pop()) {
    const CellIndex c = next.front();
    reached.push_back(c);
    for (const CellIndex n : {CellIndex{c.x + 1, c.y}, {c.x - 1, c.y}, {c.x, c.y + 1}, {c.x, c.y - 1}}) {
      if (!grid.contains(n) || !open[at(n)]) continue;
      open[at(n)] = false;
      next.push(n);
    }
  }
  return reached;
}

std::vector<CellIndex> largest_open_region(const OccupancyGrid& grid) {
  std::vector<bool> open = open_cells(grid);
  std::vector<CellIndex> largest;
  for (int y = 0; y < grid.height(); ++y)
    for (int x = 0; x < grid.width(); ++x)
      if (open[static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width()) + static_cast<std::size_t>(x)]) {
        std::vector<CellIndex> region = connected(grid, open, {x, y});
        if (region.size() > largest.size()) largest = std::move(region);
      }
  return largest;
}

std::string number(double value) { return std::to_string(value); }

struct Round {
  std::filesystem::path map;
  Pose start;
  std::vector<Point> goals;

  scenario::Scenario scenario() const {
    std::string list;
    for (const Point goal : goals) list += (list.empty() ? "[" : ", [") + number(goal.x) + ", " + number(goal.y) + "]";
    return scenario::read_scenario(
        test::project_root() / "scenarios" / "office.yaml",
        {"world.shapes=[]", "world.map.file=" + map.string(), "until_s=4000",
         "robot_types.rackham.modules.segloc.enabled=false", "robot_types.rackham.modules.locate.enabled=true",
         "robots.0.start=[" + number(start.x) + ", " + number(start.y) + ", " +
             number(start.heading * 180 / exact::pi) + "]",
         "robots.0.goals=[" + list + "]"});
  }
};

Round draw_round(const std::filesystem::path& map, std::uint64_t seed) {
  const OccupancyGrid grid = world::read_map_server_map(map.string());
  const std::vector<CellIndex> region = largest_open_region(grid);
  const RandomStream stream(seed, "", "round");
  Round round{map, {}, {}};
  const Point start = grid.centre(region[stream.below(region.size(), 0)]);
  round.start = {start.x, start.y, exact::wrap_angle(6.28 * stream.uniform(1))};
  for (std::uint64_t i = 0; i < goal_count; ++i)
    round.goals.push_back(grid.centre(region[stream.below(region.size(), 2 + i)]));
  return round;
}

/// All samples of the true path.
struct TruePath final : bridge::PathSink {
  void add(bridge::PathKind kind, const bridge::DatedPose& sample) override {
    if (kind == bridge::PathKind::truth) samples.push_back(sample);
  }
  Point position_at(Time date) const {
    Point position;
    for (const bridge::DatedPose& sample : samples)
      if (sample.date <= date) position = sample.pose.position();
    return position;
  }

  std::vector<bridge::DatedPose> samples;
};

class RealMap : public testing::TestWithParam<const char*> {};

TEST_P(RealMap, EveryGoalThatIsFreeAndConnectedIsReached) {
  const std::optional<std::string> data = test::data_folder();
  if (!data) GTEST_SKIP() << "no data folder: set WAITPOINT_DATA";
  const std::filesystem::path map = std::filesystem::path(*data) / "maps" / GetParam();
  const std::uint64_t rounds =
      std::getenv("WAITPOINT_ROUNDS") ? std::strtoull(std::getenv("WAITPOINT_ROUNDS"), nullptr, 10) : 10;
  for (std::uint64_t seed = 1; seed <= rounds; ++seed) {
    const Round round = draw_round(map, seed);
    const scenario::Scenario scenario = round.scenario();
    run::Experiment experiment(scenario, tools::shipped_modules(),
                               {.seed = seed, .order = kernel::Order::fifo, .replay = ""});
    TruePath path;
    experiment.robots().at(0)->add_path_sink(path);
    EXPECT_EQ(experiment.run_before(Time() + scenario.until), RunEnd::ended) << "seed " << seed;
    const bridge::RunResult result = experiment.result();
    const bridge::RobotResult& robot = result.robots[0];
    EXPECT_EQ(robot.collisions, 0u) << "seed " << seed;
    EXPECT_LT(robot.position_error_max_m, 0.1) << "seed " << seed;
    for (const bridge::GoalResult& goal : robot.goals) {
      EXPECT_TRUE(goal.reached()) << "seed " << seed << ", goal (" << goal.position.x << ", " << goal.position.y
                                  << "): " << goal.report;
      if (!goal.reached()) continue;
      EXPECT_LT(length(path.position_at(goal.date) - goal.position), 0.3)
          << "seed " << seed << ", goal (" << goal.position.x << ", " << goal.position.y << ")";
    }
    RecordProperty("position_error_max_m_" + std::to_string(seed), std::to_string(robot.position_error_max_m));
    if (std::getenv("WAITPOINT_ROUNDS") != nullptr)
      std::printf("%s seed %llu: %zu/%zu, %.0f m, %.0f s, error %.3f, odometry %.2f, collisions %llu\n", GetParam(),
                  static_cast<unsigned long long>(seed), robot.goals_reached(), robot.goals.size(), robot.distance_m,
                  experiment.simulation().global_time().seconds(), robot.position_error_max_m,
                  robot.odometry_error_max_m, static_cast<unsigned long long>(robot.collisions));
  }
}

INSTANTIATE_TEST_SUITE_P(Maps, RealMap, testing::Values("depot.yaml", "tb3_sandbox.yaml", "warehouse.yaml"),
                         [](const auto& map) {
                           return std::string(map.param).substr(0, std::string(map.param).find('.'));
                         });

}  // namespace
}  // namespace waitpoint
