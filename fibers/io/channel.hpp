// SPDX-License-Identifier: BSD-3-Clause
// The base of pipes, sockets and mailboxes: two sides at which tasks wait, and pollers that watch both.
//
//   tasks that receive -> receiving_ | ... |  sending_ <- tasks that send
//                                     ready()
//                                       ^ pollers_: tasks in poll()
//
// A channel belongs to the robot of the first task that uses it in a run; use by another robot's task is a misuse:
// communication between robots goes through a medium. The one exception is an arrival, an event without a task, which
// wakes waiting tasks.
#pragma once

#include <string>
#include <vector>

#include "fibers/io/deadline.hpp"
#include "fibers/sync/blocking.hpp"

namespace waitpoint::io {

/// The events a poll requests and returns; a set.
enum class Events : std::uint8_t {
  none = 0,
  readable = 1,  ///< a receiving call would not block: data or end of file is available
  writable = 2,  ///< a sending call would not block: there is room, or the peer is gone
  closed = 4,    ///< this end or the other one is closed; reported even if not requested
};
constexpr Events operator|(Events a, Events b) {
  return static_cast<Events>(static_cast<std::uint8_t>(a) | static_cast<std::uint8_t>(b));
}
constexpr Events operator&(Events a, Events b) {
  return static_cast<Events>(static_cast<std::uint8_t>(a) & static_cast<std::uint8_t>(b));
}
constexpr bool any(Events events) { return events != Events::none; }
/// The event if the condition holds, else none.
constexpr Events when(bool condition, Events event) { return condition ? event : Events::none; }

class Channel {
 public:
  virtual ~Channel() = default;
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;

  /// The calls that would not block now.
  virtual Events ready() const = 0;

  /// Must be called before a task uses the channel: resets it in a new run. A task of another robot is a misuse.
  void enter();
  /// `poller` is woken whenever ready() may have grown, until it is removed.
  void add_poller(kernel::Object& poller) { pollers_.push_back(&poller); }
  void remove_poller(const kernel::Object& poller);

 protected:
  Channel(const char* kind, std::string label)
      : label_(std::move(label)), receiving_(kind, label_.c_str()), sending_(kind, label_.c_str()) {}

  /// The waitpoint of a call that may block, at one of the sides. If the run is over, throws sync::Unwind, or in a
  /// destructor returns false.
  bool begin(kernel::Operation operation, kernel::Object& side);
  /// The same for a call that does not block; never throws. False if the call is to be skipped: the run is over, or the
  /// caller is not a task.
  bool begin_release(kernel::Operation operation, kernel::Object& side);

  /// Blocks at `side` until `holds()`, which is evaluated again after each wake-up of the side.
  template <class Condition>
  Status wait(kernel::Object& side, const Deadline& deadline, Condition holds) {
    while (!holds()) {
      if (deadline.at() <= sync::running_task().local_time) return deadline.late();
      if (!sync::block(side, deadline.at())) return Status::timed_out;
    }
    return Status::ok;
  }

  /// For one new item: wakes one waiter at `side`, chosen by the chooser, and the pollers.
  void wake_one(kernel::Object& side);
  /// The same for an arrival from another task's channel, which may be an event without a task.
  void wake_one_for_arrival(kernel::Object& side);
  /// Wakes all waiters at `side`, to check their conditions again, and the pollers.
  void wake_all(kernel::Object& side);

  /// True if a task waits at one of the sides, or polls.
  bool is_waited_for() const {
    return receiving_.first_waiter != nullptr || sending_.first_waiter != nullptr || !pollers_.empty();
  }
  /// Sets the channel's name in reports.
  void set_label(std::string label) {
    label_ = std::move(label);
    receiving_.label = sending_.label = label_.c_str();
  }
  /// Resets the state left by an earlier run.
  virtual void refresh() {}

 private:
  void wake_pollers();
  std::string label_;

 protected:
  kernel::Object receiving_;
  kernel::Object sending_;

 private:
  kernel::Scheduler* scheduler_ = nullptr;
  std::vector<kernel::Object*> pollers_;
  std::uint64_t arrivals_ = 0;
};

/// Adds a sent item to the digest of the sender's robot.
void record_sent(std::string_view to, std::uint64_t what);

}  // namespace waitpoint::io
