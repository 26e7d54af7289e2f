// SPDX-License-Identifier: BSD-3-Clause
// Tasks that wait for each other in a cycle.
#include <array>
#include <mutex>
#include <utility>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/semaphore.hpp"
#include "tests/zoo/zoo.hpp"

namespace waitpoint::zoo {
namespace {

// A crossing without a rule: each robot holds its own cell of the floor and waits for the one ahead.
template <bool mended, std::size_t robots>
void crossing() {
  std::array<mutex, robots> cells;
  Crew crew;
  for (std::size_t i = 0; i < robots; ++i)
    crew.add("robot", [&cells, i] {
      std::size_t first = i, second = (i + 1) % robots;
      if (mended && first > second) std::swap(first, second);
      const std::lock_guard own(cells[first]);
      const std::lock_guard ahead(cells[second]);
    });
  crew.join();
}

// Philosophers who take both forks several times; mended, a butler seats all but one.
template <bool mended>
void philosophers() {
  constexpr std::size_t seats = 5;
  constexpr int meals = 2;
  std::array<mutex, seats> forks;
  counting_semaphore<> butler(mended ? seats - 1 : seats);
  Crew crew;
  for (std::size_t i = 0; i < seats; ++i)
    crew.add("philosopher", [&, i] {
      for (int meal = 0; meal < meals; ++meal) {
        butler.acquire();
        {
          const std::lock_guard left(forks[i]);
          const std::lock_guard right(forks[(i + 1) % seats]);
        }
        butler.release();
      }
    });
  crew.join();
}

// The planner notifies its listeners while it holds its lock; a listener queries the planner while it holds its own.
template <bool mended>
void callback_under_lock() {
  mutex planner, display;
  int plan = 0, shown = 0;
  const auto tell = [&] {
    const std::lock_guard guard(display);
    ++shown;
  };
  Crew crew;
  crew.add("planner", [&] {
    std::unique_lock guard(planner);
    ++plan;
    if (mended) guard.unlock();
    tell();
  });
  crew.add("display", [&] {
    const std::lock_guard guard(display);
    shown = 0;
    const std::lock_guard asked(planner);
    shown = plan;
  });
  crew.join();
}

// The stopping thread joins the worker while it holds a lock that the worker takes at its end.
template <bool mended>
void join_under_lock() {
  mutex statistics;
  binary_semaphore finished(0);
  int jobs = 0;
  thread worker({.name = "worker"}, [&] {
    for (int i = 0; i < 3; ++i) {
      const std::lock_guard guard(statistics);
      ++jobs;
    }
    finished.release();
    const std::lock_guard guard(statistics);
    ++jobs;
  });
  finished.acquire();
  std::unique_lock guard(statistics);
  if (mended) guard.unlock();
  worker.join();
}

// A nested monitor: the wait for the gripper releases the gripper's lock, but not the arm's, which the thread that
// would open the gripper needs.
template <bool mended>
void nested_monitor() {
  mutex arm, gripper;
  condition_variable opened;
  bool open = false;
  Crew crew;
  crew.add("opener", [&] {
    std::unique_lock outer(arm);
    if (mended) outer.unlock();
    const std::lock_guard inner(gripper);
    open = true;
    opened.notify_all();
  });
  crew.add("picker", [&] {
    std::unique_lock outer(arm);
    if (mended) outer.unlock();
    std::unique_lock inner(gripper);
    opened.wait(inner, [&] { return open; });
  });
  crew.join();
}

// Three locks with a wrong order only on the path for a low battery.
template <bool mended>
void rare_path() {
  mutex map, path, log;
  atomic<int> battery(3);
  Crew crew;
  crew.add("monitor", [&] {
    for (int i = 0; i < 3; ++i) battery.fetch_sub(1);
    battery.fetch_add(3);
  });
  crew.add("mapper", [&] {
    const std::lock_guard first(map);
    const std::lock_guard second(path);
    const std::lock_guard third(log);
  });
  crew.add("mover", [&] {
    const bool low = battery.load() == 0;
    if (low && !mended) {
      const std::lock_guard first(log);
      const std::lock_guard second(map);
    } else {
      const std::lock_guard first(map);
      const std::lock_guard second(log);
    }
  });
  crew.join();
}

}  // namespace

Specimens deadlocks() {
  return {{"crossing of 2", crossing<false, 2>, crossing<true, 2>, 1, "deadlock"},
          {"crossing of 3", crossing<false, 3>, crossing<true, 3>, 1, "deadlock"},
          {"crossing of 5", crossing<false, 5>, crossing<true, 5>, 2, "deadlock"},
          {"crossing of 8", crossing<false, 8>, crossing<true, 8>, 4, "deadlock"},
          {"crossing of 12", crossing<false, 12>, crossing<true, 12>, 6, "deadlock"},
          {"philosophers", philosophers<false>, philosophers<true>, 2, "deadlock"},
          {"callback under lock", callback_under_lock<false>, callback_under_lock<true>, 1, "deadlock"},
          {"join under lock", join_under_lock<false>, join_under_lock<true>, 1, "deadlock"},
          {"nested monitor", nested_monitor<false>, nested_monitor<true>, 1, "deadlock"},
          {"rare path", rare_path<false>, rare_path<true>, 2, "deadlock"}};
}

}  // namespace waitpoint::zoo
