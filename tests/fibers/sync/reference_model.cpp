// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/sync/reference_model.hpp"

#include <algorithm>
#include <deque>

#include "core/random.hpp"

namespace waitpoint::reference {
namespace {

constexpr std::size_t nobody = static_cast<std::size_t>(-1);

class Model {
 public:
  explicit Model(const Program& program) : program_(program), tasks_(program.size()) {
    for (std::size_t i = 0; i < tasks_.size(); ++i) put(i, 0);
  }

  // Algorithm 1: the least event is executed, until there is none.
  Outcome run() {
    while (!events_.empty()) {
      const auto least = std::min_element(events_.begin(), events_.end());
      const Event event = *least;
      events_.erase(least);
      now_ = event.time;
      Task& task = tasks_[event.task];
      task.time = now_;
      if (task.waits_at != nullptr) {  // this was its timeout
        std::erase(*task.waits_at, event.task);
        task.waits_at = nullptr;
        task.in_time = false;
      }
      go_on(event.task);
    }
    outcome_.end_ns = now_;
    outcome_.ended = ended_ == tasks_.size();
    return outcome_;
  }

 private:
  using Waiters = std::deque<std::size_t>;
  struct Event {
    std::int64_t time;
    std::uint64_t insertion;
    std::size_t task;
    friend auto operator<=>(const Event&, const Event&) = default;
  };
  // How far a task is within its step.
  enum class Stage { before_waitpoint, at_waitpoint, blocked, relocking };
  struct Task {
    std::int64_t time = 0;  // local
    std::size_t step = 0;
    Stage stage = Stage::before_waitpoint;
    Waiters* waits_at = nullptr;
    bool in_time = true;
  };
  struct Mutex {
    std::size_t owner = nobody;
    Waiters waiters;
  };
  struct Semaphore {
    int count = 1;
    Waiters waiters;
  };

  void put(std::size_t task, std::int64_t time) { events_.push_back({time, ++insertions_, task}); }

  void block(std::size_t task, Waiters& waiters, std::int64_t deadline, Stage stage) {
    waiters.push_back(task);
    tasks_[task].waits_at = &waiters;
    tasks_[task].stage = stage;
    if (deadline >= 0) put(task, deadline);
  }

  // Algorithm 2: who is woken takes the global time as its local one.
  std::size_t wake(Waiters& waiters) {
    if (waiters.empty()) return nobody;
    const std::size_t task = waiters.front();
    waiters.pop_front();
    tasks_[task].waits_at = nullptr;
    std::erase_if(events_, [task](const Event& e) { return e.task == task; });
    tasks_[task].time = now_;
    put(task, now_);
    return task;
  }

  void finish(std::size_t i, bool in_time) {
    Task& task = tasks_[i];
    outcome_.done.push_back({i, task.step, task.time, in_time});
    const Step& step = program_[i][task.step];
    task.step = step.kind == Kind::lock_for && !in_time ? step.otherwise : task.step + 1;
    task.stage = Stage::before_waitpoint;
    task.in_time = true;
  }

  // Executes a task until its event is not the least or it blocks.
  void go_on(std::size_t i) {
    Task& task = tasks_[i];
    for (;;) {
      if (task.stage == Stage::before_waitpoint) {
        const bool last = task.step == program_[i].size();
        if (!last && program_[i][task.step].kind == Kind::compute) {
          task.time += program_[i][task.step].span_ns;
          finish(i, true);
          continue;
        }
        if (!last && program_[i][task.step].kind == Kind::sleep) task.time += program_[i][task.step].span_ns;
        task.stage = Stage::at_waitpoint;
        // At the present instant a task goes on; else its event goes through the list.
        if (task.time != now_ || (!last && program_[i][task.step].kind == Kind::yield)) return put(i, task.time);
      }
      if (task.step == program_[i].size()) {
        ++ended_;
        return;
      }
      if (!execute(i, program_[i][task.step])) return;
    }
  }

  // The step itself, after its waitpoint or its block; false if it blocks.
  bool execute(std::size_t i, const Step& step) {
    Task& task = tasks_[i];
    const bool was_blocked = task.stage != Stage::at_waitpoint;
    switch (step.kind) {
      case Kind::lock:
      case Kind::lock_for: {
        Mutex& m = mutexes_[step.object];
        if (was_blocked) return finish(i, task.in_time), true;
        if (m.owner == nobody) return m.owner = i, finish(i, true), true;
        if (step.kind == Kind::lock_for && step.span_ns == 0) return finish(i, false), true;
        return block(i, m.waiters, step.kind == Kind::lock ? -1 : task.time + step.span_ns, Stage::blocked), false;
      }
      case Kind::unlock: unlock(step.object); return finish(i, true), true;
      case Kind::acquire:
      case Kind::acquire_for: {
        Semaphore& s = semaphores_[step.object];
        if (was_blocked) return finish(i, task.in_time), true;
        if (s.count > 0) return --s.count, finish(i, true), true;
        if (step.kind == Kind::acquire_for && step.span_ns == 0) return finish(i, false), true;
        return block(i, s.waiters, step.kind == Kind::acquire ? -1 : task.time + step.span_ns, Stage::blocked), false;
      }
      case Kind::release:
        if (wake(semaphores_[step.object].waiters) == nobody) ++semaphores_[step.object].count;
        return finish(i, true), true;
      case Kind::wait_for: {
        Mutex& m = mutexes_[step.mutex];
        if (task.stage == Stage::relocking) return finish(i, task.in_time), true;
        if (!was_blocked) {
          unlock(step.mutex);
          return block(i, conditions_[step.object], task.time + step.span_ns, Stage::blocked), false;
        }
        if (m.owner == nobody) return m.owner = i, finish(i, task.in_time), true;
        return block(i, m.waiters, -1, Stage::relocking), false;
      }
      case Kind::notify_one: wake(conditions_[step.object]); return finish(i, true), true;
      case Kind::notify_all:
        while (wake(conditions_[step.object]) != nobody) {
        }
        return finish(i, true), true;
      default: return finish(i, true), true;
    }
  }

  void unlock(std::size_t mutex) { mutexes_[mutex].owner = wake(mutexes_[mutex].waiters); }

  const Program& program_;
  std::vector<Task> tasks_;
  std::vector<Event> events_;
  Mutex mutexes_[objects_of_a_kind];
  Semaphore semaphores_[objects_of_a_kind];
  Waiters conditions_[objects_of_a_kind];
  std::int64_t now_ = 0;
  std::uint64_t insertions_ = 0;
  std::size_t ended_ = 0;
  Outcome outcome_;
};

}  // namespace

Program random_program(std::uint64_t seed, std::size_t tasks, std::size_t steps) {
  const RandomStream random(seed, "", "program");
  std::uint64_t drawn = 0;
  const auto below = [&](std::uint64_t bound) { return random.below(bound, ++drawn); };
  const auto span = [&] { return static_cast<std::int64_t>(10 * below(5)); };
  Program program(tasks);
  for (std::vector<Step>& task : program) {
    const auto idle = [&] { task.push_back({below(2) == 0 ? Kind::compute : Kind::sleep, 0, span()}); };
    while (task.size() < steps) {
      const std::size_t object = below(objects_of_a_kind), mutex = below(objects_of_a_kind);
      switch (below(9)) {
        case 0:
        case 1: idle(); break;
        case 2: task.push_back({Kind::yield}); break;
        case 3:
          task.push_back({Kind::lock, mutex});
          idle();
          task.push_back({Kind::unlock, mutex});
          break;
        case 4:
          task.push_back({Kind::lock_for, mutex, span(), 0, task.size() + 3});
          idle();
          task.push_back({Kind::unlock, mutex});
          break;
        case 5:
          task.push_back({Kind::lock, mutex});
          task.push_back({Kind::wait_for, object, span(), mutex});
          idle();
          task.push_back({Kind::unlock, mutex});
          break;
        case 6: task.push_back({Kind::release, object}); break;
        case 7: task.push_back({below(6) == 0 ? Kind::acquire : Kind::acquire_for, object, span()}); break;
        default: task.push_back({below(3) == 0 ? Kind::notify_all : Kind::notify_one, object});
      }
    }
  }
  return program;
}

Outcome run_by_the_book(const Program& program) { return Model(program).run(); }

}  // namespace waitpoint::reference
