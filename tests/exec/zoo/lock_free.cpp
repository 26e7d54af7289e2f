// SPDX-License-Identifier: BSD-3-Clause
// Lock-free code: stacks, queues, flags and counters that are nearly correct.
#include <array>
#include <atomic>
#include <cstdint>

#include "tests/exec/zoo/crew.hpp"

namespace zoo {
namespace {

// A stack of free buffers, numbered from 1. Between a pop's read of the second and its exchange of the first, others
// take both and return the first. Mended, each exchange advances a tag.
template <bool mended>
class Stack {
 public:
  std::uint32_t pop() {
    for (std::uint32_t seen = top_.load(); seen % tag != 0;) {
      const std::uint32_t behind = next_[seen % tag].load();
      if (!top_.compare_exchange_strong(seen, tagged(seen, behind))) continue;
      check(held_[seen % tag].fetch_add(1) == 0, "a buffer belongs to two");
      return seen % tag;
    }
    return 0;
  }
  void push(std::uint32_t buffer) {
    held_[buffer].fetch_sub(1);
    std::uint32_t seen = top_.load();
    do next_[buffer].store(seen % tag);
    while (!top_.compare_exchange_strong(seen, tagged(seen, buffer)));
  }

 private:
  static constexpr std::uint32_t tag = 16;
  static std::uint32_t tagged(std::uint32_t before, std::uint32_t buffer) {
    return mended ? (before / tag + 1) * tag + buffer : buffer;
  }

  std::array<std::atomic<std::uint32_t>, 4> next_{0, 2, 3, 0};
  std::array<std::atomic<int>, 4> held_{};
  std::atomic<std::uint32_t> top_ = 1;
};

template <bool mended>
void aba_stack(int) {
  Stack<mended> buffers;
  Crew crew;
  crew.add([&] {
    buffers.pop();
    buffers.pop();
  });
  crew.add([&] {
    const std::uint32_t first = buffers.pop();
    buffers.pop();
    if (first != 0) buffers.push(first);
  });
  crew.join();
}

// A work-stealing queue: the owner takes at the tail, a thief at the head; for the last job both must agree.
template <bool mended>
void work_stealing(int) {
  constexpr int jobs = 3;
  std::atomic<int> head = 0, tail = jobs;
  std::array<std::atomic<int>, jobs> done{};
  Crew crew;
  crew.add([&] {
    for (;;) {
      const int last = tail.fetch_sub(1) - 1;
      int first = head.load();
      if (first > last) break;
      if (mended && first == last && !head.compare_exchange_strong(first, first + 1)) break;
      check(done[static_cast<std::size_t>(last)].fetch_add(1) == 0, "a job is done twice");
      if (first == last) break;
    }
  });
  crew.add([&] {
    for (int i = 0; i < 2; ++i) {
      int first = head.load();
      if (first >= tail.load()) break;
      if (head.compare_exchange_strong(first, first + 1))
        check(done[static_cast<std::size_t>(first)].fetch_add(1) == 0, "a job is done twice");
    }
  });
  crew.join();
}

// A sequence lock whose reader looks whether a write is under way before it reads, and not once more behind.
template <bool mended>
void sequence_lock(int) {
  std::atomic<int> sequence = 0, x = 0, y = 0;
  Crew crew;
  crew.add([&] {
    for (int i = 1; i <= 3; ++i) {
      sequence.fetch_add(1);
      x.store(i);
      y.store(i);
      sequence.fetch_add(1);
    }
  });
  crew.add([&] {
    const int before = sequence.load();
    if (before % 2 != 0) return;
    const int seen_x = x.load(), seen_y = y.load();
    if (mended && sequence.load() != before) return;
    check(seen_x == seen_y, "half a position");
  });
  crew.join();
}

// A lock of one flag: tested first, set then.
template <bool mended>
void spin_flag(int threads) {
  std::atomic<bool> taken = false;
  std::atomic<int> inside = 0;
  Crew crew;
  for (int i = 0; i < threads; ++i)
    crew.add([&] {
      while (mended ? taken.exchange(true) : taken.load()) std::this_thread::yield();
      if (!mended) taken.store(true);
      check(inside.fetch_add(1) == 0, "two are inside");
      inside.fetch_sub(1);
      taken.store(false);
    });
  crew.join();
}

// Peterson's lock with its two first stores swapped.
template <bool mended>
void petersons_lock(int) {
  std::array<std::atomic<bool>, 2> wants{};
  std::atomic<std::size_t> turn = 0;
  std::atomic<int> inside = 0;
  Crew crew;
  for (std::size_t i = 0; i < 2; ++i)
    crew.add([&, i] {
      if (mended) wants[i].store(true);
      turn.store(1 - i);
      if (!mended) wants[i].store(true);
      while (wants[1 - i].load() && turn.load() != i) std::this_thread::yield();
      check(inside.fetch_add(1) == 0, "two are inside");
      inside.fetch_sub(1);
      wants[i].store(false);
    });
  crew.join();
}

// Two buffers in alternation: the reader keeps one as long as it needs, and the writer reuses it with its second frame
// from then.
template <bool mended>
void double_buffer(int) {
  struct Frame {
    std::atomic<int> left = 0, right = 0;
    std::atomic<bool> read = false;
  };
  std::array<Frame, 2> frames;
  std::atomic<std::size_t> latest = 0;
  Crew crew;
  crew.add([&] {
    for (int number = 1; number <= 6; ++number) {
      const std::size_t free = 1 - latest.load();
      if (frames[free].read.load() && mended) continue;  // drops the frame
      frames[free].left.store(number);
      frames[free].right.store(number);
      latest.store(free);
    }
  });
  crew.add([&] {
    for (int i = 0; i < 2; ++i) {
      Frame& frame = frames[latest.load()];
      frame.read.store(true);
      if (!mended || &frame == &frames[latest.load()]) {
        const int left = frame.left.load();
        check(frame.right.load() == left, "two frames in one");
      }
      frame.read.store(false);
    }
  });
  crew.join();
}

// A three-bit sequence number: a reader that is held up for eight messages takes the ninth for the first.
template <bool mended>
void sequence_wrap(int) {
  constexpr int wrap = mended ? 1000 : 8;
  std::atomic<int> sequence = 0, value = 0;
  Crew crew;
  crew.add([&] {
    for (int i = 1; i <= 10; ++i) {
      sequence.store(-1);
      value.store(i);
      sequence.store(i % wrap);
    }
  });
  crew.add([&] {
    const int before = sequence.load();
    if (before == -1) return;
    const int first = value.load();
    const int second = value.load();
    check(sequence.load() != before || first == second, "a message has become another one");
  });
  crew.join();
}

}  // namespace
}  // namespace zoo

using namespace zoo;

const specimen lock_free[] = {
    {"ABA stack", MEMORY, 2, either<aba_stack<false>, aba_stack<true>>},
    {"work stealing", MEMORY, 2, either<work_stealing<false>, work_stealing<true>>},
    {"sequence lock", MEMORY, 2, either<sequence_lock<false>, sequence_lock<true>>},
    {"spin flag", MEMORY, 2, either<spin_flag<false>, spin_flag<true>>},
    {"Peterson's lock", MEMORY, 2, either<petersons_lock<false>, petersons_lock<true>>},
    {"double buffer", MEMORY, 2, either<double_buffer<false>, double_buffer<true>>},
    {"sequence wrap", MEMORY, 2, either<sequence_wrap<false>, sequence_wrap<true>>},
    {},
};
