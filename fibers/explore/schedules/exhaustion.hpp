// SPDX-License-Identifier: BSD-3-Clause
// When a campaign that draws its schedules goes over to enumerating them, and whether that has tried all.
//
// Draws alone never show that nothing is left. Once the last ones, three times as many as there are distinct schedules,
// have all had known traces, an exhaustive strategy takes over: until it has had as many schedules as were drawn, then
// in turn with the drawing one. Its end is the campaign's, if it has come upon every trace that was drawn: else the
// events that it took for independent are not, and it has proved nothing.
#pragma once

#include <cstdint>
#include <unordered_map>

namespace waitpoint::exploration {

class Exhaustion {
 public:
  static constexpr std::uint64_t least_known = 200, times_distinct = 3;

  /// A drawn schedule has ended with this trace; the schedules are told in their order. `is_beyond`: it took what
  /// exhaustive strategies omit, see Explorer::is_beyond_enumeration().
  void take_drawn(std::uint64_t trace, bool is_beyond);
  void take_enumerated(std::uint64_t trace);
  /// One that was abandoned, since its rest is equivalent to others', has no trace.
  void take_cut() { ++enumerated_; }

  /// The number of traces so far.
  std::uint64_t distinct() const { return traces_.size(); }
  /// True once the draws bring nothing new.
  bool has_begun() const { return has_begun_; }
  /// The next schedule is the enumeration's.
  bool is_next_enumerated() const { return has_begun_ && !is_unproved_ && enumerated_ < drawn_; }

  /// The exhaustive strategy that takes over: dpor, or dfs where that is not possible, or has missed what was drawn.
  const char* strategy() const { return leaves_out_equivalent_ ? "dpor" : "dfs"; }
  /// Events that race are not independent, whatever their objects; of several processes it is not known which are.
  void keep_equivalent() { leaves_out_equivalent_ = false; }
  /// True if the enumeration has come upon all that was drawn.
  bool is_complete() const { return only_drawn_ == 0; }
  /// That strategy has come to its end; `has_all`: no schedule was lost. True if it has tried all schedules: else the
  /// next one takes over, if there is one.
  bool end_enumeration(bool has_all = true);

 private:
  enum By : std::uint8_t { by_draw = 1, by_enumeration = 2 };
  bool take(std::uint64_t trace, std::uint8_t by);

  std::unordered_map<std::uint64_t, std::uint8_t> traces_;  // who came upon it
  std::uint64_t only_drawn_ = 0;                            // the traces that an enumeration must still come upon
  std::uint64_t drawn_ = 0, enumerated_ = 0;
  std::uint64_t known_ = 0;  // the drawn schedules since the last new trace
  bool has_begun_ = false, leaves_out_equivalent_ = true, is_unproved_ = false;
};

}  // namespace waitpoint::exploration
