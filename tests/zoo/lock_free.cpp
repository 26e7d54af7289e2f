// SPDX-License-Identifier: BSD-3-Clause
// Lock-free code: stacks, queues, flags and counters that are nearly correct.
#include <array>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "tests/zoo/zoo.hpp"

namespace waitpoint::zoo {
namespace {

// A stack of free buffers, numbered from 1. Between a pop's read of the second and its exchange of the first, others
// take both and return the first. Mended, each exchange advances a tag.
template <bool mended>
void aba_stack() {
  constexpr std::uint32_t tag = 16;
  std::array<atomic<std::uint32_t>, 4> next;
  std::array<atomic<int>, 4> held;
  atomic<std::uint32_t> top(1);
  next[1].store(2);
  next[2].store(3);
  const auto tagged = [](std::uint32_t before, std::uint32_t buffer) {
    return mended ? (before / tag + 1) * tag + buffer : buffer;
  };
  const auto pop = [&] {
    for (std::uint32_t seen = top.load(); seen % tag != 0;) {
      const std::uint32_t behind = next[seen % tag].load();
      if (!top.compare_exchange_strong(seen, tagged(seen, behind))) continue;
      check(held[seen % tag].fetch_add(1) == 0, "a buffer belongs to two");
      return seen % tag;
    }
    return std::uint32_t{0};
  };
  const auto push = [&](std::uint32_t buffer) {
    held[buffer].fetch_sub(1);
    std::uint32_t seen = top.load();
    do next[buffer].store(seen % tag);
    while (!top.compare_exchange_strong(seen, tagged(seen, buffer)));
  };
  Crew crew;
  crew.add("camera", [&] {
    pop();
    pop();
  });
  crew.add("laser", [&] {
    const std::uint32_t first = pop();
    pop();
    if (first != 0) push(first);
  });
  crew.join();
}

// A work-stealing queue: the owner takes at the tail, a thief at the head; for the last job they must agree.
template <bool mended>
void work_stealing() {
  constexpr int jobs = 3;
  atomic<int> head(0), tail(jobs);
  std::array<atomic<int>, jobs> done;
  Crew crew;
  crew.add("owner", [&] {
    for (;;) {
      const int last = tail.fetch_sub(1) - 1;
      int first = head.load();
      if (first > last) break;
      if (mended && first == last && !head.compare_exchange_strong(first, first + 1)) break;
      check(done[static_cast<std::size_t>(last)].fetch_add(1) == 0, "a job is done twice");
      if (first == last) break;
    }
  });
  crew.add("thief", [&] {
    for (int i = 0; i < 2; ++i) {
      int first = head.load();
      if (first >= tail.load()) break;
      if (head.compare_exchange_strong(first, first + 1))
        check(done[static_cast<std::size_t>(first)].fetch_add(1) == 0, "a job is done twice");
    }
  });
  crew.join();
}

// A sequence lock whose reader checks for a write in progress before it reads, but not again afterwards.
template <bool mended>
void sequence_lock() {
  atomic<int> sequence(0), x(0), y(0);
  Crew crew;
  crew.add("localisation", [&] {
    for (int i = 1; i <= 3; ++i) {
      sequence.fetch_add(1);
      x.store(i);
      y.store(i);
      sequence.fetch_add(1);
    }
  });
  crew.add("motion", [&] {
    const int before = sequence.load();
    if (before % 2 != 0) return;
    const int seen_x = x.load(), seen_y = y.load();
    if (mended && sequence.load() != before) return;
    check(seen_x == seen_y, "half a position");
  });
  crew.join();
}

// A lock of one flag that is tested and set in two steps.
template <bool mended>
void spin_flag() {
  atomic<bool> taken(false);
  atomic<int> inside(0);
  Crew crew;
  for (int i = 0; i < 2; ++i)
    crew.add("actuator", [&] {
      if (mended) {
        while (taken.exchange(true)) this_thread::yield();
      } else {
        while (taken.load()) this_thread::yield();
        taken.store(true);
      }
      check(inside.fetch_add(1) == 0, "two are inside");
      inside.fetch_sub(1);
      taken.store(false);
    });
  crew.join();
}

// Peterson's lock with its first two stores swapped.
template <bool mended>
void petersons_lock() {
  std::array<atomic<bool>, 2> wants;
  atomic<std::size_t> turn(0);
  atomic<int> inside(0);
  Crew crew;
  for (std::size_t i = 0; i < 2; ++i)
    crew.add("side", [&, i] {
      if (mended) wants[i].store(true);
      turn.store(1 - i);
      if (!mended) wants[i].store(true);
      while (wants[1 - i].load() && turn.load() != i) this_thread::yield();
      check(inside.fetch_add(1) == 0, "two are inside");
      inside.fetch_sub(1);
      wants[i].store(false);
    });
  crew.join();
}

// Two buffers in alternation: the reader keeps one as long as it needs, and the writer reuses it with its second frame
// from then.
template <bool mended>
void double_buffer() {
  struct Frame {
    atomic<int> left{0, ""}, right{0, ""};
    atomic<bool> read{false, ""};
  };
  std::array<Frame, 2> frames;
  atomic<std::size_t> latest(0);
  Crew crew;
  crew.add("camera", [&] {
    for (int number = 1; number <= 6; ++number) {
      const std::size_t free = 1 - latest.load();
      if (frames[free].read.load() && mended) continue;  // drops the frame
      frames[free].left.store(number);
      frames[free].right.store(number);
      latest.store(free);
    }
  });
  crew.add("viewer", [&] {
    for (int i = 0; i < 2; ++i) {
      Frame& frame = frames[latest.load()];
      frame.read.store(true);
      if (mended && &frame != &frames[latest.load()]) {
        frame.read.store(false);
        continue;
      }
      const int left = frame.left.load();
      check(frame.right.load() == left, "two frames in one");
      frame.read.store(false);
    }
  });
  crew.join();
}

// A three-bit sequence number: a reader delayed by eight messages takes the ninth for the first.
template <bool mended>
void sequence_wrap() {
  constexpr int wrap = mended ? 1000 : 8;
  atomic<int> sequence(0), value(0);
  Crew crew;
  crew.add("sender", [&] {
    for (int i = 1; i <= 10; ++i) {
      sequence.store(-1);
      value.store(i);
      sequence.store(i % wrap);
    }
  });
  crew.add("receiver", [&] {
    const int before = sequence.load();
    if (before == -1) return;
    const int first = value.load();
    const int second = value.load();
    if (sequence.load() == before) check(first == second, "a message has become another one");
  });
  crew.join();
}

}  // namespace

Specimens lock_free() {
  return {{"ABA stack", aba_stack<false>, aba_stack<true>, 1, "lock-free"},
          {"work stealing", work_stealing<false>, work_stealing<true>, 2, "lock-free"},
          {"sequence lock", sequence_lock<false>, sequence_lock<true>, 2, "lock-free"},
          {"spin flag", spin_flag<false>, spin_flag<true>, 2, "lock-free"},
          {"Peterson's lock", petersons_lock<false>, petersons_lock<true>, 2, "lock-free"},
          {"double buffer", double_buffer<false>, double_buffer<true>, 2, "lock-free"},
          {"sequence wrap", sequence_wrap<false>, sequence_wrap<true>, 2, "lock-free"}};
}

}  // namespace waitpoint::zoo
