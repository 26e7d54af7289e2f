// SPDX-License-Identifier: BSD-3-Clause
// Bugs between the modules of a robot: posters, commands, emergency stops, sensor buffers.
#include <array>
#include <atomic>
#include <chrono>
#include <mutex>
#include <semaphore>

#include "tests/exec/zoo/crew.hpp"

namespace zoo {
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

// The goal refers to a frame that is published before it. Who reads the frame first may have the goal of the next.
template <bool mended>
void goal_of_the_next_frame(int) {
  std::atomic<int> frame = 0, goal = 0;
  Crew crew;
  crew.add([&] {
    for (int i = 1; i <= 2; ++i) {
      frame.store(i);
      goal.store(i);
    }
  });
  crew.add([&] {
    const int early = mended ? goal.load() : frame.load();
    const int late = mended ? frame.load() : goal.load();
    check(mended ? early <= late : late <= early, "a goal in a frame that is not known");
  });
  crew.join();
}

// The control loop takes the command and clears it in two steps.
template <bool mended>
void lost_command(int) {
  std::atomic<int> command = 0;
  std::atomic<bool> sent = false;
  int executed = 0;
  Crew crew;
  crew.add([&] {
    command.store(1);
    command.fetch_or(2);
    sent.store(true);
  });
  crew.add([&] {
    for (bool last = false; !last;) {
      last = sent.load();
      const int taken = mended ? command.exchange(0) : command.load();
      if (!mended) command.store(0);
      executed |= taken;
      if (!last) std::this_thread::yield();
    }
  });
  crew.join();
  check((executed & 2) != 0, "a command is dropped");
}

// Going on after a stop clears the stop that was pressed for the second time meanwhile. Mended, stops are counted.
template <bool mended>
void emergency_stop(int) {
  std::atomic<int> pressed = 0, handled = 0;
  std::atomic<bool> stopped = false;
  const auto press = [&] {
    pressed.fetch_add(1);
    stopped.store(true);
  };
  Crew crew;
  crew.add([&] {
    press();
    press();
  });
  crew.add([&] {
    const int known = pressed.load();
    if (known != 1) return;
    handled.store(known);
    stopped.store(false);
    if (mended && pressed.load() != known) stopped.store(true);
  });
  crew.join();
  check(stopped.load() || pressed.load() == handled.load(), "the robot drives with the button pressed");
}

// A ring of eight scans: the reader is lapped while it copies one. Mended, it looks whether it was.
template <bool mended>
void lapped_reader(int) {
  constexpr int slots = 8, scans = 12;
  std::array<std::atomic<int>, slots> ring{};
  std::atomic<int> written = 0;
  Crew crew;
  crew.add([&] {
    for (int scan = 1; scan <= scans; ++scan) {
      ring[static_cast<std::size_t>(scan % slots)].store(scan);
      written.store(scan);
    }
  });
  crew.add([&] {
    const int latest = written.load();
    const int scan = ring[static_cast<std::size_t>(latest % slots)].load();
    if (mended && written.load() - latest >= slots - 1) return;
    check(scan == latest, "a scan has become another one");
  });
  crew.join();
}

// The supervisor asks a dozen times whether the arm is there, and gives up. Mended, it waits.
template <bool mended>
void limited_patience(int) {
  constexpr int looks = 12;
  std::mutex arm;
  bool there = false;
  std::binary_semaphore arrived(0);
  Crew crew;
  crew.add([&] {
    const std::lock_guard guard(arm);
    there = true;
    arrived.release();
  });
  crew.add([&] {
    if (mended) arrived.acquire();
    bool seen = false;
    for (int i = 0; i < looks && !seen; ++i) {
      const std::lock_guard guard(arm);
      seen = there;
    }
    check(seen, "the arm is given up");
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

// Six modules must be initialised, in a chain, before the robot moves; each thinks that its predecessor is.
template <bool mended>
void initialised_in_a_chain(int threads) {
  std::array<std::atomic<bool>, 6> made{};
  std::atomic<int> out_of_order = 0;
  Crew crew;
  for (std::size_t i = 0; i < made.size(); ++i)
    crew.add([&, i] {
      if (mended && i > 0) made[i - 1].wait(false);
      if (i > 0 && !made[i - 1].load()) out_of_order.fetch_add(1);
      made[i].store(true);
      made[i].notify_all();
    });
  crew.join();
  check(out_of_order.load() < threads - 1, "no module had what it needs");
}

}  // namespace
}  // namespace zoo

using namespace zoo;

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
