// SPDX-License-Identifier: BSD-3-Clause
// Bugs between the modules of a robot: the specimens with the same text on simulated threads (tests/zoo) and on system
// threads (tests/exec/zoo).
//
// The includer declares the primitives before, in this namespace: Crew, check, this_thread, atomic, binary_semaphore,
// mutex.
#pragma once

#include <array>
#include <cstddef>
#include <mutex>

namespace waitpoint::zoo {
namespace {

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
}  // namespace waitpoint::zoo
