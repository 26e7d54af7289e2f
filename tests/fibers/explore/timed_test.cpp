// SPDX-License-Identifier: BSD-3-Clause
// Exploration within declared times: it finds exactly the failures that can happen on the robot.
#include <gtest/gtest.h>

#include "fibers/explore/campaign.hpp"
#include "fibers/explore/explore.hpp"
#include "fibers/explore/strategies/fifo.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/watch.hpp"
#include "tests/fibers/explore/feasibility.hpp"
#include "tests/fibers/explore/timed_programs.hpp"

namespace waitpoint::timed {
namespace {

using Mode = Times::Mode;

ExploreReport search(const Program& program, Mode mode, std::uint64_t iterations) {
  Times times(mode);
  return explore([&] { program.body(times); }, {.iterations = iterations, .minimize = false});
}

TracedEvent traced(const kernel::Task& task, std::uint64_t sequence) {
  return {task.id, task.maker, sequence, 0, false};
}

struct Tracing : kernel::Watch {
  Tracing() : Watch{&Tracing::see} {}
  static void see(kernel::Watch& self, const kernel::EventRecord& record) {
    Trace& trace = static_cast<Tracing&>(self).trace;
    TracedEvent event = traced(*record.task, record.task->sequence - 1);
    event.object = record.object != nullptr ? record.object->identity : 0;
    event.was_woken = record.operation == kernel::Operation::resume;
    trace.events.push_back(event);
    trace.pending.clear();
    for (const kernel::Task* task = kernel::first_task(*record.task->scheduler); task != nullptr; task = task->next)
      // A task woken from a join continues at its wake-up: it computes nothing.
      if (task->state == kernel::TaskState::ready && task->operation != kernel::Operation::join)
        trace.pending.push_back(traced(*task, task->sequence));
  }
  Trace trace;
};

// Runs that schedule; true if its events are feasible.
bool can_happen(const Program& program, Mode mode, const exploration::Schedule& schedule) {
  Times times(mode);
  exploration::Body body(
      [&] {
        times.begin();
        program.body(times);
      },
      nullptr, Time::max(), 100'000);
  Tracing tracing;
  kernel::set_watch(body.simulation().scheduler(), &tracing);
  exploration::Fifo rest;
  EXPECT_FALSE(body.run(rest, {.prefix = schedule.decisions}).passed()) << program.name;
  kernel::set_watch(body.simulation().scheduler(), nullptr);
  tracing.trace.spent = times.spent();
  return is_feasible(tracing.trace);
}

TEST(Timed, UntimedSearchFlagsProgramsThatAreRight) {
  int flagged = 0;
  for (const Program& program : programs()) {
    const ExploreReport report = search(program, Mode::untimed, 2000);
    flagged += !report.passed;
    // The solver reports the failure as infeasible.
    if (!report.passed) {
      EXPECT_FALSE(can_happen(program, Mode::untimed, report.schedule)) << program.name;
    }
  }
  EXPECT_GE(flagged, 15);
}

TEST(Timed, TimedSearchFlagsNone) {
  for (const Program& program : programs()) {
    const ExploreReport report = search(program, Mode::as_declared, 1000);
    EXPECT_TRUE(report.passed) << program.name << ": " << report;
  }
}

TEST(Timed, WithOneIntervalWidenedItFindsThemAllAndTheSolverAgrees) {
  for (const Program& program : programs()) {
    const ExploreReport report = search(program, Mode::widened, 1000);
    ASSERT_FALSE(report.passed) << program.name;
    EXPECT_TRUE(can_happen(program, Mode::widened, report.schedule)) << program.name << ": " << report;
  }
}

}  // namespace
}  // namespace waitpoint::timed
