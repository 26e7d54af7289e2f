// SPDX-License-Identifier: BSD-3-Clause
// The threads and primitives of a specimen in C++, and its entry of the table.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <future>
#include <mutex>
#include <semaphore>
#include <stop_token>
#include <thread>
#include <utility>

#include "tests/exec/zoo/zoo.h"

// The namespace of the simulated twins: both include tests/zoo/shared.
namespace waitpoint::zoo {

using std::atomic;
using std::binary_semaphore;
using std::condition_variable;
using std::mutex;
using std::promise;
using std::stop_source;
namespace this_thread = std::this_thread;

class Crew {
 public:
  template <class Function>
  void add(Function function) {
    threads_.emplace_back(std::move(function));
  }
  /// Only simulated threads have names.
  template <class Function>
  void add(const char*, Function function) {
    threads_.emplace_back(std::move(function));
  }
  void join() {
    for (std::thread& member : threads_) member.join();
    threads_.clear();
  }

 private:
  std::deque<std::thread> threads_;
};

/// A specimen is a template with a parameter `mended`; it may be given the number of threads to start.
template <void (*buggy)(int), void (*correct)(int)>
void either(int threads) {
  mended ? correct(threads) : buggy(threads);
}
template <void (*buggy)(), void (*correct)()>
void either(int) {
  mended ? correct() : buggy();
}

}  // namespace waitpoint::zoo
