// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/sync/reference_model.hpp"

#include <gtest/gtest.h>

#include <ostream>

#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint::reference {

void PrintTo(const Done& done, std::ostream* out) {
  *out << "task " << done.task << " step " << done.step << " at " << done.time_ns << (done.in_time ? "" : " too late");
}

namespace {

using std::chrono::nanoseconds;

struct Objects {
  timed_mutex timed[objects_of_a_kind];
  counting_semaphore<> semaphores[objects_of_a_kind] = {counting_semaphore<>(1), counting_semaphore<>(1),
                                                        counting_semaphore<>(1)};
  condition_variable conditions[objects_of_a_kind];
};

bool do_step(const Step& step, Objects& o) {
  const nanoseconds span(step.span_ns);
  switch (step.kind) {
    case Kind::compute: compute(span); break;
    case Kind::sleep: this_thread::sleep_for(span); break;
    case Kind::yield: this_thread::yield(); break;
    case Kind::lock: o.timed[step.object].lock(); break;
    case Kind::lock_for: return o.timed[step.object].try_lock_for(span);
    case Kind::unlock: o.timed[step.object].unlock(); break;
    case Kind::acquire: o.semaphores[step.object].acquire(); break;
    case Kind::acquire_for: return o.semaphores[step.object].try_acquire_for(span);
    case Kind::release: o.semaphores[step.object].release(); break;
    case Kind::wait_for: {
      std::unique_lock<mutex> lock(o.timed[step.mutex], std::adopt_lock);
      const bool in_time = o.conditions[step.object].wait_for(lock, span) == cv_status::no_timeout;
      lock.release();
      return in_time;
    }
    case Kind::notify_one: o.conditions[step.object].notify_one(); break;
    case Kind::notify_all: o.conditions[step.object].notify_all(); break;
  }
  return true;
}

Outcome run_on_the_scheduler(const Program& program, const SimulationOptions& options = {}) {
  Objects objects;
  Outcome outcome;
  Simulation simulation(options);
  for (std::size_t i = 0; i < program.size(); ++i)
    simulation.spawn(simulation.environment(), {.stack = kernel::StackSize::small}, [&, i] {
      for (std::size_t step = 0; step < program[i].size();) {
        const bool in_time = do_step(program[i][step], objects);
        outcome.done.push_back({i, step, now().ns(), in_time});
        step = program[i][step].kind == Kind::lock_for && !in_time ? program[i][step].otherwise : step + 1;
      }
    });
  // The last task to be blocked may leave the time behind its last event: the end is where the run stopped.
  kernel::RunState state = simulation.scheduler().run_before(Time::max());
  outcome.ended = state == kernel::RunState::stopped;
  outcome.end_ns = simulation.global_time().ns();
  simulation.unwind();
  return outcome;
}

TEST(ReferenceModel, TheSchedulerDoesRandomProgramsAsTheAlgorithmsSay) {
  int ended = 0;
  std::size_t steps = 0;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    const Program program = random_program(seed, 2 + seed % 7, 10 + seed % 31);
    const Outcome expected = run_by_the_book(program), found = run_on_the_scheduler(program);
    ASSERT_EQ(found.done, expected.done) << "program " << seed;
    ASSERT_EQ(found.ended, expected.ended) << "program " << seed;
    ASSERT_EQ(found.end_ns, expected.end_ns) << "program " << seed;
    ended += found.ended;
    steps += found.done.size();
  }
  // Programs that end and programs that hang were both among them, and most had something to do.
  EXPECT_GT(ended, 60);
  EXPECT_LT(ended, 540);
  EXPECT_GT(steps, 40'000u);
}

// In the other orders nothing is foretold, but each step is done in time order, and no mutex is held by two.
TEST(ReferenceModel, SeededOrdersKeepTimeAndMutualExclusion) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Program program = random_program(seed, 6, 30);
    const Outcome outcome = run_on_the_scheduler(program, order_number(seed));
    const std::size_t nobody = program.size();
    std::vector<std::size_t> owner(objects_of_a_kind, nobody), next_step(program.size(), 0);
    // A task that is in a wait does not hold the mutex.
    const auto is_free = [&](std::size_t mutex) {
      const std::size_t task = owner[mutex];
      return task == nobody || program[task][next_step[task]].kind == Kind::wait_for;
    };
    std::int64_t time = 0;
    for (const Done& done : outcome.done) {
      const Step& step = program[done.task][done.step];
      if (step.kind == Kind::lock || (step.kind == Kind::lock_for && done.in_time)) {
        ASSERT_TRUE(is_free(step.object));
        owner[step.object] = done.task;
      } else if (step.kind == Kind::unlock) {
        ASSERT_EQ(owner[step.object], done.task);
        owner[step.object] = nobody;
      } else if (step.kind == Kind::wait_for) {
        ASSERT_TRUE(owner[step.mutex] == done.task || is_free(step.mutex));
        owner[step.mutex] = done.task;
      }
      next_step[done.task] = done.step + 1;
      if (step.kind == Kind::compute) continue;  // ahead of the others
      ASSERT_GE(done.time_ns, time);
      time = done.time_ns;
    }
  }
}

}  // namespace
}  // namespace waitpoint::reference
