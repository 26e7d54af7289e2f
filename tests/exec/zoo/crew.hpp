// SPDX-License-Identifier: BSD-3-Clause
// The threads of a specimen in C++, and its entry of the table.
#pragma once

#include <deque>
#include <thread>
#include <utility>

#include "tests/exec/zoo/zoo.h"

namespace zoo {

class Crew {
 public:
  template <class Function>
  void add(Function function) {
    threads_.emplace_back(std::move(function));
  }
  void join() {
    for (std::thread& member : threads_) member.join();
    threads_.clear();
  }

 private:
  std::deque<std::thread> threads_;
};

/// A specimen is a template whose parameter says whether it is mended; it is given how many threads it starts.
template <void (*buggy)(int), void (*correct)(int)>
void either(int threads) {
  mended ? correct(threads) : buggy(threads);
}

}  // namespace zoo
