// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/sync/reference_model.hpp"

#include <algorithm>
#include <deque>
#include <utility>

namespace waitpoint::reference {
namespace {

constexpr std::size_t nobody = static_cast<std::size_t>(-1);
constexpr std::int64_t for_ever = -1;

class Model {
 public:
  Model(const Program& program, const Choices& choices)
      : program_(program),
        choices_(choices),
        tasks_(program.tasks.size()),
        mutexes_(program.objects),
        semaphores_(program.objects),
        conditions_(program.objects) {
    for (std::size_t i = 0; i < program.roots; ++i) start(i, 0);
  }

  // Algorithm 1: executes the least event, until no task has one or waits for a timer's.
  Outcome run() {
    while (to_come_ > 0) {
      const Event event = events_.front();
      events_.erase(events_.begin());
      now_ = event.time;
      if (event.phase == timers) {
        tick(event.task);
        continue;
      }
      --to_come_;
      outcome_.end_ns = now_;
      Task& task = tasks_[event.task];
      task.time = now_;
      if (task.waits_at != nullptr) {  // this was its timeout
        std::erase(*task.waits_at, event.task);
        task.waits_at = nullptr;
        task.in_time = false;
      }
      execute(event.task);
    }
    outcome_.ended = living_ == 0;
    return outcome_;
  }

 private:
  using Waiters = std::deque<std::size_t>;
  enum Phase { timers, tasks };
  struct Event {
    std::int64_t time;
    Phase phase;
    std::uint64_t tie;
    std::size_t task;
    friend auto operator<=>(const Event&, const Event&) = default;
  };
  struct Timer {
    std::uint64_t number = 0;  // of its first use
    bool started = false;
    std::int64_t ticks = 0;
    Waiters waiters;
  };
  struct Task {
    std::int64_t time = 0;  // local
    std::uint64_t sequence = 0;
    std::size_t step = 0;
    int part = 0;  // of the step
    std::int64_t deadline = for_ever;
    Waiters* waits_at = nullptr;
    bool in_time = true;   // result of its last wait
    bool notified = true;  // result of its last wait on a condition, while it waits for the mutex again
    bool ended = false;
    Waiters joiners;
    Timer timer;
  };
  struct Mutex {
    std::size_t owner = nobody;
    Waiters waiters;
  };
  struct Semaphore {
    int count = 1;
    Waiters waiters;
  };
  // The result of a part of a step.
  enum class Then { next_part, done, waits, gone };

  void start(std::size_t i, std::int64_t time) {
    ++living_;
    tasks_[i].time = time;
    put(i, time);
  }

  // --- the event list ---

  std::uint64_t tie(std::size_t i) { return choices_.tie ? choices_.tie(i, tasks_[i].sequence) : ++insertions_; }

  void put(const Event& event) { events_.insert(std::lower_bound(events_.begin(), events_.end(), event), event); }
  void put(std::size_t i, std::int64_t time) {
    put({time, tasks, tie(i), i});
    ++to_come_;
  }

  // --- Algorithm 2: a primitive begins with a waitpoint ---

  Then waitpoint(std::size_t i) {
    Task& task = tasks_[i];
    ++task.part;
    // In first-in-first-out order a task continues at the present instant, whatever events tie with it.
    const bool timers_first = !events_.empty() && events_.front().time == now_ && events_.front().phase == timers;
    if (!choices_.tie && task.time == now_ && !timers_first) {
      count(i);
      return Then::next_part;
    }
    put(i, task.time);
    return Then::waits;
  }

  Then block(std::size_t i, Waiters& waiters, std::int64_t deadline) {
    Task& task = tasks_[i];
    ++task.part;
    task.in_time = true;
    task.waits_at = &waiters;
    waiters.push_back(i);
    if (deadline != for_ever) put(i, deadline);
    return Then::waits;
  }

  // A woken task takes the global time as its local one; its timeout is cancelled.
  void wake(Waiters& waiters, std::size_t place) {
    const std::size_t i = waiters[place];
    waiters.erase(waiters.begin() + static_cast<std::ptrdiff_t>(place));
    tasks_[i].waits_at = nullptr;
    to_come_ -= std::erase_if(events_, [i](const Event& event) { return event.phase == tasks && event.task == i; });
    tasks_[i].time = now_;
    put(i, now_);
  }
  std::size_t wake_one(std::size_t waker, Waiters& waiters) {
    if (waiters.empty()) return nobody;
    const auto count = static_cast<std::uint32_t>(waiters.size());
    const std::uint32_t place =
        choices_.waiter && count > 1 ? choices_.waiter(waker, tasks_[waker].sequence, count) : 0;
    const std::size_t woken = waiters[place];
    wake(waiters, place);
    return woken;
  }
  void wake_all(Waiters& waiters) {
    while (!waiters.empty()) wake(waiters, 0);
  }

  // --- timers ---

  void tick(std::size_t i) {
    Task& task = tasks_[i];
    put({now_ + program_.periods_ns[i], timers, task.timer.number, i});
    ++task.timer.ticks;
    if (task.timer.waiters.empty()) return;
    --to_come_;
    wake(task.timer.waiters, 0);
  }

  std::int64_t take_ticks(std::size_t i) { return std::exchange(tasks_[i].timer.ticks, 0); }

  // --- tasks ---

  void count(std::size_t i) {
    ++tasks_[i].sequence;
    ++outcome_.events;
  }

  // The event of task `i`, and all that follows until its next wait.
  void execute(std::size_t i) {
    count(i);
    Task& task = tasks_[i];
    for (;;) {
      const bool last = task.step == program_.tasks[i].size();
      const Then then = last ? end(i) : perform(i, program_.tasks[i][task.step]);
      if (then == Then::waits || then == Then::gone) return;
    }
  }

  Then end(std::size_t i) {
    if (tasks_[i].part == 0) return waitpoint(i);
    if (tasks_[i].part == 1) {
      wake_all(tasks_[i].joiners);
      tasks_[i].ended = true;
      return waitpoint(i);
    }
    --living_;
    return Then::gone;
  }

  Then finish(std::size_t i, std::int64_t result = 1) {
    Task& task = tasks_[i];
    outcome_.done.push_back({i, task.step, task.time, result});
    const Step& step = program_.tasks[i][task.step];
    task.step = step.kind == Kind::lock_for && result == 0 ? step.otherwise : task.step + 1;
    task.part = 0;
    return Then::done;
  }

  // The next part of a step: before its waitpoint, after its waitpoint, or after a wait.
  Then perform(std::size_t i, const Step& step) {
    Task& task = tasks_[i];
    if (task.part == 0) return begin(i, step);
    switch (step.kind) {
      case Kind::lock:
      case Kind::lock_for: return task.part == 1 ? take(i, mutexes_[step.object]) : finish(i, task.in_time);
      case Kind::unlock: return give(i, mutexes_[step.object]), finish(i);
      case Kind::acquire:
      case Kind::acquire_for: return task.part == 1 ? take(i, semaphores_[step.object]) : finish(i, task.in_time);
      case Kind::release:
        if (wake_one(i, semaphores_[step.object].waiters) == nobody) ++semaphores_[step.object].count;
        return finish(i);
      case Kind::wait_for: return wait(i, step);
      case Kind::notify_one: return wake_one(i, conditions_[step.object]), finish(i);
      case Kind::notify_all: return wake_all(conditions_[step.object]), finish(i);
      case Kind::tick: return tick_comes(i);
      case Kind::join:
        if (task.part == 2 || tasks_[step.object].ended) return finish(i);
        return block(i, tasks_[step.object].joiners, for_ever);
      default: return finish(i);
    }
  }

  Then begin(std::size_t i, const Step& step) {
    Task& task = tasks_[i];
    task.deadline = task.time + step.span_ns;
    switch (step.kind) {
      case Kind::compute: return task.time += step.span_ns, finish(i);
      case Kind::spawn: return start(step.object, task.time), finish(i);
      case Kind::detach: return finish(i);
      case Kind::yield: return ++task.part, put(i, task.time), Then::waits;
      case Kind::sleep: task.time += step.span_ns; break;
      case Kind::lock:
      case Kind::acquire: task.deadline = for_ever; break;
      case Kind::tick:
        if (task.timer.number == 0) task.timer.number = ++timers_met_;
        break;
      default: break;
    }
    return waitpoint(i);
  }

  Then take(std::size_t i, Mutex& mutex) {
    if (mutex.owner == nobody) return mutex.owner = i, finish(i);
    return tasks_[i].deadline == now_ ? finish(i, false) : block(i, mutex.waiters, tasks_[i].deadline);
  }
  void give(std::size_t i, Mutex& mutex) { mutex.owner = wake_one(i, mutex.waiters); }

  Then take(std::size_t i, Semaphore& semaphore) {
    if (semaphore.count > 0) return --semaphore.count, finish(i);
    return tasks_[i].deadline == now_ ? finish(i, false) : block(i, semaphore.waiters, tasks_[i].deadline);
  }

  Then wait(std::size_t i, const Step& step) {
    Task& task = tasks_[i];
    Mutex& mutex = mutexes_[step.mutex];
    switch (task.part) {
      case 1: return give(i, mutex), block(i, conditions_[step.object], task.deadline);
      case 2: task.notified = task.in_time; return waitpoint(i);
      case 3:
        if (mutex.owner != nobody) return block(i, mutex.waiters, for_ever);
        mutex.owner = i;
        return finish(i, task.notified);
      default: return finish(i, task.notified);
    }
  }

  Then tick_comes(std::size_t i) {
    Task& task = tasks_[i];
    if (task.part == 2 || task.timer.ticks > 0) return finish(i, take_ticks(i));
    if (!std::exchange(task.timer.started, true)) {
      const std::int64_t period = program_.periods_ns[i];
      put({(now_ / period + 1) * period, timers, task.timer.number, i});
    }
    ++to_come_;
    return block(i, task.timer.waiters, for_ever);
  }

  const Program& program_;
  const Choices& choices_;
  std::vector<Event> events_;  // sorted
  std::vector<Task> tasks_;
  std::vector<Mutex> mutexes_;
  std::vector<Semaphore> semaphores_;
  std::vector<Waiters> conditions_;
  std::int64_t now_ = 0;
  std::uint64_t insertions_ = 0;
  std::uint64_t timers_met_ = 0;
  std::size_t to_come_ = 0;  // tasks with an event in the list, or that wait for a timer's
  std::size_t living_ = 0;
  Outcome outcome_;
};

}  // namespace

Outcome run_by_the_book(const Program& program, const Choices& choices) { return Model(program, choices).run(); }

}  // namespace waitpoint::reference
