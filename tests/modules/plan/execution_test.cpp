// SPDX-License-Identifier: BSD-3-Clause
#include "modules/plan/execution.hpp"

#include <gtest/gtest.h>

#include "tests/modules/plan/plan_text.hpp"

namespace waitpoint::plan {
namespace {

using namespace std::chrono_literals;
using Kind = PlanOrder::Kind;

std::vector<EventKind> kinds(const Execution& execution) {
  std::vector<EventKind> kinds;
  for (const Event& event : execution.log()) kinds.push_back(event.kind);
  return kinds;
}

/// The next order is of this kind, for this action.
void expect_order(Execution& execution, Duration now, Kind kind, std::size_t action) {
  const PlanOrder order = execution.next(now);
  EXPECT_EQ(order.kind, kind);
  EXPECT_EQ(order.action, action);
  if (kind == Kind::start) execution.started(action, now);
}

Duration waits(Execution& execution, Duration now) {
  const PlanOrder order = execution.next(now);
  EXPECT_EQ(order.kind, Kind::wait);
  return order.until;
}

const char* const drive_and_look = R"(
actions:
  - {name: drive, kind: contingent, duration_s: [2, 4], request: ndd.GoTo}
  - {name: look, duration_s: [1, 2], request: sick.SegmentsOn, after: drive}
constraints: [{from: start, to: look.end, most_s: 10}]
)";

TEST(Execution, DispatchesInItsWindows) {
  const TemporalPlan plan = test::plan_of(drive_and_look);
  Execution execution(plan);
  expect_order(execution, 0s, Kind::start, 0);
  EXPECT_EQ(waits(execution, 0s), Duration(4s) + Duration(1ns));
  execution.ended(0, 3s, true, "");
  expect_order(execution, 3s, Kind::start, 1);
  EXPECT_EQ(waits(execution, 3s), Duration(4s));
  expect_order(execution, 4s, Kind::stop, 1);
  expect_order(execution, 4s, Kind::finish, 0);
  EXPECT_TRUE(execution.completed());
}

TEST(Execution, EarlyAndLateEndsAreRepaired) {
  const TemporalPlan plan = test::plan_of(drive_and_look);
  Execution early(plan);
  expect_order(early, 0s, Kind::start, 0);
  early.ended(0, 1s, true, "");
  expect_order(early, 1s, Kind::start, 1);
  EXPECT_EQ(kinds(early),
            (std::vector{EventKind::start, EventKind::end, EventKind::early, EventKind::repaired, EventKind::start}));
  Execution late(plan);
  expect_order(late, 0s, Kind::start, 0);
  // A tick after the bound; then up to the latest time from which the rest is possible, and not a tick more.
  EXPECT_EQ(waits(late, Duration(4s) + Duration(1ns)), Duration(9s) + Duration(1ns));
  late.ended(0, 9s, true, "");
  expect_order(late, 9s, Kind::start, 1);
  EXPECT_TRUE(late.failure().empty());
}

TEST(Execution, LateActionThatCannotBeRepairedIsStoppedAndThePlanAborted) {
  const TemporalPlan plan = test::plan_of(drive_and_look);
  Execution execution(plan);
  expect_order(execution, 0s, Kind::start, 0);
  waits(execution, 5s);
  expect_order(execution, Duration(9s) + Duration(1ns), Kind::stop, 0);
  expect_order(execution, Duration(9s) + Duration(1ns), Kind::finish, 0);
  EXPECT_EQ(execution.failure(), "action 'drive' failed: it did not end in time");
}

TEST(Execution, FailedActionIsReplacedByTheNextBranchThatIsStillPossible) {
  const TemporalPlan plan = test::plan_of(R"(
actions:
  - {name: by lift, kind: contingent, duration_s: [1, 5], request: ndd.GoTo}
  - {name: by stairs, kind: contingent, duration_s: [8, 9], request: ndd.GoTo}
  - {name: by ramp, kind: contingent, duration_s: [4, 6], request: ndd.GoTo}
  - {name: look, after: [by lift, by stairs, by ramp], duration_s: 1}
constraints: [{from: start, to: look.end, most_s: 12}]
alternatives: [{name: the way, branches: [[by lift], [by stairs], [by ramp]]}]
)");
  Execution execution(plan);
  expect_order(execution, 0s, Kind::start, 0);
  execution.ended(0, 4s, false, "blocked");
  expect_order(execution, 4s, Kind::start, 2);  // the stairs would take too long
  execution.ended(2, 9s, true, "");
  expect_order(execution, 9s, Kind::start, 3);
  expect_order(execution, 10s, Kind::finish, 0);
  EXPECT_TRUE(execution.completed());
}

TEST(Execution, StartThatTookTooLongIsStopped) {
  const TemporalPlan plan = test::plan_of(
      "actions: [{name: look, duration_s: 1, request: sick.SegmentsOn}]\n"
      "constraints: [{from: start, to: look.start, most_s: 0.3}]");
  Execution execution(plan);
  EXPECT_EQ(execution.next(300ms).kind, Kind::start);
  execution.started(0, Duration(300ms) + Duration(1ns));
  expect_order(execution, Duration(300ms) + Duration(1ns), Kind::stop, 0);
  EXPECT_EQ(execution.failure(), "action 'look' failed: it could not start in time");
}

TEST(Execution, ViolatedConditionWithoutABranchAborts) {
  const TemporalPlan plan = test::plan_of(drive_and_look);
  Execution execution(plan);
  expect_order(execution, 0s, Kind::start, 0);
  execution.violated(0, 1s, "the battery is low");
  expect_order(execution, 1s, Kind::stop, 0);
  expect_order(execution, 1s, Kind::finish, 0);
  EXPECT_EQ(execution.failure(), "action 'drive' failed: the battery is low");
}

TEST(Execution, StartThatIsPostponedBeyondItsWindowFails) {
  const TemporalPlan plan = test::plan_of(
      "actions: [{name: look, duration_s: 1}]\n"
      "constraints: [{from: start, to: look.start, most_s: 0.3}]");
  Execution execution(plan);
  EXPECT_EQ(execution.next(0s).kind, Kind::start);
  execution.postponed(0, 200ms);
  EXPECT_EQ(waits(execution, 0s), Duration(200ms));
  EXPECT_EQ(execution.next(200ms).kind, Kind::start);
  execution.postponed(0, 400ms);
  EXPECT_EQ(waits(execution, 200ms), Duration(300ms) + Duration(1ns));
  EXPECT_EQ(execution.next(Duration(300ms) + Duration(1ns)).kind, Kind::finish);
  EXPECT_EQ(execution.failure(), "action 'look' failed: it could not start in time");
}

}  // namespace
}  // namespace waitpoint::plan
