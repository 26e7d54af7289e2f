// SPDX-License-Identifier: BSD-3-Clause
// Lock-free code: stacks, queues, flags and counters that are nearly correct.
#include <array>
#include <atomic>
#include <cstdint>

#include "tests/exec/zoo/crew.hpp"

// Needs the primitives declared above.
#include "tests/zoo/shared/lock_free.hpp"

namespace waitpoint::zoo {
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

}  // namespace
}  // namespace waitpoint::zoo

using namespace waitpoint::zoo;

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
