// SPDX-License-Identifier: BSD-3-Clause
// Operations intended to be atomic that consist of several steps.
#include <array>
#include <mutex>
#include <shared_mutex>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/shared_mutex.hpp"
#include "tests/zoo/zoo.hpp"

namespace waitpoint::zoo {
namespace {

// Two wheels count their ticks in one odometer: read, add, write.
template <bool mended>
void lost_update() {
  atomic<int> ticks(0);
  Crew crew;
  for (const char* wheel : {"left", "right"})
    crew.add(wheel, [&] {
      if (mended)
        ticks.fetch_add(1);
      else
        ticks.store(ticks.load() + 1);
    });
  crew.join();
  check(ticks.load() == 2, "a tick is lost");
}

// Two motions check the battery's charge in one critical section, and take it in another.
template <bool mended>
void check_then_act() {
  mutex battery;
  int charge = 10;
  Crew crew;
  for (const char* motion : {"drive", "lift"})
    crew.add(motion, [&] {
      std::unique_lock guard(battery);
      if (charge < 7) return;
      if (!mended) {
        guard.unlock();
        guard.lock();
      }
      charge -= 7;
    });
  crew.join();
  check(charge >= 0, "more is taken than there is");
}

// The map has a lock; the resizing thread takes a different one.
template <bool mended>
void wrong_lock() {
  mutex map, goals;
  atomic<int> width(4), cells(16);
  Crew crew;
  crew.add("resizer", [&] {
    const std::lock_guard guard(mended ? map : goals);
    width.store(8);
    cells.store(64);
  });
  crew.add("reader", [&] {
    const std::lock_guard guard(map);
    const int across = width.load();
    check(cells.load() == across * across, "the map is half resized");
  });
  crew.join();
}

// The first value is published in one critical section and the derived one in the next; a reader between them sees an
// inconsistent pair. `idle` other threads only pass through.
template <bool mended, int idle>
void two_stage() {
  mutex first_lock, second_lock;
  int first = 0, second = 0;
  Crew crew;
  for (int i = 0; i < idle; ++i)
    crew.add("passer-by", [&] {
      const std::lock_guard guard(first_lock);
      (void)first;
    });
  crew.add("writer", [&] {
    std::unique_lock guard(first_lock);
    first = 1;
    if (!mended) guard.unlock();
    const std::lock_guard inner(second_lock);
    second = first + 1;
  });
  crew.add("reader", [&] {
    std::unique_lock guard(first_lock);
    const int seen = first;
    guard.unlock();
    if (seen == 0) return;
    const std::lock_guard inner(second_lock);
    check(second == seen + 1, "the second stage is missing");
  });
  crew.join();
}

// Lazy initialisation: the flag is set before everything is initialised.
template <bool mended>
void double_checked_locking() {
  mutex making;
  atomic<bool> made(false);
  std::array<atomic<int>, 3> calibration;
  const auto get = [&] {
    if (!made.load()) {
      const std::lock_guard guard(making);
      if (!made.load()) {
        if (!mended) made.store(true);
        for (atomic<int>& value : calibration) value.store(1);
        if (mended) made.store(true);
      }
    }
    check(calibration[2].load() == 1, "used before it is made");
  };
  Crew crew;
  for (int i = 0; i < 2; ++i) crew.add("driver", get);
  crew.join();
}

// Two counters advance by each other's value, in turns: only perfect alternation reaches the limit.
template <bool mended>
void alternation() {
  constexpr int rounds = 3;
  atomic<int> i(1), j(1);
  mutex both;
  const auto advance = [&](atomic<int>& mine, const atomic<int>& other) {
    std::unique_lock guard(both, std::defer_lock);
    if (mended) guard.lock();
    for (int round = 0; round < rounds; ++round) mine.fetch_add(other.load());
  };
  Crew crew;
  crew.add("one", [&] { advance(i, j); });
  crew.add("other", [&] { advance(j, i); });
  crew.join();
  check(i.load() < 21 && j.load() < 21, "the gain is higher than any controller can bear");
}

// A reader that needs to write releases the read lock for the write lock, and does not check again.
template <bool mended>
void lock_upgrade() {
  shared_mutex table;
  int entries = 0;
  Crew crew;
  for (int i = 0; i < 3; ++i)
    crew.add("client", [&] {
      std::shared_lock reading(table);
      if (entries != 0) return;
      reading.unlock();
      const std::lock_guard writing(table);
      if (mended && entries != 0) return;
      ++entries;
    });
  crew.join();
  check(entries == 1, "entered twice");
}

// The last user switches off the light; two consider themselves the last, or none.
template <bool mended>
void reference_count() {
  atomic<int> users(3), freed(0);
  Crew crew;
  for (int i = 0; i < 3; ++i)
    crew.add("user", [&] {
      int left = users.fetch_sub(1) - 1;
      if (!mended) left = users.load();
      if (left == 0) freed.fetch_add(1);
    });
  crew.join();
  check(freed.load() == 1, "freed twice");
}

// Two drivers of one bus: selecting the device and writing to it are two calls, each locked by itself.
template <bool mended>
void wrong_device() {
  mutex bus, session;
  int selected = 0;
  const auto talk = [&](int device) {
    std::unique_lock whole(session, std::defer_lock);
    if (mended) whole.lock();
    for (int i = 0; i < 2; ++i) {
      std::unique_lock guard(bus);
      selected = device;
      guard.unlock();
      guard.lock();
      check(selected == device, "a command to the wrong device");
    }
  };
  Crew crew;
  crew.add("arm", [&] { talk(1); });
  crew.add("gripper", [&] { talk(2); });
  crew.join();
}

}  // namespace

Specimens atomicities() {
  return {{"lost update", lost_update<false>, lost_update<true>, 1, "atomicity"},
          {"check then act", check_then_act<false>, check_then_act<true>, 1, "atomicity"},
          {"wrong lock", wrong_lock<false>, wrong_lock<true>, 1, "atomicity"},
          {"two-stage", two_stage<false, 0>, two_stage<true, 0>, 1, "atomicity"},
          {"two-stage among 20", two_stage<false, 18>, two_stage<true, 18>, 1, "atomicity"},
          {"two-stage among 50", two_stage<false, 48>, two_stage<true, 48>, 1, "atomicity"},
          {"two-stage among 100", two_stage<false, 98>, two_stage<true, 98>, 1, "atomicity"},
          {"double-checked locking", double_checked_locking<false>, double_checked_locking<true>, 1, "atomicity"},
          {"alternation", alternation<false>, alternation<true>, 4, "atomicity"},
          {"lock upgrade", lock_upgrade<false>, lock_upgrade<true>, 1, "atomicity"},
          {"wrong device", wrong_device<false>, wrong_device<true>, 1, "atomicity"},
          {"reference count", reference_count<false>, reference_count<true>, 1, "atomicity"}};
}

}  // namespace waitpoint::zoo
