// SPDX-License-Identifier: BSD-3-Clause
// A lock-free stack of the elements of an array, linked by their indices, without a tag: the specimen with the same
// text on simulated threads (tests/zoo) and on system threads (tests/exec/zoo).
//
// The includer declares the primitives before, in this namespace: Crew, check, atomic.
#pragma once

#include <array>
#include <cstddef>

namespace waitpoint::zoo {
namespace {

// A thread that pops takes the link out of the top element, so that others leave it alone, and puts it back if it comes
// too late. It can come too late in a chain of five: then an element is popped twice. Mended, the top has a tag, and
// the links stay where they are.
template <bool mended>
class ElementStack {
 public:
  static constexpr std::size_t elements = 3;
  static constexpr int none = -1;

  ElementStack() {
    for (std::size_t i = 0; i < elements; ++i) links_[i].store(i + 1 < elements ? static_cast<int>(i) + 1 : none);
    left_.store(elements);
  }

  /// None if only one element is left, which stays.
  int pop() {
    while (left_.load() > 1) {
      int top = top_.load();
      atomic<int>& link = links_[index_of(top)];
      const int behind = mended ? link.load() : link.exchange(none);
      if (behind == none) continue;
      const auto element = static_cast<int>(index_of(top));
      if (top_.compare_exchange_strong(top, tagged(top, behind))) {
        left_.fetch_sub(1);
        return element;
      }
      if (!mended) link.exchange(behind);
    }
    return none;
  }

  void push(int element) {
    int top = top_.load();
    do links_[static_cast<std::size_t>(element)].store(static_cast<int>(index_of(top)));
    while (!top_.compare_exchange_strong(top, tagged(top, element)));
    left_.fetch_add(1);
  }

 private:
  static constexpr int tag = 16;
  static std::size_t index_of(int top) { return static_cast<std::size_t>(top % tag); }
  static int tagged(int before, int element) { return mended ? (before / tag + 1) * tag + element : element; }

  std::array<atomic<int>, elements> links_;
  atomic<int> top_{0}, left_{0};
};

template <bool mended>
void element_stack() {
  constexpr int threads = 3, rounds = 2;
  using Stack = ElementStack<mended>;
  Stack stack;
  std::array<atomic<int>, Stack::elements> owner;
  Crew crew;
  for (int i = 1; i <= threads; ++i)
    crew.add("user", [&, i] {
      for (int round = 0; round < rounds; ++round) {
        int element = Stack::none;
        while (element == Stack::none) element = stack.pop();
        atomic<int>& own = owner[static_cast<std::size_t>(element)];
        own.store(i);
        check(own.load() == i, "an element belongs to two");
        stack.push(element);
      }
    });
  crew.join();
}

}  // namespace
}  // namespace waitpoint::zoo
