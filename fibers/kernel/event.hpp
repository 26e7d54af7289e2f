// SPDX-License-Identifier: BSD-3-Clause
// An event: its key, {time, place among the events of that instant}, and its node, a member of its task or timer.
#pragma once

#include <cstdint>

#include "core/time.hpp"

namespace waitpoint::kernel {

/// The first criterion of the order of events at one instant.
enum class Phase : std::uint8_t { deliveries = 0, world = 1, tasks = 2, processors = 3 };

inline constexpr std::uint64_t tie_mask = (std::uint64_t{1} << 60) - 1;

constexpr std::uint64_t make_order(Phase phase, std::uint64_t tie) {
  return static_cast<std::uint64_t>(phase) << 60 | (tie & tie_mask);
}
constexpr Phase phase_of(std::uint64_t order) { return static_cast<Phase>(order >> 60); }

/// The time of an event, not negative, and its place at that instant: phase:4 | tie:60.
struct EventKey {
  Time time;
  std::uint64_t order = 0;

  /// Greater than the key of every event.
  static constexpr EventKey never() { return {Time::max(), ~std::uint64_t{0}}; }

  constexpr std::uint64_t due_ns() const { return static_cast<std::uint64_t>(time.ns()); }

  // Compared as one number of 128 bits, without a branch.
  friend constexpr bool operator<(const EventKey& a, const EventKey& b) { return a.whole() < b.whole(); }

 private:
  __extension__ using Whole = unsigned __int128;
  constexpr Whole whole() const { return static_cast<Whole>(due_ns()) << 64 | order; }
};

struct EventNode {
  static constexpr std::uint32_t absent = 0xFFFFFFFF;
  static constexpr std::uint32_t ready = 0xFFFFFFFE;  // in the present queue or the ready set

  // `place` encodes the part of the event list that contains the event, and the position there.
  enum class Part : std::uint32_t { heap = 0, run = 1, calendar = 2 };
  static constexpr std::uint32_t in_heap(std::uint32_t at) { return at; }
  static constexpr std::uint32_t in_run(std::uint32_t at) { return 1u << 30 | at; }
  static constexpr std::uint32_t in_calendar(std::uint32_t at) { return 2u << 30 | at; }
  Part part() const { return static_cast<Part>(place >> 30); }
  std::uint32_t index() const { return place & ((1u << 30) - 1); }

  std::uint32_t place = absent;
  /// The action of a timer or a delivery, which must not block; null for a task, which is switched to.
  void (*fire)(EventNode&) = nullptr;

  bool in_list() const { return place != absent; }
};

struct EventEntry {
  EventKey key;
  EventNode* node;
};

}  // namespace waitpoint::kernel
