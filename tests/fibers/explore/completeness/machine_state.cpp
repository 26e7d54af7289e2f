// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/explore/completeness/machine_state.hpp"

#include <algorithm>

namespace waitpoint::completeness {

void begin(const Program& program, State& state, std::size_t t, int creator) {
  state.threads[t].mode = Mode::ready;
  state.threads[t].creator = creator;
  settle(program, state, t);
}

void settle(const Program& program, State& state, std::size_t t) {
  Thread& thread = state.threads[t];
  const std::vector<Instruction>& all = program.threads[t];
  while (thread.place < all.size() && thread.mode == Mode::ready) {
    const Instruction& next = all[thread.place];
    if (next.step == Step::create) {
      begin(program, state, next.object, static_cast<int>(t));
    } else if (next.step == Step::sleep) {
      thread.mode = Mode::asleep;
      thread.wakes = state.now + std::max<int>(next.operand, 1);
    } else if (next.step != Step::skip) {
      return;
    } else if (!thread.reads.empty() && thread.reads.back() == 0) {
      thread.place = static_cast<std::uint8_t>(std::min<std::size_t>(thread.place + next.operand, all.size() - 1));
    }
    ++thread.place;
  }
}

void resume(const Program& program, State& state, std::size_t t) {
  Thread& thread = state.threads[t];
  thread.mode = Mode::ready;
  thread.wakes = 0;
  const Step step = program.threads[t][thread.place].step;
  if (step == Step::wait_for) thread.reads.push_back(thread.is_notified);
  if (step == Step::lock_for || step == Step::acquire_for) thread.reads.push_back(1);
  ++thread.place;
  settle(program, state, t);
}

void notify(Thread& waiter) {
  waiter.mode = Mode::relocking;
  waiter.wakes = 0;
}

std::vector<std::size_t> cycle_through(const State& state, std::size_t t) {
  std::vector<std::size_t> cycle;
  for (std::size_t member = t; cycle.size() <= threads_max;) {
    cycle.push_back(member);
    const Thread& waiter = state.threads[member];
    const int next = waiter.wakes != 0              ? nobody
                     : waiter.mode == Mode::locking ? state.owners[waiter.object]
                     : waiter.mode == Mode::joining ? waiter.object
                                                    : nobody;
    if (next == nobody) break;
    member = static_cast<std::size_t>(next);
    if (member != t) continue;
    std::sort(cycle.begin(), cycle.end());
    return cycle;
  }
  return {};
}

}  // namespace waitpoint::completeness
