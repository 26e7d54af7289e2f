// SPDX-License-Identifier: BSD-3-Clause
// A barrier for a fixed number of tasks and repeated phases, in the names and semantics of std::barrier. The timed
// waits are an extension: the standard has none.
//
// The last arrival of a phase calls the completion function, wakes all and starts the next phase. The completion
// function should not block: exceptions must not leave it, and one that blocks at the end of the run is abandoned
// there. After a run, the barrier has its initial state again.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#include "fibers/sync/clock.hpp"
#include "fibers/sync/object.hpp"
#include "fibers/sync/report/misuse.hpp"

namespace waitpoint {
namespace sync {

struct NoCompletion {
  void operator()() noexcept {}
};

/// The part that is independent of the completion function.
class BarrierCore {
 public:
  constexpr BarrierCore(std::ptrdiff_t expected, const char* label) : object_("barrier", label), initial_(expected) {
    WAITPOINT_REQUIRE(expected >= 0, "a barrier expects a negative count");
  }

  struct Arrival {
    std::uint64_t phase;
    bool was_last;
  };
  /// More arrivals than the phase expects are a misuse. The last arrival must call end_phase().
  Arrival arrive(std::ptrdiff_t count, std::ptrdiff_t dropped);
  void end_phase();
  /// False if `phase` does not end before the deadline. A phase earlier than the previous one is a misuse.
  bool wait_before(std::uint64_t phase, Time deadline);

 private:
  void refresh();

  Object object_;
  std::ptrdiff_t initial_;
  std::ptrdiff_t expected_ = 0;  // per phase, from the next phase on
  std::ptrdiff_t missing_ = 0;   // in the current phase
  std::uint64_t phase_ = 0;
};

}  // namespace sync

template <class Completion = sync::NoCompletion>
class barrier {
  static_assert(std::is_nothrow_invocable_v<Completion&>, "as the standard says, it must be noexcept");

 public:
  /// Identifies a phase of a barrier, for wait().
  class arrival_token {
   public:
    arrival_token(arrival_token&& other) noexcept : of_(std::exchange(other.of_, nullptr)), phase_(other.phase_) {}
    arrival_token& operator=(arrival_token&& other) noexcept {
      of_ = std::exchange(other.of_, nullptr);
      phase_ = other.phase_;
      return *this;
    }

   private:
    friend class barrier;
    arrival_token(const barrier* of, std::uint64_t phase) : of_(of), phase_(phase) {}
    const barrier* of_;
    std::uint64_t phase_;
  };

  /// A negative count is a misuse. `label` is shown in reports; it must outlive the barrier.
  constexpr explicit barrier(std::ptrdiff_t expected, Completion completion = Completion(), const char* label = "")
      : core_(expected, label), completion_(std::move(completion)) {}
  barrier(const barrier&) = delete;
  barrier& operator=(const barrier&) = delete;

  static constexpr std::ptrdiff_t max() noexcept { return PTRDIFF_MAX; }

  /// A count below one, or above the number still expected in the phase, is a misuse.
  [[nodiscard]] arrival_token arrive(std::ptrdiff_t count = 1) { return arrive(count, 0); }
  void wait(arrival_token&& arrival) const { (void)wait_before(arrival, Time::max()); }
  void arrive_and_wait() { wait(arrive()); }
  /// Arrives, and reduces the expected count of later phases by one.
  void arrive_and_drop() { (void)arrive(1, 1); }

  /// False if the phase does not end in time: `arrival` then remains valid.
  template <class Rep, class Ratio>
  bool try_wait_for(arrival_token& arrival, const std::chrono::duration<Rep, Ratio>& span) const {
    return wait_before(arrival, sync::after(span));
  }
  template <class Clock, class Span>
  bool try_wait_until(arrival_token& arrival, const std::chrono::time_point<Clock, Span>& deadline) const {
    return wait_before(arrival, sync::until(deadline));
  }
  bool try_wait(arrival_token& arrival) const { return wait_before(arrival, sync::long_past); }

 private:
  arrival_token arrive(std::ptrdiff_t count, std::ptrdiff_t dropped) {
    const sync::BarrierCore::Arrival arrival = core_.arrive(count, dropped);
    if (arrival.was_last) {
      completion_();
      core_.end_phase();
    }
    return arrival_token(this, arrival.phase);
  }
  bool wait_before(arrival_token& arrival, Time deadline) const {
    WAITPOINT_REQUIRE(arrival.of_ == this, "a task waits at a barrier where it did not arrive");
    if (!core_.wait_before(arrival.phase_, deadline)) return false;
    arrival.of_ = nullptr;
    return true;
  }

  mutable sync::BarrierCore core_;
  Completion completion_;
};

}  // namespace waitpoint
