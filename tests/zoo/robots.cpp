// SPDX-License-Identifier: BSD-3-Clause
// Bugs between the modules of a robot: posters, commands, emergency stops, sensor buffers.
#include <array>
#include <mutex>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/semaphore.hpp"
#include "tests/zoo/zoo.hpp"

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

// The goal refers to a frame that is published before it. A reader of the frame first may get the goal of the next.
template <bool mended>
void goal_of_the_next_frame() {
  atomic<int> frame(0), goal(0);
  Crew crew;
  crew.add("planner", [&] {
    for (int i = 1; i <= 2; ++i) {
      frame.store(i);
      goal.store(i);
    }
  });
  crew.add("motion", [&] {
    const int early = mended ? goal.load() : frame.load();
    const int late = mended ? frame.load() : goal.load();
    check(mended ? early <= late : late <= early, "a goal in a frame that is not known");
  });
  crew.join();
}

// The control loop reads and clears the command in two steps.
template <bool mended>
void lost_command() {
  atomic<int> command(0);
  atomic<bool> sent(false);
  int executed = 0;
  Crew crew;
  crew.add("operator", [&] {
    command.store(1);
    command.fetch_or(2);
    sent.store(true);
  });
  crew.add("control", [&] {
    for (bool last = false; !last;) {
      last = sent.load();
      int taken = 0;
      if (mended) {
        taken = command.exchange(0);
      } else {
        taken = command.load();
        command.store(0);
      }
      executed |= taken;
      if (!last) this_thread::yield();
    }
  });
  crew.join();
  check((executed & 2) != 0, "a command is dropped");
}

// Resuming after a stop clears the stop that was pressed again meanwhile. Mended, stops are counted.
template <bool mended>
void emergency_stop() {
  atomic<int> pressed(0), handled(0);
  atomic<bool> stopped(false);
  const auto press = [&] {
    pressed.fetch_add(1);
    stopped.store(true);
  };
  Crew crew;
  crew.add("button", [&] {
    press();
    press();
  });
  crew.add("control", [&] {
    const int known = pressed.load();
    if (known != 1) return;
    handled.store(known);
    stopped.store(false);
    if (mended && pressed.load() != known) stopped.store(true);
  });
  crew.join();
  check(stopped.load() || pressed.load() == handled.load(), "the robot drives with the button pressed");
}

// A ring of eight scans: the reader is overtaken while it copies one. Mended, it checks for that.
template <bool mended>
void lapped_reader() {
  constexpr int slots = 8, scans = 12;
  std::array<atomic<int>, slots> ring;
  atomic<int> written(0);
  Crew crew;
  crew.add("laser", [&] {
    for (int scan = 1; scan <= scans; ++scan) {
      ring[static_cast<std::size_t>(scan % slots)].store(scan);
      written.store(scan);
    }
  });
  crew.add("mapper", [&] {
    const int latest = written.load();
    const int scan = ring[static_cast<std::size_t>(latest % slots)].load();
    if (mended && written.load() - latest >= slots - 1) return;
    check(scan == latest, "a scan has become another one");
  });
  crew.join();
}

// The supervisor polls a dozen times for the arm, and gives up. Mended, it waits.
template <bool mended>
void limited_patience() {
  constexpr int looks = 12;
  mutex arm;
  bool there = false;
  binary_semaphore arrived(0);
  Crew crew;
  crew.add("arm", [&] {
    const std::lock_guard guard(arm);
    there = true;
    arrived.release();
  });
  crew.add("supervisor", [&] {
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

// Six modules must be initialised in a chain before the robot moves; each assumes that its predecessor is.
template <bool mended>
void initialised_in_a_chain() {
  constexpr std::size_t modules = 6;
  std::array<atomic<bool>, modules> made;
  atomic<std::size_t> out_of_order(0);
  Crew crew;
  for (std::size_t i = 0; i < modules; ++i)
    crew.add("module", [&, i] {
      if (mended && i > 0) made[i - 1].wait(false);
      if (i > 0 && !made[i - 1].load()) out_of_order.fetch_add(1);
      made[i].store(true);
      made[i].notify_all();
    });
  crew.join();
  check(out_of_order.load() < modules - 1, "no module had what it needs");
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
