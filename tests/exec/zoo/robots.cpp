// SPDX-License-Identifier: BSD-3-Clause
// Bugs between the modules of a robot: posters, commands, emergency stops, sensor buffers.
#include <array>
#include <atomic>
#include <chrono>
#include <mutex>
#include <semaphore>

#include "tests/exec/zoo/crew.hpp"

// Needs the primitives declared above.
#include "tests/zoo/shared/robots.hpp"

namespace waitpoint::zoo {
namespace {

// Motion reads the position from its poster, prepares, and drives off from a position that is eight updates old.
// Mended, it reads the position when it is prepared.
template <bool mended>
void stale_poster(int) {
  constexpr int updates = 12, tolerated = 8;
  std::mutex poster, wheels;
  int position = 0;
  const auto read = [&] {
    const std::lock_guard guard(poster);
    return position;
  };
  Crew crew;
  crew.add([&] {
    int from = read();
    const std::lock_guard guard(wheels);
    const std::lock_guard last_look(poster);
    if (mended) from = position;
    check(position - from < tolerated, "motion starts from where the robot was long ago");
  });
  crew.add([&] {
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
void heartbeat(int) {
  using namespace std::chrono_literals;
  using Clock = std::chrono::steady_clock;
  constexpr int steps = 12, tolerated = 10;
  std::mutex lock;
  int since_beat = 0;
  bool alive = true;
  Crew crew;
  crew.add([&] {
    const std::lock_guard guard(lock);
    since_beat = -steps;
  });
  crew.add([&] {
    const Clock::time_point start = Clock::now();
    for (int i = 0; i < steps; ++i) {
      const std::lock_guard guard(lock);
      ++since_beat;
      alive = alive && (mended ? Clock::now() - start < 1s : since_beat < tolerated);
    }
  });
  crew.join();
  check(alive, "the base is taken for dead");
}

// A handover: the giver opens its gripper when the taker announces that it is about to close its own.
template <bool mended>
void handover(int) {
  std::mutex object;
  bool takes = false;
  std::binary_semaphore about_to(0), closed(0);
  Crew crew;
  crew.add([&] {
    about_to.release();
    {
      const std::lock_guard guard(object);
      takes = true;
    }
    closed.release();
  });
  crew.add([&] {
    mended ? closed.acquire() : about_to.acquire();
    const std::lock_guard guard(object);
    check(takes, "the object falls");
  });
  crew.join();
}

}  // namespace
}  // namespace waitpoint::zoo

using namespace waitpoint::zoo;

const specimen robots[] = {
    {"stale poster", SYNCHRONIZATION, 2, either<stale_poster<false>, stale_poster<true>>},
    {"goal of the next frame", MEMORY, 2, either<goal_of_the_next_frame<false>, goal_of_the_next_frame<true>>},
    {"lost command", MEMORY, 2, either<lost_command<false>, lost_command<true>>},
    {"emergency stop", MEMORY, 2, either<emergency_stop<false>, emergency_stop<true>>},
    {"lapped reader", MEMORY, 2, either<lapped_reader<false>, lapped_reader<true>>},
    {"limited patience", SYNCHRONIZATION, 2, either<limited_patience<false>, limited_patience<true>>},
    {"heartbeat", SYNCHRONIZATION, 2, either<heartbeat<false>, heartbeat<true>>},
    {"handover", SYNCHRONIZATION, 2, either<handover<false>, handover<true>>},
    {"initialised in a chain", MEMORY, 6, either<initialised_in_a_chain<false>, initialised_in_a_chain<true>>},
    {},
};
