// SPDX-License-Identifier: BSD-3-Clause
// A timer of the program, on virtual or processor time, one-shot or periodic; sends a signal or calls another function
// when it expires.
#pragma once

#include <cstddef>

#include "fibers/kernel/event.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/posix/program/processor_timers.hpp"

namespace waitpoint::posix {

class SignalTimer {
 public:
  /// True if any is set on virtual time: its signal may end a wait that nothing else ends.
  static bool any_is_set() { return set_count_ > 0; }

  using Ring = void (*)(SignalTimer&, std::uint64_t expirations);
  constexpr explicit SignalTimer(Ring ring) : ring_(ring) {
    node_.event.fire = expire;
    node_.timer = this;
    processor_.timer = this;
    processor_.ring = expire_by_processor;
  }
  SignalTimer(const SignalTimer&) = delete;
  SignalTimer& operator=(const SignalTimer&) = delete;

  /// Expires at `due`, then after each interval; once if that is zero. If `due` was `late` before now, expirations
  /// since then are counted.
  void start(Time due, Duration interval, Duration late = Duration());
  /// Expires when `spent` reaches `due`.
  void start(const Duration& spent, Duration due, Duration interval);
  void stop();

  bool is_set() const { return due_ != Time::max() || processor_.spent != nullptr; }
  /// The time until it expires; zero if it is not set.
  Duration left() const;
  Duration interval() const { return interval_; }

 private:
  static int set_count_;
  static void expire(kernel::EventNode& node);
  static void expire_by_processor(ProcessorTimer& timer, const Duration& spent);
  void await();

  struct Node {
    kernel::EventNode event;  // the node is its first member
    SignalTimer* timer = nullptr;
  } node_;
  static_assert(offsetof(Node, event) == 0, "an event leads to its node");
  struct Processor : ProcessorTimer {
    SignalTimer* timer = nullptr;
  } processor_;
  kernel::Object object_{"timer"};
  Ring ring_;
  Time due_ = Time::max();
  Duration interval_;
  std::uint64_t missed_ = 0;  ///< expirations before it was started
};

}  // namespace waitpoint::posix
