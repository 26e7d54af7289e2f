// SPDX-License-Identifier: BSD-3-Clause
// The surroundings of a perturbed process: a preloaded object (LD_PRELOAD) whose functions stand before those of the
// same names of the C library, and call them.
//
//   clocks.cpp        clocks that are off
//   directories.cpp   directories from their last entry to the first
//   heap.cpp          blocks in an order of their own, filled with what nobody set
//
// Only the third run of a self-check has it. It is linked to the C library alone, and its state is
// constant-initialised: the first call may come before any constructor.
#pragma once

#include <dlfcn.h>
#include <atomic>

namespace waitpoint::surroundings {

/// A function of the object that comes next, the C library as a rule. Looked for at the first call, by whoever comes
/// first: all find the same.
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

/// Holds a lock, for some instructions, as long as it lives. It is no mutex of the C library's: a program whose threads
/// are simulated would see that one as its own.
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
