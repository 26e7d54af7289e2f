// SPDX-License-Identifier: BSD-3-Clause
// A timer of the program's that sends a signal, or does something else, when it runs out: once or again and again, on
// virtual time or on processor time.
#pragma once

#include "fibers/kernel/event.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/posix/program/processor_timers.hpp"

namespace waitpoint::posix {

class SignalTimer {
 public:
  /// Whether any is set on virtual time: its signal may end what nothing else does.
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

  /// Runs out at `due` first, then at each interval; an interval of zero: once.
  /// Before now by `late`, it has run out for each interval since.
  void start(Time due, Duration interval, Duration late = Duration());
  /// The same when `spent` has come to `due`.
  void start(const Duration& spent, Duration due, Duration interval);
  void stop();

  bool is_set() const { return due_ != Time::max() || processor_.spent != nullptr; }
  /// Until it runs out; zero if it is not set.
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
  struct Processor : ProcessorTimer {
    SignalTimer* timer = nullptr;
  } processor_;
  kernel::Object object_{"timer"};
  Ring ring_;
  Time due_ = Time::max();
  Duration interval_;
  std::uint64_t missed_ = 0;  ///< how often it had run out before it was started
};

}  // namespace waitpoint::posix
