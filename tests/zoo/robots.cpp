// SPDX-License-Identifier: BSD-3-Clause
// Bugs between the modules of a robot: posters, commands, emergency stops, sensor buffers.
#include <array>
#include <mutex>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/semaphore.hpp"
#include "tests/zoo/zoo.hpp"

// Needs the primitives declared above.
#include "tests/zoo/shared/robots.hpp"

namespace waitpoint::zoo {
namespace {

// Motion reads the position from its poster, prepares, and drives off from a position that is eight updates old.
// Mended, it reads the position when it is prepared.
template <bool mended>
void stale_poster() {
  constexpr int updates = 12, tolerated = 8;
  mutex poster, wheels;
  int position = 0;
  const auto read = [&] {
    const std::lock_guard guard(poster);
    return position;
  };
  Crew crew;
  crew.add("motion", [&] {
    int from = read();
    const std::lock_guard guard(wheels);
    if (mended) from = read();
    check(position - from < tolerated, "motion starts from where the robot was long ago");
  });
  crew.add("localisation", [&] {
    for (int i = 0; i < updates; ++i) {
      const std::lock_guard guard(poster);
      ++position;
    }
  });
  crew.join();
}

// The planner counts its steps since the base's last heartbeat; after ten it considers the base dead. Mended, it
// measures time, which has not passed.
template <bool mended>
void heartbeat() {
  constexpr int steps = 12, tolerated = 10;
  mutex lock;
  int since_beat = 0;
  bool alive = true;
  Crew crew;
  crew.add("base", [&] {
    const std::lock_guard guard(lock);
    since_beat = -steps;
  });
  crew.add("planner", [&] {
    const Time start = now();
    for (int i = 0; i < steps; ++i) {
      const std::lock_guard guard(lock);
      ++since_beat;
      alive = alive && (mended ? now() - start < Duration(std::chrono::seconds(1)) : since_beat < tolerated);
    }
  });
  crew.join();
  check(alive, "the base is taken for dead");
}

// A handover: the giver opens its gripper when the taker announces that it will close its own.
template <bool mended>
void handover() {
  atomic<bool> gives(true), takes(false);
  binary_semaphore about_to(0), closed(0);
  Crew crew;
  crew.add("taker", [&] {
    about_to.release();
    takes.store(true);
    closed.release();
  });
  crew.add("giver", [&] {
    mended ? closed.acquire() : about_to.acquire();
    gives.store(false);
    check(takes.load(), "the object falls");
  });
  crew.join();
}

}  // namespace

Specimens robots() {
  return {{"stale poster", stale_poster<false>, stale_poster<true>, 1, "robot"},
          {"goal of the next frame", goal_of_the_next_frame<false>, goal_of_the_next_frame<true>, 2, "robot"},
          {"lost command", lost_command<false>, lost_command<true>, 2, "robot"},
          {"emergency stop", emergency_stop<false>, emergency_stop<true>, 2, "robot"},
          {"lapped reader", lapped_reader<false>, lapped_reader<true>, 2, "robot"},
          {"limited patience", limited_patience<false>, limited_patience<true>, 1, "robot"},
          {"heartbeat", heartbeat<false>, heartbeat<true>, 1, "robot"},
          {"handover", handover<false>, handover<true>, 1, "robot"},
          {"initialised in a chain", initialised_in_a_chain<false>, initialised_in_a_chain<true>, 3, "robot"}};
}

}  // namespace waitpoint::zoo
