// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/sync/random_program.hpp"

#include "core/random.hpp"

namespace waitpoint::reference {
namespace {

// Writes the tasks' steps. While a mutex is held, no other is locked and no task joined: some programs hang, but none
// has a cycle of owners, which would end the run early.
class Author {
 public:
  Author(std::uint64_t seed, std::size_t tasks, std::size_t steps) : random_(seed, "", "program"), children_(tasks) {
    program_.tasks.resize(tasks);
    program_.roots = 1 + tasks / 2;
    program_.objects = 2 + tasks / 4;
    for (std::size_t task = 0; task < tasks; ++task) {
      program_.periods_ns.push_back(30 + span());
      if (task >= program_.roots) children_[below(task)].push_back(task);
    }
    for (std::size_t task = 0; task < tasks; ++task) write(task, steps);
  }

  Program program() && { return std::move(program_); }

 private:
  std::uint64_t below(std::uint64_t bound) { return random_.below(bound, ++drawn_); }
  std::int64_t span() { return static_cast<std::int64_t>(10 * below(5)); }

  void write(std::size_t task, std::size_t length) {
    std::vector<Step>& steps = program_.tasks[task];
    std::vector<std::size_t> unborn = children_[task], born;
    while (steps.size() < length) {
      add_group(steps);
      if (!unborn.empty() && below(4) == 0) {
        steps.push_back({Kind::spawn, unborn.back()});
        born.push_back(unborn.back());
        unborn.pop_back();
      }
      if (!born.empty() && below(8) == 0) {
        steps.push_back({Kind::join, born.back()});
        born.pop_back();
      }
    }
    for (const std::size_t child : unborn) steps.push_back({Kind::spawn, child});
    for (const std::size_t child : unborn) steps.push_back({Kind::join, child});
    for (const std::size_t child : born) steps.push_back({Kind::detach, child});
  }

  void add_idling(std::vector<Step>& steps) {
    const Kind kind = below(2) == 0 ? Kind::compute : Kind::sleep;
    steps.push_back({kind, 0, span()});
  }

  void add_group(std::vector<Step>& steps) {
    const std::size_t object = below(program_.objects), mutex = below(program_.objects);
    switch (below(10)) {
      case 0:
      case 1: add_idling(steps); break;
      case 2: steps.push_back({Kind::yield}); break;
      case 3:
        steps.push_back({Kind::lock, mutex});
        add_idling(steps);
        steps.push_back({Kind::unlock, mutex});
        break;
      case 4:
        steps.push_back({Kind::lock_for, mutex, span(), 0, steps.size() + 3});
        add_idling(steps);
        steps.push_back({Kind::unlock, mutex});
        break;
      case 5:
        // All waits on one condition use one mutex.
        steps.push_back({Kind::lock, object});
        steps.push_back({Kind::wait_for, object, span(), object});
        add_idling(steps);
        steps.push_back({Kind::unlock, object});
        break;
      case 6: steps.push_back({Kind::release, object}); break;
      case 7: steps.push_back({below(8) == 0 ? Kind::acquire : Kind::acquire_for, object, span()}); break;
      case 8: steps.push_back({below(3) == 0 ? Kind::notify_all : Kind::notify_one, object}); break;
      default: steps.push_back({Kind::tick});
    }
  }

  RandomStream random_;
  std::uint64_t drawn_ = 0;
  Program program_;
  std::vector<std::vector<std::size_t>> children_;  // of each task
};

}  // namespace

Program random_program(std::uint64_t seed, std::size_t tasks, std::size_t steps) {
  return Author(seed, tasks, steps).program();
}

}  // namespace waitpoint::reference
