// SPDX-License-Identifier: BSD-3-Clause
// The single source of choices: every property of a schedule that virtual time does not determine is decided here.
//
//   fifo      Events of one instant run robot by robot, as the robots were made, which keeps a robot's memory in the
//             caches; those of a robot in the order of insertion. The first waiter is served first. A running task
//             continues at the present instant although others tie with it, so that a debugger stays in one task.
//             A computation of uncertain cost takes the greatest.
//   seeded    Ties, waiters to serve and costs of computations are hashes of {seed, task, its sequence number}, never
//             drawn from a shared stream: one robot's actions cannot shift another's choices.
//   explored  A strategy decides: see decisions.hpp.
#pragma once

#include <cstdint>

#include "core/digest.hpp"
#include "core/time.hpp"
#include "fibers/kernel/decisions.hpp"
#include "fibers/kernel/limits.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

enum class Order : std::uint8_t { fifo, seeded, explored };

class Chooser {
 public:
  Chooser(Order order, std::uint64_t seed) : order_(order), seed_(seed) {}

  /// Reinitialises with this seed and the same strategy.
  void restart(std::uint64_t seed) {
    seed_ = seed;
    insertions_ = 0;
  }

  /// Choices from now on are those of this seed; what was chosen stays.
  void reseed(std::uint64_t seed) { seed_ = seed; }

  Order order() const { return order_; }
  std::uint64_t seed() const { return seed_; }
  /// The strategy of the explored order; null before it is set.
  Decisions* decisions() const { return decisions_; }
  void set_decisions(Decisions& decisions) { decisions_ = &decisions; }

  /// The tie of an event of `task` that is inserted now.
  std::uint64_t tie(const Task& task) {
    if (order_ != Order::seeded) return tie_of_next(task);
    return Digest::mix(seed_ ^ Digest::mix(task.id + task.sequence * 0x9E3779B97F4A7C15u));
  }
  /// The same for the other orders than the seeded: behind all earlier insertions of the task's robot.
  std::uint64_t tie_of_next(const Task& task) { return first_tie(task) | ++insertions_; }
  /// Behind all insertions of the task's robot.
  static std::uint64_t last_tie(const Task& task) { return first_tie(task) | insertions_mask; }
  /// The tie of a timer's event: by robot, then by the timer's number in the robot.
  static std::uint64_t tie(const Object& timer) {
    return std::uint64_t{timer.robot->number} << 28 | (timer.number & 0x0FFFFFFF);
  }
  /// The tie of the arrival of the `message`-th message from `sender`: behind the timers, by sender and number.
  static std::uint64_t tie(const Robot& sender, std::uint64_t message) {
    return std::uint64_t{1} << 59 | (sender.id & 0x07FFFFFF) << 32 | (message & 0xFFFFFFFF);
  }

  /// The index of the waiter that `waker` serves, of `count`, which is positive.
  std::uint32_t waiter(const Task& waker, std::uint32_t count) const {
    if (order_ == Order::fifo || count == 1) return 0;
    if (order_ == Order::explored) return decisions_->among(Choice::waiter, waker, count);
    const std::uint64_t draw = Digest::mix(~seed_ ^ Digest::mix(waker.id + waker.sequence * 0x9E3779B97F4A7C15u));
    return static_cast<std::uint32_t>((draw >> 32) * count >> 32);
  }
  /// The same for the `arrivals`-th message that arrived at `object`, without a waking task.
  std::uint32_t waiter(const Object& object, std::uint64_t arrivals, std::uint32_t count) const {
    if (order_ != Order::seeded || count == 1) return 0;
    const std::uint64_t draw = Digest::mix(~seed_ ^ Digest::mix(object.identity + arrivals * 0x9E3779B97F4A7C15u));
    return static_cast<std::uint32_t>((draw >> 32) * count >> 32);
  }

  /// True if a wait of `task` for a condition is to wake spuriously.
  bool is_spurious(const Task& task) const {
    return order_ == Order::explored && decisions_->among(Choice::spurious, task, 2) != 0;
  }

  /// The store, counted from the newest, whose value a load of `task` returns, of `count`, which is at least 2.
  std::uint32_t value(const Task& task, std::uint32_t count) const {
    return order_ == Order::explored ? decisions_->among(Choice::value, task, count) : 0;
  }

  /// The cost of a computation of `task`, within [`least`, `greatest`]; each computation has a number of its own.
  Duration computing(Task& task, Duration least, Duration greatest) const {
    if (order_ == Order::fifo) return greatest;
    if (order_ == Order::explored) return decisions_->computing(task, least, greatest);
    constexpr std::uint64_t computations = 0x636F6D7075746573u;  // "computes": no other choice has these numbers
    const std::uint64_t draw =
        Digest::mix((seed_ + computations) ^ Digest::mix(task.id + ++task.choices * 0x9E3779B97F4A7C15u));
    const auto count = static_cast<std::uint64_t>((greatest - least).ns()) + 1;
    return least + Duration::from_ns(static_cast<std::int64_t>(static_cast<unsigned __int128>(draw) * count >> 64));
  }

 private:
  // A tie in the first-in-first-out order: place of the robot:17 | insertion:43, not all of which a run of days counts.
  static constexpr std::uint32_t insertion_bits = 43;
  static_assert(places_max >> (60 - insertion_bits) == 0);
  static constexpr std::uint64_t insertions_mask = (std::uint64_t{1} << insertion_bits) - 1;
  static std::uint64_t first_tie(const Task& task) { return std::uint64_t{task.robot->place} << insertion_bits; }

  Order order_;
  std::uint64_t seed_;
  std::uint64_t insertions_ = 0;
  Decisions* decisions_ = nullptr;
};

}  // namespace waitpoint::kernel
