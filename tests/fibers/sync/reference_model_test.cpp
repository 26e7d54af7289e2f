// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/sync/reference_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <ostream>

#include "fibers/kernel/run.hpp"
#include "fibers/kernel/run_window.hpp"
#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/periodic_timer.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint::reference {

void PrintTo(const Done& done, std::ostream* out) {
  *out << "task " << done.task << " step " << done.step << " at " << done.time_ns << ": " << done.result;
}

namespace {

using std::chrono::nanoseconds;

// The objects that the tasks of a program share, and those of each task.
struct World {
  explicit World(const Program& of) : program(of), ids(of.tasks.size()), threads(of.tasks.size()) {
    for (std::size_t i = 0; i < program.objects; ++i) {
      mutexes.emplace_back();
      semaphores.emplace_back(1);
      conditions.emplace_back();
    }
    for (const std::int64_t period_ns : program.periods_ns) timers.emplace_back(Period::every(nanoseconds(period_ns)));
  }

  std::int64_t do_step(std::size_t task, const Step& step);
  void do_task(std::size_t task);

  const Program& program;
  Outcome outcome;
  std::vector<std::uint64_t> ids;
  std::deque<timed_mutex> mutexes;
  std::deque<counting_semaphore<>> semaphores;
  std::deque<condition_variable> conditions;
  std::deque<periodic_timer> timers;
  std::vector<thread> threads;
};

constexpr thread_attributes small_stack{.name = "task", .stack = kernel::StackSize::small};

std::int64_t World::do_step(std::size_t task, const Step& step) {
  const nanoseconds span(step.span_ns);
  switch (step.kind) {
    case Kind::compute: compute(span); break;
    case Kind::sleep: this_thread::sleep_for(span); break;
    case Kind::yield: this_thread::yield(); break;
    case Kind::lock: mutexes[step.object].lock(); break;
    case Kind::lock_for: return mutexes[step.object].try_lock_for(span);
    case Kind::unlock: mutexes[step.object].unlock(); break;
    case Kind::acquire: semaphores[step.object].acquire(); break;
    case Kind::acquire_for: return semaphores[step.object].try_acquire_for(span);
    case Kind::release: semaphores[step.object].release(); break;
    case Kind::wait_for: {
      std::unique_lock<mutex> lock(mutexes[step.mutex], std::adopt_lock);
      const bool in_time = conditions[step.object].wait_for(lock, span) == cv_status::no_timeout;
      lock.release();
      return in_time;
    }
    case Kind::notify_one: conditions[step.object].notify_one(); break;
    case Kind::notify_all: conditions[step.object].notify_all(); break;
    case Kind::tick: return timers[task].wait();
    case Kind::spawn:
      threads[step.object] = thread(small_stack, [this, child = step.object] { do_task(child); });
      break;
    case Kind::join: threads[step.object].join(); break;
    case Kind::detach: threads[step.object].detach(); break;
  }
  return 1;
}

void World::do_task(std::size_t task) {
  ids[task] = kernel::running->id;
  const std::vector<Step>& steps = program.tasks[task];
  for (std::size_t step = 0; step < steps.size();) {
    const std::int64_t result = do_step(task, steps[step]);
    outcome.done.push_back({task, step, now().ns(), result});
    step = steps[step].kind == Kind::lock_for && result == 0 ? steps[step].otherwise : step + 1;
  }
}

struct Run {
  Outcome outcome;
  std::vector<std::uint64_t> ids;  // of the tasks: their choices are hashes of them
};

Run run_on_the_scheduler(const Program& program, const SimulationOptions& options = {}) {
  World world(program);
  Simulation simulation(options);
  for (std::size_t i = 0; i < program.roots; ++i)
    simulation.spawn(simulation.environment(), {.stack = kernel::StackSize::small}, [&world, i] { world.do_task(i); });
  const kernel::RunState state = kernel::run_before(simulation.scheduler(), Time::max());
  world.outcome.ended = state == kernel::RunState::stopped;
  world.outcome.end_ns = simulation.global_time().ns();
  world.outcome.events = kernel::events(simulation.scheduler());
  simulation.unwind();
  return {std::move(world.outcome), std::move(world.ids)};
}

// The choices of a seeded order: hashes of the seed, the task and its own count of events.
Choices choices_of_seed(std::uint64_t seed, const std::vector<std::uint64_t>& ids) {
  const auto record = [&ids](std::size_t task, std::uint64_t sequence) {
    kernel::Task so_far;
    so_far.id = ids[task];
    so_far.sequence = sequence;
    return so_far;
  };
  return {
      .tie =
          [=](std::size_t task, std::uint64_t sequence) {
            return kernel::make_order(kernel::Phase::tasks,
                                      kernel::Chooser(kernel::Order::seeded, seed).tie(record(task, sequence)));
          },
      .waiter =
          [=](std::size_t waker, std::uint64_t sequence, std::uint32_t count) {
            return kernel::Chooser(kernel::Order::seeded, seed).waiter(record(waker, sequence), count);
          },
  };
}

// The results of all programs together.
struct Tally {
  int programs = 0;
  int ended = 0;
  std::uint64_t events = 0;
};

// Runs a random program both ways, in the default order (seed 0) or that of `seed`.
void compare(std::uint64_t number, std::size_t tasks, std::size_t steps, std::uint64_t seed, Tally& tally) {
  const Program program = random_program(number, tasks, steps);
  const auto [found, ids] = run_on_the_scheduler(program, order_number(seed));
  const Outcome expected = run_by_the_book(program, seed == 0 ? Choices() : choices_of_seed(seed, ids));
  const auto [here, there] =
      std::mismatch(found.done.begin(), found.done.end(), expected.done.begin(), expected.done.end());
  ASSERT_TRUE(here == found.done.end() && there == expected.done.end())
      << "program " << number << ", seed " << seed << ", step " << here - found.done.begin() << ": "
      << (here == found.done.end() ? "the end" : testing::PrintToString(*here)) << ", by the book "
      << (there == expected.done.end() ? "the end" : testing::PrintToString(*there));
  ASSERT_EQ(found.events, expected.events) << "program " << number << ", seed " << seed;
  ASSERT_EQ(found.ended, expected.ended) << "program " << number << ", seed " << seed;
  ASSERT_EQ(found.end_ns, expected.end_ns) << "program " << number << ", seed " << seed;
  ++tally.programs;
  tally.ended += found.ended;
  tally.events += found.events;
}

TEST(ReferenceModel, AMillionEventsOfRandomProgramsAreAsTheAlgorithmsSay) {
  Tally small, large;
  for (std::uint64_t number = 1; number <= 1200 && !testing::Test::HasFatalFailure(); ++number)
    compare(number, 2 + number % 9, 10 + number % 61, number % 3, small);
  for (std::uint64_t number = 1; number <= 12 && !testing::Test::HasFatalFailure(); ++number)
    compare(number, 40 * number, 300, number % 3, large);
  if (testing::Test::HasFatalFailure()) return;
  // Both programs that end and programs that hang occurred.
  EXPECT_GT(small.ended, 120);
  EXPECT_LT(small.ended, 1080);
  EXPECT_GT(small.events + large.events, 1'000'000u);
  RecordProperty("events", std::to_string(small.events + large.events));
}

// Independent of the model: steps are done in time order, and no mutex is held by two tasks.
TEST(ReferenceModel, EveryOrderKeepsTimeAndMutualExclusion) {
  for (std::uint64_t seed = 0; seed <= 200; ++seed) {
    const Program program = random_program(seed, 6, 30);
    const Outcome outcome = run_on_the_scheduler(program, order_number(seed)).outcome;
    const std::size_t nobody = program.tasks.size();
    std::vector<std::size_t> owner(program.objects, nobody), next_step(program.tasks.size(), 0);
    // A task in a wait does not hold the mutex.
    const auto is_free = [&](std::size_t mutex) {
      const std::size_t task = owner[mutex];
      return task == nobody || program.tasks[task][next_step[task]].kind == Kind::wait_for;
    };
    std::int64_t time = 0;
    for (const Done& done : outcome.done) {
      const Step& step = program.tasks[done.task][done.step];
      if (step.kind == Kind::lock || (step.kind == Kind::lock_for && done.result != 0)) {
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
      // Steps without a waitpoint may be ahead of the others.
      if (step.kind == Kind::compute || step.kind == Kind::spawn || step.kind == Kind::detach) continue;
      ASSERT_GE(done.time_ns, time);
      time = done.time_ns;
    }
  }
}

}  // namespace
}  // namespace waitpoint::reference
