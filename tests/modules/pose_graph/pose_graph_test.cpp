// SPDX-License-Identifier: BSD-3-Clause
#include "modules/pose_graph/pose_graph.hpp"

#include <gtest/gtest.h>

#include "fibers/sync/simulation.hpp"

namespace waitpoint::pose_graph {
namespace {

constexpr Matrix3 sure = {10000, 0, 0, 0, 10000, 0, 0, 0, 40000};

// Forty steps of half a metre around a square, measured with a heading that drifts; the poses are dead reckoning's.
PoseGraph drifting_round(std::vector<Pose>& truth) {
  PoseGraph graph;
  Pose at, reckoned;
  truth = {at};
  graph.add(reckoned);
  for (std::size_t i = 1; i <= 40; ++i) {
    const Pose step{0.5, 0, i % 10 == 0 ? exact::pi / 2 : 0};
    const Pose measured{0.5, 0, step.heading + 0.01};
    at = compose(at, step);
    reckoned = compose(reckoned, measured);
    truth.push_back(at);
    graph.add(reckoned);
    graph.measure({i - 1, i, measured, sure, false});
  }
  return graph;
}

double error_m(const PoseGraph& graph, const std::vector<Pose>& truth) {
  double worst = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    worst = std::max(worst, length(graph[i].position() - truth[i].position()));
  return worst;
}

TEST(PoseGraph, AClosedLoopTakesTheDriftOutOfTheWholeRound) {
  std::vector<Pose> truth;
  PoseGraph graph = drifting_round(truth);
  const double drifted = error_m(graph, truth);
  EXPECT_GT(drifted, 1.3);
  graph.measure({0, 40, between(truth[0], truth[40]), sure, false});
  graph.optimise(30);
  EXPECT_LT(error_m(graph, truth), 0.6);
  EXPECT_LT(length(graph[40].position() - truth[40].position()), 0.1);
  EXPECT_EQ(graph[0], Pose());
}

TEST(PoseGraph, AFalseClosureIsOverruledByTrueOnes) {
  std::vector<Pose> truth;
  PoseGraph graph = drifting_round(truth);
  for (const std::size_t i : {36, 38, 40}) graph.measure({0, i, between(truth[0], truth[i]), sure, true});
  graph.optimise(30);
  PoseGraph with_false = graph;
  with_false.measure({5, 25, Pose{0.2, 0.1, 1}, sure, true});
  with_false.optimise(30);
  for (std::size_t i = 0; i < truth.size(); ++i)
    EXPECT_LT(length(with_false[i].position() - graph[i].position()), 0.1) << i;
}

TEST(PoseGraph, HeadingsAreComparedRoundTheCircle) {
  PoseGraph graph;
  graph.add({0, 0, 3.1});
  graph.add({1, 0, -3.1});
  graph.measure({0, 1, between({0, 0, 3.1}, {1, 0, 3.15}), sure, false});
  graph.optimise(10);
  EXPECT_NEAR(exact::wrap_angle(graph[1].heading - 3.15), 0, 1e-6);
  EXPECT_NEAR(graph.cost(), 0, 1e-6);
}

// A long trajectory within a task, whose stack is small.
TEST(PoseGraph, AStepThatIsNoNumberIsTakenBack) {
  PoseGraph graph;
  graph.add({});
  graph.add({1, 2, 0.5});
  constexpr Matrix3 beyond = {1e200, 0, 0, 0, 1e200, 0, 0, 0, 1e200};
  graph.measure({0, 1, {1e200, 0, 0}, beyond, false});
  graph.optimise(30);
  EXPECT_EQ(graph[1], (Pose{1, 2, 0.5}));
}

TEST(PoseGraph, IsOptimisedOnTheStackOfATask) {
  PoseGraph graph;
  graph.add({});
  for (std::size_t i = 1; i < 3000; ++i) {
    graph.add({0.5 * static_cast<double>(i), 0.1, 0});
    graph.measure({i - 1, i, {0.5, 0, 0}, sure, false});
    if (i % 100 == 0) graph.measure({i - 90, i, {45, 0, 0}, sure, true});
  }
  const waitpoint::Report report = simulate([&] { graph.optimise(10); });
  EXPECT_TRUE(report.passed) << report;
  EXPECT_NEAR(graph[2999].y, 0, 1e-3);
}

}  // namespace
}  // namespace waitpoint::pose_graph
