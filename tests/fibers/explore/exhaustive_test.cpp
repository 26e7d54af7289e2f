// SPDX-License-Identifier: BSD-3-Clause
// Exhaustive strategies find all results that a program can have, and no others.
#include <gtest/gtest.h>

#include <memory>

#include "fibers/explore/body.hpp"
#include "fibers/explore/strategies/factory.hpp"
#include "fibers/explore/strategies/profile.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/explore/small_programs.hpp"

namespace waitpoint::small {
namespace {

constexpr std::uint64_t programs = 50;
constexpr std::uint64_t schedules_max = 200'000;

struct Objects {
  explicit Objects(const Program& program)
      : units(program.units), units_left(program.units), registers(program.tasks.size()), ended(program.tasks.size()) {}

  atomic<int> value{0, "value"};
  counting_semaphore<> units;
  mutex lock;
  int units_left;
  std::vector<int> registers;
  std::vector<bool> ended;
};

void execute(const Instruction& instruction, Objects& objects, int& own) {
  int nought = 0;
  switch (instruction.step) {
    case Step::load: own = objects.value.load(); break;
    case Step::store: objects.value.store(own + instruction.operand); break;
    case Step::add: objects.value.fetch_add(instruction.operand); break;
    case Step::swap: own = objects.value.exchange(instruction.operand); break;
    case Step::replace: own = objects.value.compare_exchange_strong(nought, instruction.operand); break;
    case Step::acquire:
      objects.units.acquire();
      --objects.units_left;
      break;
    case Step::try_acquire:
      own = objects.units.try_acquire();
      objects.units_left -= own;
      break;
    case Step::release:
      objects.units.release();
      ++objects.units_left;
      break;
    case Step::lock: objects.lock.lock(); break;
    case Step::unlock: objects.lock.unlock(); break;
  }
}

struct Covered {
  std::set<std::string> results;
  std::uint64_t schedules = 0;
  bool complete = false;
};

// The body itself is the first task, and no task joins the others: fewer events beyond those of the program mean fewer
// schedules.
Covered cover(const Program& program, const std::string& name) {
  std::unique_ptr<Objects> objects;
  const auto take_part = [&](std::size_t task) {
    int own = 0;
    for (const Instruction& instruction : program.tasks[task]) execute(instruction, *objects, own);
    objects->registers[task] = own;
    objects->ended[task] = true;
  };
  exploration::Body body(
      [&] {
        for (std::size_t task = 1; task < program.tasks.size(); ++task) thread(take_part, task).detach();
        take_part(0);
      },
      nullptr, Time::max(), 100'000);
  const auto strategy = exploration::make_strategy(name);
  Covered covered;
  while (covered.schedules < schedules_max && !covered.complete) {
    objects = std::make_unique<Objects>(program);
    strategy->begin(covered.schedules, {}, {});
    const bool was_cut = body.run(*strategy).was_cut;
    Result result{false, objects->value.load(), objects->units_left, objects->registers};
    for (const bool ended : objects->ended) result.stuck |= !ended;
    if (!was_cut) covered.results.insert(to_text(result));
    ++covered.schedules;
    covered.complete = !strategy->end();
  }
  return covered;
}

TEST(SmallPrograms, AreOfManyKinds) {
  std::size_t stuck = 0, with_several_results = 0;
  for (std::uint64_t number = 1; number <= programs; ++number) {
    const auto results = enumerate(make_program(number));
    stuck += results.contains("stuck");
    with_several_results += results.size() > 1;
  }
  EXPECT_GE(stuck, 5u);
  EXPECT_GE(with_several_results, 30u);
}

class Exhaustive : public testing::TestWithParam<const char*> {};

TEST_P(Exhaustive, ComesToWhatABruteForceEnumerationComesTo) {
  std::uint64_t schedules = 0;
  for (std::uint64_t number = 1; number <= programs; ++number) {
    const Program program = make_program(number);
    const Covered covered = cover(program, GetParam());
    EXPECT_TRUE(covered.complete) << number << ": " << to_text(program);
    EXPECT_EQ(covered.results, enumerate(program)) << number << ": " << to_text(program);
    schedules += covered.schedules;
  }
  RecordProperty("schedules", std::to_string(schedules));
}

INSTANTIATE_TEST_SUITE_P(Strategies, Exhaustive, testing::Values("dfs", "dpor"));

TEST(Dpor, NeedsFarFewerSchedulesThanDfs) {
  std::uint64_t by_dfs = 0, by_dpor = 0;
  for (std::uint64_t number = 1; number <= programs; ++number) {
    by_dfs += cover(make_program(number), "dfs").schedules;
    by_dpor += cover(make_program(number), "dpor").schedules;
  }
  EXPECT_LT(by_dpor * 50, by_dfs) << by_dpor << " against " << by_dfs;
}

}  // namespace
}  // namespace waitpoint::small
