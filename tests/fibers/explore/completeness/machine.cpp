// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/explore/completeness/machine.hpp"

#include <algorithm>

#include "tests/fibers/explore/completeness/machine_state.hpp"

namespace waitpoint::completeness {
namespace {

class Search {
 public:
  Search(const Program& program, std::size_t states_max) : program_(program), states_max_(states_max) {}

  Enumerated run() {
    State first;
    for (std::size_t i = 0; i < objects; ++i) first.units[i] = program_.units[i];
    begin(program_, first, 0, nobody);
    visit(first);
    return {std::move(outcomes_), seen_.size(), seen_.size() <= states_max_};
  }

 private:
  void visit(const State& state) {
    if (seen_.size() > states_max_ || !seen_.insert(state).second) return;
    bool is_idle = true;
    for (std::size_t t = 0; t < program_.threads.size(); ++t) {
      const Thread& thread = state.threads[t];
      const bool is_late = thread.wakes != 0 && thread.wakes == state.now;
      if (thread.mode != Mode::ready && thread.mode != Mode::relocking && !is_late) continue;
      is_idle = false;
      if (is_late)
        time_out(state, t);
      else
        execute(state, t);
    }
    if (is_idle) pass_time(state);
  }

  // No event is left at this instant: the next one is that of the first sleeper or timeout, or the run is over.
  void pass_time(State state) {
    int next = 0;
    std::vector<std::size_t> stuck;
    for (std::size_t t = 0; t < threads_max; ++t) {
      const Thread& thread = state.threads[t];
      if (thread.wakes != 0 && (next == 0 || thread.wakes < next)) next = thread.wakes;
      if (thread.mode != Mode::absent && thread.mode != Mode::ended) stuck.push_back(t);
    }
    if (next == 0) return end(stuck.empty() ? "ended" : "stuck", stuck, state);
    state.now = next;
    for (std::size_t t = 0; t < threads_max; ++t) {
      Thread& thread = state.threads[t];
      if (thread.mode != Mode::asleep || thread.wakes != next) continue;
      thread.mode = Mode::ready;
      thread.wakes = 0;
      settle(program_, state, t);
    }
    visit(state);
  }

  void end(const std::string& how, const std::vector<std::size_t>& threads, const State& state) {
    Observed observed;
    for (std::size_t t = 0; t < program_.threads.size(); ++t) observed.reads.push_back(state.threads[t].reads);
    observed.values.assign(state.values.begin(), state.values.end());
    outcomes_.insert(outcome(how, threads, observed));
  }

  void finish(State state, std::size_t t) {
    ++state.threads[t].place;
    settle(program_, state, t);
    visit(state);
  }
  void finish(State state, std::size_t t, int read) {
    state.threads[t].reads.push_back(read);
    finish(std::move(state), t);
  }

  // --- events ---

  void execute(const State& state, std::size_t t) {
    const Thread& thread = state.threads[t];
    const std::vector<Instruction>& all = program_.threads[t];
    if (thread.mode == Mode::relocking) return lock(state, t, thread.object);
    if (thread.place == all.size() || all[thread.place].step == Step::exit) return end_thread(state, t);
    const auto [step, object, operand] = all[thread.place];
    const int own = static_cast<int>(t);
    State next = state;
    switch (step) {
      case Step::join: return join(state, t, object);
      case Step::lock: return lock(state, t, object);
      case Step::lock_for:
        if (state.owners[object] == own) return end("misuse", {t}, state);
        return lock(state, t, object, operand);
      case Step::try_lock:
        if (state.owners[object] == own) return end("misuse", {t}, state);
        if (state.owners[object] == nobody) next.owners[object] = own;
        return finish(next, t, state.owners[object] == nobody);
      case Step::unlock:
        if (state.owners[object] != own) return end("misuse", {t}, state);
        return hand_over(state, object, [&](const State& after) { finish(after, t); });
      case Step::wait:
      case Step::wait_for:
        if (state.owners[object] != own) return end("misuse", {t}, state);
        next.threads[t].mode = Mode::waiting;
        next.threads[t].object = object;
        next.threads[t].is_notified = true;
        if (step == Step::wait_for) next.threads[t].wakes = state.now + operand;
        return hand_over(next, object, [&](const State& after) { visit(after); });
      case Step::signal:
        return serve(next, Mode::waiting, object, [&](State& after, std::size_t waiter) {
          if (waiter < threads_max) notify(after.threads[waiter]);
          finish(after, t);
        });
      case Step::broadcast:
        for (Thread& waiter : next.threads)
          if (waiter.mode == Mode::waiting && waiter.object == object) notify(waiter);
        return finish(next, t);
      case Step::acquire:
      case Step::acquire_for:
        if (state.units[object] == 0)
          return block(next, t, Mode::acquiring, object, step == Step::acquire_for ? operand : 0);
        --next.units[object];
        resume(program_, next, t);
        return visit(next);
      case Step::try_acquire:
        next.units[object] -= state.units[object] > 0;
        return finish(next, t, state.units[object] > 0);
      case Step::release:
        return serve(next, Mode::acquiring, object, [&, object = object](State& after, std::size_t waiter) {
          if (waiter < threads_max)
            resume(program_, after, waiter);
          else
            ++after.units[object];
          finish(after, t);
        });
      case Step::count: return finish(next, t, state.units[object]);
      case Step::load: return finish(next, t, state.values[object]);
      case Step::store: next.values[object] = operand; return finish(next, t);
      case Step::add: next.values[object] += operand; return finish(next, t, state.values[object]);
      case Step::replace:
        if (state.values[object] == 0) next.values[object] = operand;
        return finish(next, t, state.values[object]);
      case Step::exit_all: return end("exit", {t}, state);
      default: return;
    }
  }

  void end_thread(State state, std::size_t t) {
    if (std::find(state.owners.begin(), state.owners.end(), static_cast<int>(t)) != state.owners.end())
      return end("misuse", {t}, state);
    state.threads[t].mode = Mode::ended;
    for (std::size_t other = 0; other < threads_max; ++other) {
      const Thread& joiner = state.threads[other];
      if (joiner.mode == Mode::joining && joiner.object == t) resume(program_, state, other);
    }
    visit(state);
  }

  void lock(State state, std::size_t t, std::uint8_t mutex, int span = 0) {
    if (state.owners[mutex] != nobody) return block(state, t, Mode::locking, mutex, span);
    state.owners[mutex] = static_cast<int>(t);
    resume(program_, state, t);
    visit(state);
  }

  void join(State state, std::size_t t, std::uint8_t other) {
    if (state.threads[other].creator != static_cast<int>(t)) return end("misuse", {t}, state);
    state.threads[other].creator = nobody;
    if (state.threads[other].mode == Mode::ended) return finish(state, t);
    block(state, t, Mode::joining, other);
  }

  // --- waiters ---

  void time_out(State state, std::size_t t) {
    Thread& thread = state.threads[t];
    thread.wakes = 0;
    if (thread.mode == Mode::waiting) {
      thread.mode = Mode::relocking;
      thread.is_notified = false;
      return visit(state);
    }
    thread.mode = Mode::ready;
    finish(std::move(state), t, 0);
  }

  // With a timeout after `span` instants; 0: none.
  void block(State state, std::size_t t, Mode mode, std::uint8_t object, int span = 0) {
    state.threads[t].mode = mode;
    state.threads[t].object = object;
    if (span != 0) {
      state.threads[t].wakes = state.now + span;
      return visit(state);
    }
    const std::vector<std::size_t> cycle = cycle_through(state, t);
    if (cycle.empty()) return visit(state);
    end("cycle", cycle, state);
  }

  // Goes on with each waiter of the object in turn; with threads_max if there is none.
  template <class Continue>
  void serve(const State& state, Mode mode, std::uint8_t object, const Continue& go_on) {
    bool is_waited_for = false;
    for (std::size_t t = 0; t < threads_max; ++t) {
      if (state.threads[t].mode != mode || state.threads[t].object != object) continue;
      is_waited_for = true;
      State next = state;
      go_on(next, t);
    }
    if (is_waited_for) return;
    State next = state;
    go_on(next, threads_max);
  }

  template <class Continue>
  void hand_over(const State& state, std::uint8_t mutex, const Continue& go_on) {
    serve(state, Mode::locking, mutex, [&](State& after, std::size_t waiter) {
      after.owners[mutex] = waiter < threads_max ? static_cast<int>(waiter) : nobody;
      if (waiter < threads_max) resume(program_, after, waiter);
      go_on(after);
    });
  }

  const Program& program_;
  std::size_t states_max_;
  std::set<State> seen_;
  Outcomes outcomes_;
};

}  // namespace

Enumerated enumerate(const Program& program, std::size_t states_max) { return Search(program, states_max).run(); }

}  // namespace waitpoint::completeness
