// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/explore/small_programs.hpp"

#include "core/random.hpp"

namespace waitpoint::small {
namespace {

constexpr int nobody = -1;

struct State {
  int value = 0, units = 0, owner = nobody;
  std::vector<int> registers;
  std::vector<std::size_t> places;
  auto operator<=>(const State&) const = default;
};

bool is_possible(const State& state, const Instruction& next) {
  if (next.step == Step::acquire) return state.units > 0;
  if (next.step == Step::lock) return state.owner == nobody;
  return true;
}

State after(State state, std::size_t task, const Instruction& next) {
  int& own = state.registers[task];
  switch (next.step) {
    case Step::load: own = state.value; break;
    case Step::store: state.value = own + next.operand; break;
    case Step::add: state.value += next.operand; break;
    case Step::swap:
      own = state.value;
      state.value = next.operand;
      break;
    case Step::replace:
      own = state.value == 0;
      if (own == 1) state.value = next.operand;
      break;
    case Step::acquire: --state.units; break;
    case Step::try_acquire:
      own = state.units > 0;
      state.units -= own;
      break;
    case Step::release: ++state.units; break;
    case Step::lock: state.owner = static_cast<int>(task); break;
    case Step::unlock: state.owner = nobody; break;
  }
  ++state.places[task];
  return state;
}

void visit(const Program& program, const State& state, std::set<State>& seen, std::set<std::string>& results) {
  if (!seen.insert(state).second) return;
  bool ended = true, stuck = true;
  for (std::size_t task = 0; task < program.tasks.size(); ++task) {
    if (state.places[task] == program.tasks[task].size()) continue;
    ended = false;
    const Instruction& next = program.tasks[task][state.places[task]];
    if (!is_possible(state, next)) continue;
    stuck = false;
    visit(program, after(state, task, next), seen, results);
  }
  if (ended || stuck) results.insert(to_text(Result{!ended, state.value, state.units, state.registers}));
}

}  // namespace

std::string to_text(const Program& program) {
  constexpr const char* names[] = {"load",    "store",       "add",     "swap", "replace",
                                   "acquire", "try_acquire", "release", "lock", "unlock"};
  std::string text = "units " + std::to_string(program.units);
  for (const auto& task : program.tasks) {
    text += " |";
    for (const Instruction& instruction : task)
      text += std::string(" ") + names[static_cast<int>(instruction.step)] + ":" + std::to_string(instruction.operand);
  }
  return text;
}

Program make_program(std::uint64_t number) {
  const RandomStream draws(number, "tests", "small programs");
  std::uint64_t drawn = 0;
  const auto below = [&](std::uint64_t bound) { return static_cast<int>(draws.below(bound, drawn++)); };
  Program program;
  program.units = below(2);
  const std::size_t tasks = number % 3 == 0 ? 3 : 2;
  const bool with_lock = number % 2 == 0;
  const bool with_semaphore = number % 4 == 1 || number % 4 == 2;
  for (std::size_t i = 0; i < tasks; ++i) {
    std::vector<Instruction> task;
    const int length = tasks == 2 ? 1 + below(4) : i == 0 ? 2 : i == 1 ? 1 + below(2) : 1;
    const bool locks = with_lock && length >= (tasks == 3 ? 2 : 3);
    if (locks) task.push_back({Step::lock, 0});
    while (static_cast<int>(task.size()) < length - locks) {
      const auto last = static_cast<std::uint64_t>(with_semaphore ? Step::release : Step::replace);
      const auto step = static_cast<Step>(below(last + 1));
      task.push_back({step, 1 + below(3)});
    }
    if (locks) task.push_back({Step::unlock, 0});
    program.tasks.push_back(std::move(task));
  }
  return program;
}

std::string to_text(const Result& result) {
  if (result.stuck) return "stuck";
  std::string text = "value " + std::to_string(result.value) + " units " + std::to_string(result.units) + " registers";
  for (const int own : result.registers) text += " " + std::to_string(own);
  return text;
}

std::set<std::string> enumerate(const Program& program) {
  std::set<State> seen;
  std::set<std::string> results;
  State first;
  first.units = program.units;
  first.registers.resize(program.tasks.size());
  first.places.resize(program.tasks.size());
  visit(program, first, seen, results);
  return results;
}

}  // namespace waitpoint::small
