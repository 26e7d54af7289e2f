// SPDX-License-Identifier: BSD-3-Clause
// Lock-free code: stacks, queues, flags and counters that are nearly correct.
#include <array>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "tests/zoo/zoo.hpp"

// Needs the primitives declared above.
#include "tests/zoo/shared/lock_free.hpp"

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
