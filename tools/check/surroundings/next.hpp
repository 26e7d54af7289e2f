// SPDX-License-Identifier: BSD-3-Clause
// The surroundings of a perturbed process: a preloaded object (LD_PRELOAD) whose functions interpose on the C library's
// functions of the same names, and call them.
//
//   clocks.cpp        clocks that are off
//   directories.cpp   directories in reverse order
//   heap.cpp          shuffled and filled blocks
//
// Only the third run of a self-check loads it. It links to the C library alone, and its state is constant-initialised:
// the first call may precede all constructors.
#pragma once

#include <dlfcn.h>
#include <atomic>

namespace waitpoint::surroundings {

/// A function of the next object, usually the C library. Looked up at the first call; concurrent lookups find the same.
template <class Function>
class Next {
 public:
  explicit constexpr Next(const char* name) : name_(name) {}
  template <class... Arguments>
  auto operator()(Arguments... arguments) {
    return found()(arguments...);
  }

 private:
  Function* found() {
    Function* function = function_.load(std::memory_order_relaxed);
    if (function == nullptr) {
      function = reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name_));
      function_.store(function, std::memory_order_relaxed);
    }
    return function;
  }

  const char* const name_;
  std::atomic<Function*> function_{nullptr};
};

/// Holds a lock, for a few instructions, during its lifetime. Not a mutex of the C library: a program with simulated
/// threads would take that for its own.
class Holding {
 public:
  explicit Holding(std::atomic_flag& lock) : lock_(lock) {
    while (lock_.test_and_set(std::memory_order_acquire)) {
    }
  }
  ~Holding() { lock_.clear(std::memory_order_release); }
  Holding(const Holding&) = delete;
  Holding& operator=(const Holding&) = delete;

 private:
  std::atomic_flag& lock_;
};

}  // namespace waitpoint::surroundings
